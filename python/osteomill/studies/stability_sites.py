"""Sites where bone ends, such as plates, edges, holes and tunnels, and random walks of a hand over bone: trials of the study of
stability beside slots and walls.

Each site is worked on by several burrs, hands and devices, in the simulator's own loops, beside the milling model on the
burr's way and a burr that is rigidly the hand. A run is judged by the faults that a hand would feel, in four numbers, each
against its bar (studies/stability/sites/site_verdict.h says how each is measured).
"""

import argparse
import functools
from typing import Any

import numpy as np
import pandas as pd

from osteomill import Burr, _studies
from osteomill.studies.study_run import StudyRun

Case = dict[str, Any]

# Each number's name, its bar, and its bar at a breakthrough.
BARS = {
    "energy_over_rigid_mj": ("energy over a rigid burr's, mJ", 5.0, 5.0),
    "stuck_ms": ("force while nothing is cut, ms", 50.0, 50.0),
    "error_percent": ("20 ms error, % of the peak", 8.0, 15.0),
    "largest_jump_n": ("jump between ticks, N", 0.3, 0.3),
}
EDGES_N_PER_MM = (0.3, 0.3, 0.0)
BURRS_MM, SPEEDS_RPM = (1.0, 2.0, 3.0, 5.0), (5e3, 10e3, 20e3, 80e3)
NAMED_WORST = 10
COLUMNS = ("energy_over_rigid_mj", "energy_mj", "stuck_ms", "error_percent", "error_while_driven_percent", "largest_jump_n",
           "peak_n", "noise_n", "max_residual_n", "fallbacks", "relaxed", "damped", "faults")
TRACE = ("hand_x_mm", "hand_y_mm", "hand_z_mm", "burr_x_mm", "burr_y_mm", "burr_z_mm", "force_x_n", "force_y_n", "force_z_n",
         "model_x_n", "model_y_n", "model_z_n", "rigid_x_n", "rigid_y_n", "rigid_z_n", "spindle")


def cases_of(options: argparse.Namespace) -> list[Case]:
    """Cases in a fixed order, whose name holds the text of --only; quick: one burr at one speed, a firm hand, an ideal device."""
    hand = {"grip": "firm", "is_ideal_device": True, "delay_ticks": 0}
    hands = [hand] if options.quick else [hand, hand | {"delay_ticks": 1}, hand | {"is_ideal_device": False}, hand | {"grip": "light"}]
    diameters_mm, speeds_rpm = ((5.0,), (10e3,)) if options.quick else (BURRS_MM, SPEEDS_RPM)
    places: list[Case] = []
    for diameter_mm in diameters_mm:
        for rpm in speeds_rpm:
            places += [{"of": "named", "diameter_mm": diameter_mm, "rpm": rpm, "index": index}
                       for index in range(len(_named(diameter_mm, rpm)))]
    places += [{"of": "tilts", "index": index} for index in range(len(_tilts()))]
    places += [{"of": "walks", "seed": options.seed, "index": number} for number in range(1, options.walks + 1)]
    made = [place | its_hand | {"method": method, "edge_forces": options.edge_forces, "feed_forward": options.feed_forward}
            for method in options.methods or ["implicit"] for its_hand in hands for place in places]
    return [case for case in made if options.only in name_of(case)]


@functools.cache
def _named(diameter_mm: float, rpm: float) -> list[_studies.Site]:
    return _studies.named_sites(Burr(diameter_mm=diameter_mm, rpm=rpm))


@functools.cache
def _tilts() -> list[_studies.Site]:
    return _studies.tilts_in_holes()


@functools.lru_cache(maxsize=1024)
def _walk(seed: int, number: int) -> _studies.Site:
    return _studies.random_walk(seed, number)


def site_of(case: Case) -> _studies.Site:
    if case["of"] == "walks":
        return _walk(case["seed"], case["index"])
    return (_tilts() if case["of"] == "tilts" else _named(case["diameter_mm"], case["rpm"]))[case["index"]]


def name_of(case: Case) -> str:
    site = site_of(case)
    return (f"{site.name}, {site.burr.diameter_mm:.3g} mm burr at {site.burr.rpm:.0f} rpm, {case['method']}, {case['grip']}, "
            f"{'ideal' if case['is_ideal_device'] else 'real'} device, {case['delay_ticks']} ticks late")


def measure(has_trace: bool, case: Case) -> dict[str, Any]:
    site = site_of(case)
    if case["edge_forces"]:
        site = site.with_edges(EDGES_N_PER_MM)
    verdict, trace = _studies.run_site(site, method=case["method"], grip=case["grip"],
                                       is_ideal_device=case["is_ideal_device"], delay_ticks=case["delay_ticks"],
                                       feed_forward=case["feed_forward"])
    return {"kind": site.kind} | verdict | ({"trace": trace} if has_trace else {})


def run(options: argparse.Namespace, study: StudyRun) -> None:
    cases = cases_of(options)
    if not cases:
        raise RuntimeError(f"no site is called '{options.only}'")
    is_alone = len(cases) == 1
    outcomes = study.sweep(functools.partial(measure, is_alone), cases, name_of)
    if is_alone:
        study.table("trace", trace_table_of(np.array(outcomes[0].pop("trace")).reshape(-1, len(TRACE))))
    sites = judged(pd.DataFrame([{"name": name_of(case)} | outcome for case, outcome in zip(cases, outcomes)]))
    study.table("sites", sites[["kind", "name", *COLUMNS, "is_met"]])
    study.table("site_points", points_of(sites))
    summary = summary_of(sites, options)
    study.json("sites", summary)
    from osteomill.studies.stability_site_chart import chart_of

    study.chart("sites", chart_of(sites))
    for kind, of_kind in summary["kinds"].items():
        study.say(f"{kind:22} {of_kind['met']:4} of {of_kind['cases']:4} meet the bars")
    study.say(f"worst: {summary['worst'][0]['name']}")
    study.say(f"sites.json, tables (CSV) and a chart (SVG) are in {study.out}")


def judged(sites: pd.DataFrame) -> pd.DataFrame:
    """The table with each number as a share of its bar, the largest of these, and whether all are met: up to 1, and no fault."""
    at_breakthrough = sites["kind"] == "breakthrough"
    shares = pd.DataFrame({f"share_{number}": sites[number] / np.where(at_breakthrough, there, bar)
                           for number, (_, bar, there) in BARS.items()})
    worst = shares.max(axis=1).clip(lower=0.0)
    return sites.assign(**shares, worst_share=worst, is_met=(worst <= 1.0) & (sites["faults"] == 0))


def points_of(sites: pd.DataFrame) -> pd.DataFrame:
    """A line for each number of each case, as a share of its bar."""
    kinds = list(dict.fromkeys(sites["kind"]))
    return pd.DataFrame([{"kind": kinds.index(site["kind"]), "name": site["kind"], "bar": bar, "share": site[f"share_{number}"]}
                         for _, site in sites.iterrows() for bar, number in enumerate(BARS)])


def trace_table_of(trace: Any) -> pd.DataFrame:
    """Every millisecond of a run."""
    table = pd.DataFrame(trace, columns=list(TRACE))
    table.insert(0, "t_s", np.arange(len(table)) * 0.001)
    table["spindle"] = table["spindle"] > 0.0
    return table


def summary_of(sites: pd.DataFrame, options: argparse.Namespace) -> dict[str, Any]:
    """For each kind, how many meet the bars and the worst of each number; the ten worst cases with the command of each."""
    kinds = {kind: {"cases": len(of_kind), "met": int(of_kind["is_met"].sum()), "faults": int(of_kind["faults"].sum()),
                    "most_energy_mj": max(0.0, of_kind["energy_mj"].max()),
                    "worst": {what: max(0.0, of_kind[number].max()) for number, (what, _, _) in BARS.items()}}
             for kind, of_kind in sites.groupby("kind", sort=False)}
    worst = sites.sort_values("worst_share", ascending=False, kind="stable").head(NAMED_WORST)
    return {"kinds": kinds, "worst": [
        {"name": site["name"], "kind": site["kind"], "share_of_bar": site["worst_share"],
         "verdict": {what: site[number] for number, (what, _, _) in BARS.items()}, "faults": site["faults"],
         "command": command_of(site["name"], options)} for _, site in worst.iterrows()]}


def command_of(name: str, options: argparse.Namespace) -> str:
    return "".join(["osteomill_study stability --sites", " --quick" if options.quick else "",
                    " --edge-forces" if options.edge_forces else "", " --feed-forward" if options.feed_forward else "",
                    f" --walks {options.walks} --seed {options.seed}" if options.walks else "",
                    f" --methods {','.join(options.methods or ['implicit'])} --only '{name}'"])
