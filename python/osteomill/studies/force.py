"""The milling force: the voxel model against the analytical reference.

Without options the whole study: random motions, curves over depth, feed and spindle speed, convergence with the size
of voxels, the older contact models, the cost of a step and the memory of a bone, edges and speeds. Or random motions alone, or
those of a file.
"""

import argparse
import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np

from osteomill import _studies
from osteomill.studies import force_curves, force_edges, force_random
from osteomill.studies.force_series import ForceSeries, relative_error
from osteomill.studies.options import UsageError, number_within, whole_within
from osteomill.studies.study_run import StudyRun

WRITES = ("cases.json", "cases-*.jsonl")

MEASURES: dict[str, Callable[[dict[str, Any]], Any]] = {
    "random": force_random.measure,
    "curve": force_curves.measure_curve,
    "contact": force_curves.measure_contact,
    "convergence": force_curves.measure_convergence,
    "scaling": force_curves.measure_scaling,
    "memory": force_curves.measure_memory,
    "edges": force_edges.measure,
}


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--cases", type=pathlib.Path, metavar="FILE",
                        help="run the steady motions of this JSON file (the schema of tests/data/milling_forces.json) and "
                        "write OUT/cases.json; nothing else is run")
    parser.add_argument("--random", type=whole_within(1, 1_000_000), metavar="N",
                        help="run so many steady motions drawn at random and write OUT/random.json and random.csv; nothing "
                        "else is run")
    parser.add_argument("--seed", type=whole_within(0, 2**63 - 1), help="of the random motions (1)")
    parser.add_argument("--depth-mm", type=number_within(0.001, 5.0), help="of all random motions, in the place of their own")
    parser.add_argument("--edge-forces", action="store_true", help="burrs whose edges rub, by random coefficients")
    parser.add_argument("--heads", action="store_true",
                        help="cylinders, cones, barrels and pears in the place of balls, of random proportions")
    parser.add_argument("--offsets", action="store_true",
                        help="run each random motion also with the bone's surface up to a quarter of a voxel off in the lattice; dives "
                        "are a voxel long")
    parser.add_argument("--milled-surface", action="store_true",
                        help="the bone of random motions begins as a burr leaves it, not with the exact parts of voxels")
    parser.add_argument("--quick", action="store_true", help="fewer points, shorter runs: under a minute")
    parser.add_argument("--voxel-mm", type=number_within(0.01, 1.0), help="edge of a voxel, of --cases and --random (0.1)")
    parser.add_argument("--milling-rate-hz", type=number_within(1.0, 100_000.0), help="steps of the voxel model a second (100)")
    parser.add_argument("--travel-mm", type=number_within(0.01, 100.0),
                        help="way over which force is averaged, for motions along the surface (20 steps at least) (2)")


def run(options: argparse.Namespace, study: StudyRun) -> None:
    _require_what_belongs_together(options)
    if options.cases:
        _run_file(options, study)
    elif options.random:
        _run_random(options, study)
    else:
        _run_all(options, study)


def _require_what_belongs_together(options: argparse.Namespace) -> None:
    if options.cases and options.random:
        raise UsageError("--random excludes --cases")
    if options.quick and (options.cases or options.random):
        raise UsageError(f"--quick excludes {'--cases' if options.cases else '--random'}")
    for name in ("seed", "depth_mm", "edge_forces", "heads", "offsets", "milled_surface"):
        if getattr(options, name) not in (None, False) and not options.random:
            raise UsageError(f"--{name.replace('_', '-')} requires --random")
    if options.milling_rate_hz is not None and not options.cases:
        raise UsageError("--milling-rate-hz requires --cases")
    for name in ("voxel_mm", "travel_mm"):
        if getattr(options, name) is not None and not (options.cases or options.random):
            raise UsageError(f"--{name.replace('_', '-')} requires --cases or --random")


def measure(case: dict[str, Any]) -> Any:
    return MEASURES[case["part"]](case)


def name_of(case: dict[str, Any]) -> str:
    if case["part"] == "random":
        return str(force_random.motion_of(case).motion.name)
    return ", ".join(str(value) for key, value in case.items() if key != "quick")


def _drawn(options: argparse.Namespace, count: int) -> force_random.Drawn:
    return {"count": count, "seed": 1 if options.seed is None else options.seed, "voxel_mm": options.voxel_mm or 0.1,
            "depth_mm": options.depth_mm, "edge_forces": options.edge_forces, "heads": options.heads,
            "travel_mm": options.travel_mm or 2.0, "least_dive_voxels": 1.0 if options.offsets else 0.0, "is_milled": options.milled_surface}


def _report_random(study: StudyRun, drawn: force_random.Drawn, cases: list[Any], outcomes: list[Any]) -> dict[str, Any]:
    table = force_random.table_of(cases, outcomes)
    study.table("random", table)
    summary = force_random.summary_of(drawn, table, outcomes)
    study.say(force_random.words_of(summary))
    return summary


def _run_random(options: argparse.Namespace, study: StudyRun) -> None:
    drawn = _drawn(options, options.random)
    cases = force_random.cases_of(drawn, force_random.OFFSETS_VOXELS if options.offsets else ())
    study.json("random", _report_random(study, drawn, cases, study.sweep(measure, cases, name_of)))


def _run_file(options: argparse.Namespace, study: StudyRun) -> None:
    names: list[str] = [motion.name for motion in _studies.steady_cases(options.cases)]
    cases = [{"file": str(options.cases), "index": index, "voxel_mm": options.voxel_mm or 0.1,
              "milling_rate_hz": options.milling_rate_hz or 100.0, "travel_mm": options.travel_mm or 2.0}
             for index in range(len(names))]
    reports = study.sweep(report_of_case, cases, lambda case: names[int(case["index"])])
    study.json("cases", reports)
    study.say(f"{len(cases)} cases in {study.out / 'cases.json'}")


def report_of_case(case: dict[str, Any]) -> dict[str, Any]:
    """The voxel model beside the reference and beside the file's values. An error against a force of zero is null, unless it is
    met."""
    motion = _studies.steady_cases(pathlib.Path(case["file"]))[case["index"]]
    path = {key: case[key] for key in ("voxel_mm", "milling_rate_hz", "travel_mm")}
    reference_n, reference_removal = motion.reference()
    series = ForceSeries(*motion.run(_studies.Milling(), **path))
    force_n, removal = series.mean_force_n(), series.removal_mm3_per_s()
    steps, travel_mm = motion.path(**path)
    return {
        "name": motion.name,
        "voxel_model": {"mean_force_N": force_n, "removal_mm3_s": removal},
        "reference": {"mean_force_N": reference_n, "removal_mm3_s": reference_removal},
        "file": {"mean_force_N": motion.mean_force_n, "removal_mm3_s": motion.removal_mm3_per_s},
        "error_percent": _percent(relative_error(force_n, reference_n)),
        "file_error_percent": _percent(relative_error(force_n, motion.mean_force_n)),
        "removal_error_percent": _percent(relative_error(removal, reference_removal)),
        "ripple_percent": 100.0 * series.ripple(),
        "step_us": {"p50": float(np.percentile(series.step_us, 50)), "p99": float(np.percentile(series.step_us, 99))},
        "steps": steps, "travel_mm": travel_mm, "voxel_mm": case["voxel_mm"], "milling_rate_hz": case["milling_rate_hz"],
    }


def _percent(share: float) -> float | None:
    return 100.0 * share if np.isfinite(share) else None


def _run_all(options: argparse.Namespace, study: StudyRun) -> None:
    from osteomill.studies import force_charts

    drawn = _drawn(options, 60 if options.quick else 500)
    kinds = {"random": force_random.cases_of(drawn)} | {
        part: cases(options.quick) for part, cases in (
            ("curve", force_curves.curve_cases), ("contact", force_curves.contact_cases),
            ("convergence", force_curves.convergence_cases), ("scaling", force_curves.scaling_cases),
            ("memory", force_curves.memory_cases), ("edges", force_edges.cases))}
    cases = [case for of_kind in kinds.values() for case in of_kind]
    found = iter(study.sweep(measure, cases, name_of))
    outcomes = {part: [next(found) for _ in of_kind] for part, of_kind in kinds.items()}

    report = {"random": _report_random(study, drawn, kinds["random"], outcomes["random"])}
    curves = {varied: force_curves.curve_table(*_those(kinds["curve"], outcomes["curve"], "varied", varied))
              for varied in force_curves.CURVES}
    for name, varied in (("depth", "depth_mm"), ("feed", "feed_mm_per_s"), ("rpm", "thousand_rpm")):
        study.table(f"curve_{name}", curves[varied])
    contact = force_curves.contact_table(kinds["contact"], outcomes["contact"])
    convergence = force_curves.convergence_table(kinds["convergence"], outcomes["convergence"])
    scaling = {varied: force_curves.scaling_table(*_those(kinds["scaling"], outcomes["scaling"], "varied", varied))
               for varied in force_curves.SCALED}
    memory = force_curves.memory_table(kinds["memory"], outcomes["memory"])
    study.table("contact", contact)
    study.table("convergence", convergence)
    for varied, table in scaling.items():
        study.table(f"cost_by_{varied}", table)
    study.table("memory", memory)
    edges = force_edges.table_of(kinds["edges"], outcomes["edges"])
    study.table("edges", edges)
    study.json("force", report)
    study.chart("curves", force_charts.curves(curves))
    study.chart("contact", force_charts.contact(contact))
    study.chart("convergence", force_charts.convergence(convergence))
    study.chart("scaling", force_charts.scaling(scaling))
    study.chart("memory", force_charts.memory(memory))
    study.chart("edges", force_edges.chart_of(edges))
    study.say(f"force.json, tables (CSV) and charts (SVG) are in {study.out}")


def _those(cases: list[Any], outcomes: list[Any], key: str, value: str) -> tuple[list[Any], list[Any]]:
    kept = [(case, outcome) for case, outcome in zip(cases, outcomes) if case[key] == value]
    return [case for case, _ in kept], [outcome for _, outcome in kept]
