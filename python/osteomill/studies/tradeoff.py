"""Speed against accuracy, for every choice that costs time: one page, with the published method, the default, the front of the
best, and the needs of each built-in scene.

Each part is in a file of its own, which describes its measurement: tradeoff_force.py, tradeoff_coupling.py, tradeoff_picture.py,
tradeoff_cues.py, tradeoff_link.py; beside them the cost of a frame as bone and window grow: tradeoff_scaling.py. Times hold for
the machine that measured them; compare them within a chart.
"""

import argparse
from typing import TYPE_CHECKING, Any

from osteomill.studies import tradeoff_coupling, tradeoff_cues, tradeoff_force, tradeoff_link, tradeoff_picture, tradeoff_scaling
from osteomill.studies.study_run import StudyRun

if TYPE_CHECKING:
    import pandas as pd

NAME = "tradeoff"
HELP = "speed against accuracy, on one page, for every choice that costs time"
JOBS = 1  # it measures times
ONE_BY_ONE = True


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--quick", action="store_true", help="fewer choices, shorter runs: a minute")


# Scenes of picture and link; the other bones would take --quick longer to make than to measure.
QUICK_SCENES = ("tooth",)
MEASURED_BY = {"force": tradeoff_force.measure, "coupling": tradeoff_coupling.measure, "picture": tradeoff_picture.measure,
               "cue": tradeoff_cues.measure, "link": tradeoff_link.measure, "scaling": tradeoff_scaling.measure}


def cases(quick: bool) -> list[dict[str, Any]]:
    """Picture and link scene by scene, so that a bone is made once."""
    scenes = list(QUICK_SCENES if quick else tradeoff_force.SCENES)
    made = tradeoff_force.cases(quick) + tradeoff_coupling.cases(quick)
    shown = tradeoff_picture.cases(scenes, quick) + tradeoff_cues.cases(quick) + tradeoff_link.cases(scenes, quick) + tradeoff_scaling.cases(quick)
    order = [tradeoff_picture.TRIED_SCENE, *(scene for scene in scenes if scene != tradeoff_picture.TRIED_SCENE)]
    return made + sorted(shown, key=lambda case: order.index(case["scene"]))


def measure(case: dict[str, Any]) -> dict[str, Any]:
    return MEASURED_BY[case["part"]](case)


def _name_of(case: dict[str, Any]) -> str:
    return ", ".join(str(case[key]) for key in ("part", "scene", "family", "method", "content", "label", "view", "frame_rate_hz") if key in case)


def tables_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> "dict[str, pd.DataFrame]":
    """Tables by name, each of tradeoff_NAME.csv."""
    found: dict[str, tuple[list[Any], list[Any]]] = {part: ([], []) for part in MEASURED_BY}
    for case, outcome in zip(choices, outcomes):
        found[case["part"]][0].append(case)
        found[case["part"]][1].append(outcome)
    force = tradeoff_force.table_of(*found["force"])
    picture = tradeoff_picture.table_of(*found["picture"])
    link = tradeoff_link.table_of(*found["link"])
    return {"force": force, "needs": tradeoff_force.needs_of(force), "coupling": tradeoff_coupling.table_of(*found["coupling"]),
            "picture": picture, "picture_needs": tradeoff_picture.needs_of(picture),
            "picture_cues": tradeoff_cues.table_of(*found["cue"]), "link": link, "link_needs": tradeoff_link.needs_of(link), "scaling": tradeoff_scaling.table_of(*found["scaling"])}


def run(options: argparse.Namespace, study: StudyRun) -> None:
    choices = cases(options.quick)
    tables = tables_of(choices, study.sweep(measure, choices, _name_of))
    for name, table in tables.items():
        study.table(f"tradeoff_{name}", table)
    study.json("tradeoff", {name: table.to_dict("records") for name, table in tables.items()})
    from osteomill.studies.tradeoff_overview import overview_of
    from osteomill.studies.tradeoff_page import page_of

    study.chart("tradeoff", page_of(tables))
    study.chart("tradeoff_overview", overview_of(tables))
    study.chart("tradeoff_scaling", tradeoff_scaling.chart_of(tables["scaling"]))
    study.say(_default_in_words(tables["force"]))
    study.say(f"tradeoff.svg, tradeoff_overview.svg, tradeoff_scaling.svg, the tables (CSV) and tradeoff.json are in {study.out}")


def _default_in_words(force: Any) -> str:
    row = force[force["is_default"] & (force["varied"] == "voxels")].iloc[0]
    published = force[force["is_published"] & (force["varied"] == "voxels")].iloc[0]
    return (f"force: the default takes {row.step_us:.1f} us a step, {row.times_faster:.0f} times less than the published "
            f"method, and is off by {row.error_percent:.2f} % (published {published.error_percent:.2f} %)")
