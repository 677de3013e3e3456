"""Speed against accuracy of the couplings between model and hand: the time of a haptic tick, the error of the force against the
truth in continuous time, and the share of the range in which the coupling is stable.

The points are those of the study `stability --quick`: slots and walls, three grips, milling at 100 Hz and 1 kHz, up to
a tick of delay. Error: rms of the force about the truth's, median over the stable points. Ticks are timed on a hand
that leads a burr along a slot.
"""

import functools
from typing import Any

import numpy as np
import pandas as pd

from osteomill import _studies
from osteomill.studies.stability_points import METHODS, Point, map_points

DEFAULT = "implicit"
PUBLISHED = "interpolate"  # the published line between two forces of the model
WHOLE_RANGE = "slots and walls, three grips, milling at 100 Hz and 1 kHz, up to a tick of delay"
QUICK_RANGE = "slots, three grips, milling at 1 kHz, no delay"
QUICK_METHODS = ("implicit", "virtual-coupling", "hold", "interpolate", "sample-estimate-hold")


def cases(quick: bool) -> list[dict[str, Any]]:
    return [{"part": "coupling", "method": method, "quick": quick} for method in METHODS
            if not quick or method in QUICK_METHODS]


@functools.cache
def _shared() -> _studies.SceneCache:
    return _studies.SceneCache()


def points_of(method: str, quick: bool) -> list[Point]:
    """Points of the map itself, on an ideal device. Quick: cutting alone, at 1 kHz and without a delay."""
    return [{key: value for key, value in point.items() if key != "part"} for point in map_points(True, False)
            if point["part"] == "map" and point["method"] == method
            and (not quick or (point["scene"] == "cutting" and point["milling_rate_hz"] == 1000.0 and point["delay_ticks"] == 0))]


def measure(case: dict[str, Any]) -> dict[str, Any]:
    outcomes = [_studies.run_map_case(_shared(), **point) for point in points_of(case["method"], case["quick"])]
    stable = [outcome for outcome in outcomes if outcome["is_stable"]]
    errors = [outcome["rms_error_n"] / outcome["truth_mean_n"] for outcome in stable]
    return {"points": len(outcomes), "stable_percent": 100.0 * len(stable) / len(outcomes),
            "rms_error_percent": 100.0 * float(np.median(errors)) if errors else None,
            "tick_us": float(np.median(_studies.coupling_tick_us(case["method"], 200 if case["quick"] else 600)))}


def table_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    table = pd.DataFrame([{"method": case["method"], "range": QUICK_RANGE if case["quick"] else WHOLE_RANGE} | found for case, found in zip(choices, outcomes)])
    table["is_default"] = table["method"] == DEFAULT
    table["is_published"] = table["method"] == PUBLISHED
    return table
