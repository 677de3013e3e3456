"""Random steady motions of a hand on rails: the difference of the mean force on the hand from the milling model's.

Burrs of 1 to 5 mm, spindles that lean by up to 60 degrees, feeds from 1 mm/s, depths from 0.12 mm to the equator, over a
surface that lies anyhow. A coupling stands between the model and a hand that is led; each motion goes on for three
quarters of a second to get there and a quarter that is measured, milling and haptic loop at 1 kHz. Motions in which bone
drives the burr off are counted apart.
"""

import argparse
import functools
import json
from typing import Any

import numpy as np

from osteomill import _studies
from osteomill.studies.force_series import relative_error
from osteomill.studies.study_run import StudyRun

EDGES_N_PER_MM = (0.3, 0.3, 0.0)


@functools.lru_cache(maxsize=4)
def _motions(count: int, seed: int) -> list[_studies.SteadyCase]:
    return _studies.motions_on_rails(count, seed)


def motion_of(case: dict[str, Any]) -> _studies.SteadyCase:
    motion = _motions(case["count"], case["seed"])[int(case["index"])]
    return motion.with_edges(EDGES_N_PER_MM) if case["edge_forces"] else motion


def measure(case: dict[str, Any]) -> dict[str, Any]:
    hand_n, model_n, is_driven = _studies.run_on_rails(motion_of(case), case["method"], case["feed_forward"])
    return {"error": relative_error(hand_n, model_n), "is_driven": is_driven}


def run(options: argparse.Namespace, study: StudyRun) -> None:
    methods = options.methods or ["implicit"]
    drawn = {"count": options.rails, "seed": options.seed, "edge_forces": options.edge_forces,
             "feed_forward": options.feed_forward}
    cases = [drawn | {"method": method, "index": index} for method in methods
             for index in range(len(_motions(options.rails, options.seed)))]
    outcomes = study.sweep(measure, cases, lambda case: f"{case['method']}, {motion_of(case).name}")
    summary = {method: summary_of([(motion_of(case).name, outcome) for case, outcome in zip(cases, outcomes)
                                   if case["method"] == method]) for method in methods}
    study.json("rails", summary)
    for line in json.dumps(summary, indent=2, ensure_ascii=False).splitlines():
        study.say(line)


def summary_of(results: list[tuple[str, dict[str, Any]]]) -> dict[str, Any]:
    """Number of motions in which bone drove the burr; the error of the others, and the worst by name."""
    steady = {name: 100.0 * outcome["error"] for name, outcome in results if not outcome["is_driven"]}
    errors = list(steady.values())
    median, p95, most = np.percentile(errors, (50, 95, 100)).tolist() if errors else (0.0, 0.0, 0.0)
    return {"cases": len(results), "driven": len(results) - len(errors), "median_error_percent": median,
            "p95_error_percent": p95, "max_error_percent": most, "worst": max(steady, key=steady.__getitem__, default="")}
