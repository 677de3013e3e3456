"""Speed against accuracy, for every choice that costs time: one page, with the published method, the default, the
front of the best, and what each built-in scene needs.

Each part is in a file of its own, which says what it measures: tradeoff_force.py, tradeoff_coupling.py. Times hold for the machine that
measured them; compare them within a chart.
"""

import argparse
from typing import Any

from osteomill.studies import tradeoff_coupling, tradeoff_force
from osteomill.studies.study_run import StudyRun

NAME = "tradeoff"
HELP = "speed against accuracy, on one page, for every choice that costs time"
JOBS = 1  # it measures times
ONE_BY_ONE = True


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--quick", action="store_true", help="fewer choices, shorter runs: a minute")


def measure(case: dict[str, Any]) -> dict[str, Any]:
    return tradeoff_force.measure(case) if case["part"] == "force" else tradeoff_coupling.measure(case)


def _name_of(case: dict[str, Any]) -> str:
    return ", ".join(str(case[key]) for key in ("part", "family", "method", "label") if key in case)


def run(options: argparse.Namespace, study: StudyRun) -> None:
    forces, couplings = tradeoff_force.cases(options.quick), tradeoff_coupling.cases(options.quick)
    outcomes = study.sweep(measure, forces + couplings, _name_of)
    force = tradeoff_force.table_of(forces, outcomes[: len(forces)])
    coupling = tradeoff_coupling.table_of(couplings, outcomes[len(forces) :])
    needs = tradeoff_force.needs_of(force)
    study.table("tradeoff_force", force)
    study.table("tradeoff_needs", needs)
    study.table("tradeoff_coupling", coupling)
    study.json("tradeoff", {
        "force": force.to_dict("records"), "needs": needs.to_dict("records"), "coupling": coupling.to_dict("records")})
    from osteomill.studies.tradeoff_page import page_of

    study.chart("tradeoff", page_of(force, needs, coupling))
    study.say(_default_in_words(force))
    study.say(f"tradeoff.svg, the tables (CSV) and tradeoff.json are in {study.out}")


def _default_in_words(force: Any) -> str:
    row = force[force["is_default"] & (force["varied"] == "voxels")].iloc[0]
    published = force[force["is_published"] & (force["varied"] == "voxels")].iloc[0]
    return (f"force: the default takes {row.step_us:.1f} us a step, {row.times_faster:.0f} times less than the published "
            f"method, and is off by {row.error_percent:.2f} % (published {published.error_percent:.2f} %)")
