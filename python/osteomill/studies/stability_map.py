"""Evaluation of a whole stability map: the range in which each coupling holds, its error there, and the bars that `implicit`
promises over the range that a surgeon reaches.

A map is a table with a line for each point: its conditions, whether it was stable, and the numbers of its run beside the truth in
continuous time (studies/stability/map/map_run.h). `x` is the varied quantity of the scene: the resistance of the bone in N
s/m, or the wall's stiffness in N/mm. Errors are shares of the truth's mean force, without a value if that is 0.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from osteomill.studies.stability_points import GRIPS, METHODS, SCENES, Point, text_of

COLUMNS = ("part", "method", "scene", "grip", "milling_rate_hz", "delay_ticks", "is_ideal_device", "spindle_rpm", "depth_mm",
           "relative_stiffness", "wall_n_per_mm")

# A device answers at once or a tick late: beyond that the map shows where `implicit` ends, and promises nothing.
MOST_PROMISED_DELAY_TICKS = 1
MOST_RMS_ERROR_PERCENT = 3.0
MOST_MEAN_ERROR_PERCENT = 2.0
MOST_FORCE_N = 3.3  # of the device
MOST_JUMP_N = 0.3
MOST_RATE_DEPENDENCE_PERCENT = 2.0
MOST_RESIDUAL_N = 1e-3


def map_of(points: list[Point], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    whole = pd.DataFrame([point | outcome for point, outcome in zip(points, outcomes)])
    whole["x"] = whole["resistance_n_s_per_m"].where(whole["scene"] == "cutting", whole["wall_n_per_mm"])
    truth_n = whole["truth_mean_n"].where(whole["truth_mean_n"] > 0.0)
    whole["rms_error"] = whole["rms_error_n"] / truth_n
    whole["mean_error"] = whole["mean_error_n"] / truth_n
    whole["text"] = [text_of(point) for point in points]
    return whole


def table_of(whole: pd.DataFrame, outcome: dict[str, Any]) -> pd.DataFrame:
    """A line for each point; `outcome`: any one, which names the numbers."""
    return whole[[*COLUMNS, *outcome]]


def scores(whole: pd.DataFrame, part: str, scene: str) -> pd.DataFrame:
    """A line for each method that the map has, in the order of METHODS: cases, how many are stable; over these the median
    and worst errors; `common_rms_error`: over the cases that are stable with every method of the map, so that easy cases of the
    others do not distort the comparison."""
    here = whole[(whole["part"] == part) & (whole["scene"] == scene)]
    case = [column for column in (*COLUMNS, "edge_n_per_mm") if column != "method"]
    common = here.groupby(case)["is_stable"].transform("all").astype(bool) if len(here) else here["is_stable"]
    rows = []
    for method in METHODS:
        of_method = here[here["method"] == method]
        if of_method.empty:
            continue
        stable = of_method[of_method["is_stable"]]
        rows.append({"method": method, "cases": len(of_method), "stable": len(stable), "share": len(stable) / len(of_method),
                     "median_rms_error": stable["rms_error"].median(), "worst_rms_error": stable["rms_error"].max(),
                     "median_mean_error": stable["mean_error"].median(),
                     "common_rms_error": stable.loc[common[stable.index], "rms_error"].median()})
    return pd.DataFrame(rows, columns=["method", "cases", "stable", "share", "median_rms_error", "worst_rms_error",
                                       "median_mean_error", "common_rms_error"])


def bars_of(whole: pd.DataFrame) -> list[dict[str, Any]]:
    """Each with its name, the bar, the worst value in the map, whether the bar is met, and the place of the worst; none if the
    map lacks the part of the bars."""
    if not (whole["part"] == "bars").any():
        return []
    promised = whole[(whole["method"] == METHODS[0]) & (whole["delay_ticks"] <= MOST_PROMISED_DELAY_TICKS)]
    slots = promised[(promised["scene"] == "cutting") & promised["is_ideal_device"]]
    held = slots[slots["is_stable"]]
    walls = promised[(promised["scene"] == "wall") & promised["is_ideal_device"]]
    on_real_device = promised[(promised["scene"] == "cutting") & ~promised["is_ideal_device"]]
    return [
        _unstable("cutting that is unstable, %", slots),
        _worst("rms error of the force, % of its mean", MOST_RMS_ERROR_PERCENT, held, 100.0 * held["rms_error"]),
        _worst("error of the mean force, %", MOST_MEAN_ERROR_PERCENT, held, 100.0 * held["mean_error"]),
        _worst("largest force, N", MOST_FORCE_N, slots, slots["peak_n"]),
        _worst("largest jump between ticks, N", MOST_JUMP_N, slots, slots["largest_jump_n"]),
        _worst("bone carved, 100 Hz against 1000 Hz, %", MOST_RATE_DEPENDENCE_PERCENT, slots, rate_dependence_percent(slots)),
        _unstable("walls that are unstable, %", walls),
        _worst("largest jump between ticks, cutting on a real device, N", MOST_JUMP_N, on_real_device,
               on_real_device["largest_jump_n"]),
        _worst("force that a contact solve left over, N", MOST_RESIDUAL_N, promised, promised["max_residual_n"]),
        _worst("ticks without a balance on the spring alone", 0.0, promised, promised["fallbacks"]),
        _worst("forces turned off for their energy", 0.0, promised, promised["energy_faults"]),
    ]


def _worst(what: str, bar: float, points: pd.DataFrame, values: "pd.Series[Any]") -> dict[str, Any]:
    """The first of the largest values; without any value none, which meets no bar."""
    measured = values.dropna()
    worst = float(measured.max()) if len(measured) else float("nan")
    return {"what": what, "bar": bar, "worst": worst, "is_met": worst <= bar,
            "where": str(points.loc[measured.idxmax(), "text"]) if len(measured) else ""}


def _unstable(what: str, points: pd.DataFrame) -> dict[str, Any]:
    """The share, and the first that is."""
    unstable = _worst(what, 0.0, points, 100.0 * (~points["is_stable"].astype(bool)))
    if len(points):
        unstable["where"] = unstable["where"] if unstable["worst"] > 0.0 else ""
        unstable["worst"] = 100.0 * (1.0 - points["is_stable"].mean())
        unstable["is_met"] = unstable["worst"] <= 0.0
    return unstable


def rate_dependence_percent(slots: pd.DataFrame) -> "pd.Series[float]":
    """Difference of the bone carved at 100 Hz from that of the same point at 1000 Hz; no value at other rates."""
    same = [column for column in (*COLUMNS, "edge_n_per_mm") if column not in ("part", "milling_rate_hz")]
    fast = slots[(slots["milling_rate_hz"] == 1000.0) & (slots["removed_mm3"] > 0.0)].drop_duplicates(same)
    beside = slots[same].merge(fast[[*same, "removed_mm3"]], how="left", on=same)["removed_mm3"].to_numpy()
    percent = 100.0 * (slots["removed_mm3"] / beside - 1.0).abs()
    return percent.where(slots["milling_rate_hz"] == 100.0)


def summary_of(whole: pd.DataFrame, selection: dict[str, Any]) -> dict[str, Any]:
    methods: dict[str, Any] = {}
    for scene in SCENES:
        for _, score in scores(whole, "map", scene).iterrows():
            methods.setdefault(score["method"], {})[scene] = _summary_of_method(whole, score, scene)
    return {"cases": len(whole), "selection": selection, "methods": methods, "bars": bars_of(whole)}


def _summary_of_method(whole: pd.DataFrame, score: Any, scene: str) -> dict[str, Any]:
    of_method = whole[(whole["method"] == score["method"]) & (whole["scene"] == scene)]
    here, real = (of_method[of_method["part"] == part] for part in ("map", "real-device"))

    def shares_by(column: str, name: Callable[[Any], str] = "{:g}".format) -> dict[str, float]:
        shares = here.groupby(column, sort=False)["is_stable"].mean()
        return {name(value): float(share) for value, share in shares.items()}

    by_grip = shares_by("grip", str)
    summary = {
        "cases": score["cases"], "stable": score["stable"], "stable_share": score["share"],
        "by_grip": {grip: by_grip[grip] for grip in GRIPS if grip in by_grip},
        "by_milling_rate_hz": shares_by("milling_rate_hz"), "by_delay_ticks": shares_by("delay_ticks"),
        "stable_up_to_n_s_per_m" if scene == "cutting" else "stable_up_to_n_per_mm": {grip: stable_up_to(here, grip) for grip in GRIPS},
        "rms_error_percent": {"median": 100.0 * score["median_rms_error"], "worst": 100.0 * score["worst_rms_error"],
                              "median_where_all_are_stable": 100.0 * score["common_rms_error"]},
        "mean_error_percent": {"median": 100.0 * score["median_mean_error"]},
    }
    if len(real):
        summary["stable_share_on_real_device"] = float(real["is_stable"].mean())
    return summary


def stable_up_to(here: pd.DataFrame, grip: str) -> float:
    """The largest resistance (or wall) up to which everything is stable with that grip at 1000 Hz without delay; 0 if not even
    the least is."""
    line = here[(here["grip"] == grip) & (here["milling_rate_hz"] == 1000.0) & (here["delay_ticks"] == 0)]
    least_unstable = line.loc[~line["is_stable"].astype(bool), "x"].min()
    held = line["x"] if np.isnan(least_unstable) else line.loc[line["x"] < least_unstable, "x"]
    return float(held.max()) if len(held) else 0.0


def lines_of(whole: pd.DataFrame) -> list[str]:
    """A line a method, then a line a bar."""
    def percent(score: Any, number: str) -> str:
        return "-" if score is None or np.isnan(score[number]) else f"{100.0 * score[number]:.1f}"

    def row(*cells: str) -> str:
        return f"{cells[0]:<31}" + "".join(f"{cell:>{width}}" for cell, width in zip(cells[1:], (8, 6, 9, 7, 8, 6, 9)))

    walls, real = ({score["method"]: score for _, score in scores(whole, part, scene).iterrows()}
                   for part, scene in (("map", "wall"), ("real-device", "cutting")))
    lines = [row("%", "cutting", "rms", "rms, all", "real", "wall", "rms", "rms, all")]
    for _, score in scores(whole, "map", "cutting").iterrows():
        method = score["method"]
        lines.append(row(method, *(percent(score, number) for number in ("share", "median_rms_error", "common_rms_error")),
                         percent(real.get(method), "share"),
                         *(percent(walls.get(method), number) for number in ("share", "median_rms_error", "common_rms_error"))))
    lines.append("cutting, wall: share that is stable; rms: median error there; rms, all: where every method is stable; real: "
                 "share of cutting on a real device")
    return lines + [_said_of(bar) for bar in bars_of(whole)]


def _said_of(bar: dict[str, Any]) -> str:
    if np.isnan(bar["worst"]):  # as of a map of some grips or rates alone
        return f"-      {bar['what']}: this part of the map has no such point"
    where = f" ({bar['where']})" if bar["where"] else ""
    return f"{'met   ' if bar['is_met'] else 'MISSED'} {bar['what']}: {bar['worst']:.3g}, at most {bar['bar']:.3g}{where}"
