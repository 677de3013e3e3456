"""Stability: the range in which each coupling holds, and its error there. It runs the map; or, in its place, sites where bone
ends, motions on rails, or entries into bone.

The map runs every coupling in the program's own loops on a device of its own, beside the truth in continuous time of the
same scene and hand (a finely simulated arm): a point is stable where the force has no limit cycle beyond the truth's and
gives the hand no energy beyond it. Points: stability_points.py; evaluation: stability_map.py; sites, rails and
entries: stability_sites.py, stability_rails.py, stability_onset.py.

A case of the sweep is a scene in a hand, with all couplings, rates and delays: they share one bone and one truth, whose
computation takes as long as many of them.
"""

import argparse
import json
from typing import Any

from osteomill import _studies
from osteomill.studies import stability_map, stability_onset, stability_rails, stability_regions, stability_sites
from osteomill.studies.options import UsageError, listed, number, one_of, whole_within
from osteomill.studies.stability_points import DELAYS_TICKS, GRIPS, METHODS, MILLING_RATES_HZ, Point, map_points
from osteomill.studies.study_run import StudyRun

SCENE = ("scene", "spindle_rpm", "depth_mm", "relative_stiffness", "wall_n_per_mm", "edge_n_per_mm", "grip")
OF_THE_MAP = ("grips", "milling_rates_hz", "delays")


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--quick", action="store_true", help="a coarser map: a minute on two cores")
    parser.add_argument("--methods", type=listed(one_of(*METHODS)), metavar="LIST",
                        help="only these couplings of the map, with commas between")
    parser.add_argument("--grips", type=listed(one_of(*GRIPS)), metavar="LIST", help="only these grips")
    parser.add_argument("--milling-rates-hz", type=listed(_rate), metavar="LIST", help="only these rates of the milling loop")
    parser.add_argument("--delays", type=listed(whole_within(min(DELAYS_TICKS), max(DELAYS_TICKS))), metavar="LIST",
                        help="only these delays, in haptic ticks")
    parser.add_argument("--edge-forces", action="store_true",
                        help="of the map: cutting alone, by burrs whose edges rub; of sites: the same burrs, and what holds a "
                        "hand that presses and does not cut counts as stuck")
    parser.add_argument("--sites", action="store_true",
                        help="instead of the map: sites where bone ends, such as plates, edges, holes and tunnels")
    parser.add_argument("--walks", type=whole_within(0, 100_000), default=0, metavar="N",
                        help="of sites: so many random walks of a hand, too (%(default)s)")
    parser.add_argument("--only", default="", metavar="TEXT",
                        help="only sites whose name holds this text; of one alone OUT/trace.csv has every tick")
    parser.add_argument("--rails", type=whole_within(1, 100_000), metavar="N",
                        help="instead of the map: so many random steady motions of a hand on rails, and how far the mean force "
                        "on it is from the milling model's")
    parser.add_argument("--onset", action="store_true",
                        help="instead of the map: a burr enters bone; the share of the exact answer's peak that the hand feels, beside "
                        "that of an ideal spring")
    parser.add_argument("--feed-forward", action="store_true",
                        help="implicit with its feed-forward of bone's change (coupling.feed_forward of a scene); with --onset both are "
                        "run and drawn, with and without")
    parser.add_argument("--seed", type=whole_within(0, 2**63 - 1), default=1, metavar="N",
                        help="of the random walks or motions (%(default)s)")


def _rate(text: str) -> float:
    if (rate := number(text)) in MILLING_RATES_HZ:
        return rate
    raise argparse.ArgumentTypeError(f"{text} is not one of {', '.join(f'{rate:g}' for rate in MILLING_RATES_HZ)}")


def run(options: argparse.Namespace, study: StudyRun) -> None:
    _require_what_belongs_together(options)
    if options.rails:
        stability_rails.run(options, study)
    elif options.onset:
        stability_onset.run(options, study)
    elif options.sites:
        stability_sites.run(options, study)
    else:
        run_map(options, study)


def _require_what_belongs_together(options: argparse.Namespace) -> None:
    instead = [f"--{name}" for name in ("onset", "rails", "sites") if getattr(options, name)]
    if len(instead) > 1:
        raise UsageError(f"{instead[0]} excludes {instead[1]}")
    for name in OF_THE_MAP:
        if (options.sites or options.onset) and getattr(options, name):
            raise UsageError(f"{instead[0]} excludes --{name.replace('_', '-')}")
    if options.onset and options.edge_forces:
        raise UsageError("--onset excludes --edge-forces: the impulse of edges that rub depends on how long they do")
    for name in ("walks", "only"):
        if getattr(options, name) and not options.sites:
            raise UsageError(f"--{name} requires --sites")


def selected_points(options: argparse.Namespace) -> list[Point]:
    """A list that was not given leaves its axis whole."""
    wanted = {"method": options.methods, "grip": options.grips, "milling_rate_hz": options.milling_rates_hz,
              "delay_ticks": options.delays}
    fed = {"feed_forward": True} if options.feed_forward else {}
    return [point | fed for point in map_points(options.quick, options.edge_forces)
            if all(not values or point[key] in values for key, values in wanted.items())]


def cases_of(points: list[Point]) -> list[dict[str, Any]]:
    """Points grouped by scene and hand, in the order in which these first occur."""
    cases: dict[tuple[Any, ...], list[dict[str, Any]]] = {}
    for point in points:
        rest = {key: value for key, value in point.items() if key not in SCENE}
        cases.setdefault(tuple(point[key] for key in SCENE), []).append(rest)
    return [dict(zip(SCENE, scene)) | {"points": its} for scene, its in cases.items()]


def measure(case: dict[str, Any]) -> list[dict[str, Any]]:
    shared = _studies.SceneCache()
    scene = {key: case[key] for key in SCENE}
    return [_studies.run_map_case(shared, **scene, **{key: value for key, value in point.items() if key != "part"})
            for point in case["points"]]


def name_of(case: dict[str, Any]) -> str:
    scene = (f"cutting {case['depth_mm']:g} mm deep at {case['spindle_rpm']:g} rpm in bone of stiffness {case['relative_stiffness']:g}"
             if case["scene"] == "cutting" else f"wall of {case['wall_n_per_mm']:g} N/mm")
    return f"{scene}, {case['grip']}"


def run_map(options: argparse.Namespace, study: StudyRun) -> None:
    points = selected_points(options)
    if not points:
        raise RuntimeError("nothing of the map is selected")
    cases = cases_of(points)
    found = {_key(case | point): outcome for case, outcomes in zip(cases, study.sweep(measure, cases, name_of))
             for point, outcome in zip(case["points"], outcomes)}
    outcomes = [found[_key(point)] for point in points]
    whole = stability_map.map_of(points, outcomes)
    selection = {"quick": options.quick, "methods": options.methods or [], "grips": options.grips or [],
                 "milling_rates_hz": options.milling_rates_hz or [], "delays_ticks": options.delays or [],
                 "edge_forces": options.edge_forces, "feed_forward": options.feed_forward}
    tables = {"map": stability_map.table_of(whole, outcomes[0]), "region_rows": stability_regions.row_table_of(whole),
              "errors": stability_regions.error_table_of(whole)}
    for scene in ("cutting", "wall"):
        tables[f"regions_{scene}"] = stability_regions.region_table_of(whole, scene)
        tables[f"pareto_{scene}"] = stability_regions.pareto_table_of(whole, scene)
    for name, table in tables.items():
        study.table(name, table)
    study.json("map", stability_map.summary_of(whole, selection))
    _draw(study, tables, options.edge_forces)
    for line in stability_map.lines_of(whole):
        study.say(line)
    study.say(f"map.json, tables (CSV) and charts (SVG) are in {study.out}")


def _key(point: dict[str, Any]) -> str:
    return json.dumps({key: value for key, value in point.items() if key != "points"}, sort_keys=True)


def _draw(study: StudyRun, tables: dict[str, Any], edge_forces: bool) -> None:
    from osteomill.studies import stability_charts

    study.chart("map_cutting", stability_charts.regions(tables["regions_cutting"], tables["region_rows"], "cutting"))
    if not edge_forces:  # with edges that rub there is no wall, which the others compare with
        study.chart("map_wall", stability_charts.regions(tables["regions_wall"], tables["region_rows"], "wall"))
        study.chart("map_pareto", stability_charts.pareto(tables["pareto_cutting"], tables["pareto_wall"]))
        study.chart("map_errors", stability_charts.errors(tables["errors"]))
