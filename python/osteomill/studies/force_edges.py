"""Dependence of a slot's force on the number of the burr's edges and on the speed of its spindle.

A 5 mm burr, 6 mm/s, 1 mm deep. By edges: at 2500 rpm, so that a tooth period is long beside the 0.1 ms of a step, and
within it (milling-instants). The mean is of the vector over whole revolutions, the peak the 99th percentile of the
force's length over its own revolution's mean. By speed: the mean alone.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from osteomill import Burr, _studies
from osteomill.studies.force_series import ForceSeries

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FEED_MM_PER_S, DEPTH_MM, DIAMETER_MM = 6.0, 1.0, 5.0
RESOLVED_RPM, RESOLVED_HZ = 2500.0, 10_000.0
EDGES = (1, 2, 3, 4, 6, 8, 12)
SPEEDS_RPM = (10_000.0, 20_000.0, 40_000.0, 80_000.0)
RUN_IN_REVOLUTIONS, REVOLUTIONS = 2, 8


def cases(quick: bool) -> list[dict[str, Any]]:
    return ([{"part": "edges", "edges": edges, "rpm": RESOLVED_RPM} for edges in (EDGES[::3] if quick else EDGES)]
            + [{"part": "edges", "edges": 6, "rpm": rpm} for rpm in (SPEEDS_RPM[::3] if quick else SPEEDS_RPM)])


def measure(case: dict[str, Any]) -> dict[str, float]:
    burr = Burr(diameter_mm=DIAMETER_MM, edges=case["edges"], rpm=case["rpm"])
    slot = _studies.SteadyCase("slot", burr, FEED_MM_PER_S, DEPTH_MM)
    if case["rpm"] != RESOLVED_RPM:
        mean_n = float(np.linalg.norm(ForceSeries(*slot.run(_studies.Milling(), milling_rate_hz=1000.0)).mean_force_n()))
        return {"mean_n": mean_n, "one_tooth_n": mean_n / case["edges"], "peak_over_mean": np.nan, "chip_um": _chip_um(case)}
    steps = round(60.0 / RESOLVED_RPM * RESOLVED_HZ)  # of a revolution
    travel_mm = FEED_MM_PER_S * (RUN_IN_REVOLUTIONS + REVOLUTIONS) * 60.0 / RESOLVED_RPM
    series = ForceSeries(*slot.run(_studies.Milling(summation="instants"), milling_rate_hz=RESOLVED_HZ, travel_mm=travel_mm))
    turns_n = series.force_n[RUN_IN_REVOLUTIONS * steps :][: REVOLUTIONS * steps].reshape(-1, steps, 3)
    lengths_n = np.linalg.norm(turns_n, axis=2)
    mean_n = float(np.linalg.norm(turns_n.mean(axis=1), axis=1).mean())
    return {"mean_n": mean_n, "one_tooth_n": mean_n / case["edges"],
            "peak_over_mean": float(np.percentile(lengths_n / lengths_n.mean(axis=1, keepdims=True), 99)), "chip_um": _chip_um(case)}


def _chip_um(case: dict[str, Any]) -> float:
    """Feed of a tooth."""
    return float(1000.0 * FEED_MM_PER_S / (case["edges"] * case["rpm"] / 60.0))


def table_of(of: list[dict[str, Any]], outcomes: list[dict[str, float]]) -> pd.DataFrame:
    return pd.DataFrame([{"rpm": case["rpm"], "edges": case["edges"]} | found for case, found in zip(of, outcomes)])


def chart_of(table: pd.DataFrame) -> "Figure":
    from osteomill.studies import charts

    figure = charts.figure(10.0, 4.4)
    figure.suptitle("Edges of the burr and speed of the spindle: 5 mm, 6 mm/s, a slot 1 mm deep")
    edges, speeds = figure.subplots(1, 2)
    rows = table[table["rpm"] == RESOLVED_RPM]
    for column, label, colour in (("mean_n", "mean, of all edges", charts.BLUE), ("one_tooth_n", "mean of one tooth", charts.GREEN)):
        edges.plot(rows["edges"], rows[column], marker="o", color=colour, label=label)
    edges.plot(rows["edges"], rows["mean_n"] * rows["peak_over_mean"], marker="^", color=charts.RED, label="peak within a tooth period")
    edges.set(xlabel="edges, 2500 rpm", ylabel="force, N", ylim=(0.0, None))
    rows = table[table["rpm"] != RESOLVED_RPM]
    speeds.plot(rows["rpm"] / 1000.0, rows["mean_n"], marker="o", color=charts.BLUE, label="mean, 6 edges")
    speeds.set(xlabel="spindle, 1000 rpm", ylabel="force, N", ylim=(0.0, None))
    edges.legend()
    speeds.legend()
    return figure
