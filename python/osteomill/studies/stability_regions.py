"""Tables behind the charts of the stability map: regions as boxes, errors against resistance, share against error."""

import math
from typing import Any

import numpy as np
import pandas as pd

from osteomill.studies.stability_map import scores
from osteomill.studies.stability_points import DELAYS_TICKS, GRIPS, METHODS, MILLING_RATES_HZ

GAP_BETWEEN_RATES = 0.5
STRIP_DISTANCE = 0.3
ONE_COLUMN = 1.03  # the scatter of one resistance as runs measure it
LONE_COLUMN = 1.4
SMALLEST_DRAWN_PERCENT = 0.01  # a logarithmic axis has no zero


def number_of(method: str) -> int:
    """1 for the first of METHODS."""
    return METHODS.index(method) + 1


def rows_of(whole: pd.DataFrame) -> dict[tuple[float, int], float]:
    """Row of each milling rate and delay in the map: the fastest rate on top, delays downward."""
    of_map = whole[whole["part"] == "map"]
    rates = [rate for rate in MILLING_RATES_HZ if (of_map["milling_rate_hz"] == rate).any()]
    delays = [delay for delay in DELAYS_TICKS if (of_map["delay_ticks"] == delay).any()]
    return {(rate, delay): i * (len(delays) + GAP_BETWEEN_RATES) + len(delays) - j
            for i, rate in enumerate(rates) for j, delay in enumerate(delays)}


def row_table_of(whole: pd.DataFrame) -> pd.DataFrame:
    """The name of each row: of the first of a rate that rate, too."""
    rows = rows_of(whole)
    first = min((delay for _, delay in rows), default=0)
    return pd.DataFrame([{"y": float(y), "label": (f"{rate:.0f} Hz  " if delay == first else "") + str(delay)}
                         for (rate, delay), y in rows.items()], columns=["y", "label"])


def region_table_of(whole: pd.DataFrame, scene: str) -> pd.DataFrame:
    """A box for each run of neighbouring points of the map that are alike: boxes meet halfway (on a logarithmic scale)
    between points; y is the middle of a strip, a strip for each grip in the order of GRIPS."""
    here = whole[(whole["part"] == "map") & (whole["scene"] == scene)]
    boxes = []
    edges = edges_between(columns_of(here["x"]))
    for method in METHODS:
        for place, grip in enumerate(GRIPS):
            of_grip = here[(here["method"] == method) & (here["grip"] == grip)]
            for (rate, delay), y in rows_of(whole).items():
                strip = of_grip[(of_grip["milling_rate_hz"] == rate) & (of_grip["delay_ticks"] == delay)]
                boxes += [{"number": number_of(method), "method": method, "grip": place + 1, "x_low": low, "x_high": high,
                           "y": y + STRIP_DISTANCE * (1.0 - place), "stable": stable}
                          for low, high, stable in runs_of(strip, edges)]
    return pd.DataFrame(boxes, columns=["number", "method", "grip", "x_low", "x_high", "y", "stable"])


def columns_of(x: "pd.Series[float]") -> list[float]:
    """Values that differ by more than the scatter of one resistance."""
    columns: list[float] = []
    for value in sorted(x):
        if not columns or value > ONE_COLUMN * columns[-1]:
            columns.append(value)
    return columns


def edges_between(columns: list[float]) -> list[float]:
    """The outermost boxes are as wide as the step beside them."""
    if not columns:
        return []
    first, last = LONE_COLUMN, LONE_COLUMN
    if len(columns) > 1:
        first, last = math.sqrt(columns[1] / columns[0]), math.sqrt(columns[-1] / columns[-2])
    between = [math.sqrt(low * high) for low, high in zip(columns, columns[1:])]
    return [columns[0] / first, *between, columns[-1] * last]


def runs_of(strip: pd.DataFrame, edges: list[float]) -> list[tuple[float, float, bool]]:
    """Neighbouring boxes that are alike, of points that differ in x alone."""
    runs: list[tuple[float, float, bool]] = []
    for _, point in strip.sort_values("x", kind="stable").iterrows():
        above = int(np.searchsorted(edges, point["x"], side="right"))
        low, high, stable = edges[above - 1], edges[above], bool(point["is_stable"])
        if runs and runs[-1][2] == stable and runs[-1][1] == low:
            runs[-1] = (runs[-1][0], high, stable)
        else:
            runs.append((low, high, stable))
    return runs


def error_table_of(whole: pd.DataFrame) -> pd.DataFrame:
    """Errors in cutting, milling at 1000 Hz, no delay: a curve for each method and grip."""
    here = whole[(whole["part"] == "map") & (whole["scene"] == "cutting") & (whole["milling_rate_hz"] == 1000.0)
                 & (whole["delay_ticks"] == 0)]
    rows: list[dict[str, Any]] = []
    for method in METHODS:
        for grip in GRIPS:
            curve = here[(here["method"] == method) & (here["grip"] == grip)]
            rows += [{"number": number_of(method), "method": method, "grip": grip, "resistance_n_s_per_m": point["x"],
                      "rms_error_percent": 100.0 * point["rms_error"], "stable": bool(point["is_stable"])}
                     for _, point in curve.sort_values("x", kind="stable").iterrows()]
    return pd.DataFrame(rows, columns=["number", "method", "grip", "resistance_n_s_per_m", "rms_error_percent", "stable"])


def pareto_table_of(whole: pd.DataFrame, scene: str) -> pd.DataFrame:
    """Share and median error in percent; no error if a method is stable nowhere."""
    found = scores(whole, "map", scene)
    return pd.DataFrame({"number": [number_of(method) for method in found["method"]], "method": found["method"],
                         "stable_percent": 100.0 * found["share"],
                         "rms_error_percent": (100.0 * found["median_rms_error"]).clip(lower=SMALLEST_DRAWN_PERCENT)})
