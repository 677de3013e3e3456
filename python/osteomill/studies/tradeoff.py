"""Speed against accuracy, for every choice that costs time: one page, with the published method, the default, the front of the
best, and the needs of each built-in scene.

Each part is in a file of its own, which describes its measurement: tradeoff_force.py, tradeoff_coupling.py, tradeoff_picture.py,
tradeoff_cues.py, tradeoff_link.py. Beside the page stand the cost of a frame as bone and window grow (tradeoff_scaling.py), of
virtual fixtures (tradeoff_fixtures.py) and of the states of milling as data (tradeoff_states.py), a chart each. Times hold for the
machine that measured them; compare them within a chart.
"""

import argparse
from typing import TYPE_CHECKING, Any

from osteomill.studies import (tradeoff_coupling, tradeoff_cues, tradeoff_fixtures, tradeoff_force, tradeoff_link, tradeoff_picture,
                               tradeoff_scaling, tradeoff_states)
from osteomill.studies.options import listed, one_of
from osteomill.studies.states_motions import name_of
from osteomill.studies.study_run import StudyRun

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

NAME = "tradeoff"
HELP = "speed against accuracy, on one page, for every choice that costs time"
JOBS = 1  # it measures times
ONE_BY_ONE = True


# Scenes of picture and link; the other bones would take --quick longer to make than to measure.
QUICK_SCENES = ("tooth",)
MEASURED_BY = {"force": tradeoff_force.measure, "coupling": tradeoff_coupling.measure, "picture": tradeoff_picture.measure,
               "cue": tradeoff_cues.measure, "link": tradeoff_link.measure, "scaling": tradeoff_scaling.measure,
               "fixture": tradeoff_fixtures.measure, "states": tradeoff_states.measure}
ON_THE_PAGE = ("force", "coupling", "picture", "cue", "link")
# Each part's table: its name, how it is made. Tables of what the built-in scenes need: of which table, how.
TABLES: dict[str, Any] = {
    "force": ("force", tradeoff_force.table_of), "coupling": ("coupling", tradeoff_coupling.table_of),
    "picture": ("picture", tradeoff_picture.table_of), "cue": ("picture_cues", tradeoff_cues.table_of),
    "link": ("link", tradeoff_link.table_of), "scaling": ("scaling", tradeoff_scaling.table_of),
    "fixture": ("fixtures", tradeoff_fixtures.table_of), "states": ("states", tradeoff_states.table_of)}
NEEDS: dict[str, Any] = {"needs": ("force", tradeoff_force.needs_of), "picture_needs": ("picture", tradeoff_picture.needs_of),
                         "link_needs": ("link", tradeoff_link.needs_of)}


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--quick", action="store_true", help="fewer choices, shorter runs: a minute")
    parser.add_argument("--parts", type=listed(one_of(*MEASURED_BY)), metavar="PART,...",
                        help=f"of {', '.join(MEASURED_BY)} (default: all); the page takes the first five")


def cases(quick: bool) -> list[dict[str, Any]]:
    """Picture and link scene by scene, so that a bone is made once."""
    scenes = list(QUICK_SCENES if quick else tradeoff_force.SCENES)
    made = tradeoff_force.cases(quick) + tradeoff_coupling.cases(quick) + tradeoff_fixtures.cases(quick) + tradeoff_states.cases(quick)
    shown = tradeoff_picture.cases(scenes, quick) + tradeoff_cues.cases(quick) + tradeoff_link.cases(scenes, quick) + tradeoff_scaling.cases(quick)
    order = [tradeoff_picture.TRIED_SCENE, *(scene for scene in scenes if scene != tradeoff_picture.TRIED_SCENE)]
    return made + sorted(shown, key=lambda case: order.index(case["scene"]))


def measure(case: dict[str, Any]) -> dict[str, Any]:
    return MEASURED_BY[case["part"]](case)


def _name_of(case: dict[str, Any]) -> str:
    if case["part"] == "states":
        return f"states, {name_of(case['motion'])}"
    return ", ".join(str(case[key]) for key in ("part", "scene", "family", "method", "content", "label", "view", "frame_rate_hz", "grip") if key in case)


def tables_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> "dict[str, pd.DataFrame]":
    """Tables by name, each of tradeoff_NAME.csv; only of parts that were measured."""
    found: dict[str, tuple[list[Any], list[Any]]] = {}
    for case, outcome in zip(choices, outcomes):
        cases_of_part, outcomes_of_part = found.setdefault(case["part"], ([], []))
        cases_of_part.append(case)
        outcomes_of_part.append(outcome)
    tables = {TABLES[part][0]: TABLES[part][1](*measured) for part, measured in found.items()}
    return tables | {name: needs_of(tables[table]) for name, (table, needs_of) in NEEDS.items() if table in tables}


def run(options: argparse.Namespace, study: StudyRun) -> None:
    parts = options.parts or list(MEASURED_BY)
    choices = [case for case in cases(options.quick) if case["part"] in parts]
    tables = tables_of(choices, study.sweep(measure, choices, _name_of))
    for name, table in tables.items():
        study.table(f"tradeoff_{name}", table)
    study.json("tradeoff", {name: table.to_dict("records") for name, table in tables.items()})
    charts = charts_of(tables)
    for name, figure in charts.items():
        study.chart(name, figure)
    if "force" in tables:
        study.say(_default_in_words(tables["force"]))
    study.say(f"{''.join(f'{name}.svg, ' for name in charts)}the tables (CSV) and tradeoff.json are in {study.out}")


def charts_of(tables: "dict[str, pd.DataFrame]") -> "dict[str, Figure]":
    """By name; the page and its overview where all of their parts were measured."""
    from osteomill.studies.tradeoff_overview import overview_of
    from osteomill.studies.tradeoff_page import page_of

    drawn = {}
    if all(TABLES[part][0] in tables for part in ON_THE_PAGE):
        drawn = {"tradeoff": page_of(tables), "tradeoff_overview": overview_of(tables)}
    for part, chart_of in (("scaling", tradeoff_scaling.chart_of), ("fixtures", tradeoff_fixtures.chart_of), ("states", tradeoff_states.chart_of)):
        if part in tables:
            drawn[f"tradeoff_{part}"] = chart_of(tables[part])
    return drawn


def _default_in_words(force: Any) -> str:
    row = force[force["is_default"] & (force["varied"] == "voxels")].iloc[0]
    published = force[force["is_published"] & (force["varied"] == "voxels")].iloc[0]
    return (f"force: the default takes {row.step_us:.1f} us a step, {row.times_faster:.0f} times less than the published "
            f"method, and is off by {row.error_percent:.2f} % (published {published.error_percent:.2f} %)")
