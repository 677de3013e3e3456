"""The published polishing experiment, repeated: depth and force against time, through the published couplings and ours.

Published: a cube of bone, a 5 mm burr, a user who slides it at about 6 mm/s for about 40 mm in about 7 s down to
3.5 mm below the surface, forces of 0.3 to 0.7 N. Not published: spindle speed, tilt, and how the slide lies on the
bone. In one stroke it is a fresh slot, whose end costs 7.2 N at 10 000 rpm, more than twice what the arm renders; the simulated
hand, which waits for a tool that is held back, then takes half a minute, and even at 80 000 rpm 8.6 s. Strokes of a few
millimetres to and fro, each a pass some tenths of a millimetre deeper than the one before, need less force, the shorter the less;
but with the shortest ones the force follows the strokes rather than the depth.

Here: five strokes of 8 mm at 80 000 rpm: seven seconds and a half, 3.5 mm, up to 0.6 N. Shapes can be compared with
the published figures, values cannot. The simulated hand slides, in sessions of the simulator on the virtual clock:
milling through the published couplings at 100 Hz and through `implicit` at 1 kHz, and the point spring.
"""

import argparse
import functools
import math
import pathlib
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from osteomill import _studies
from osteomill.studies import polishing_claims
from osteomill.studies.study_run import StudyRun
from osteomill.studies.tables import csv_of

PUBLISHED_RATE_HZ = 100.0
PUBLISHED_COUPLINGS = ("interpolate", "sample-estimate-interpolate", "sample-estimate-hold")
EDGES_N_PER_MM = (0.3, 0.3, 0.0)  # that rub as in cortical bone
TICK_S = 0.001
TICKS_A_LINE = 8  # of the charts' tables: six points in a cycle of 20 Hz

# A hand that follows its motion changes the force within tenths of a second; the limit cycles of sampled contact go at
# 10 Hz (a firm hand at 100 Hz milling) and above. The slow part of a force is its mean over 0.1 s about each moment: it contains
# nothing, or nearly nothing, at 10 Hz and above.
SLOW_PART_S = 0.1
WINDOW_S = 0.1  # window in which to look for chatter: a few of its cycles, a small part of a stroke
# A limit cycle of this rms or more is chatter. Two encoder steps of the arm, 0.055 mm, rendered by the stiffest spring
# that it can, 1.7 N/mm, are 0.19 N: a smaller one may be the sensor's grain, and hides behind the arm's friction of 0.26 N.
CHATTER_N = 0.2

Array = NDArray[np.float64]


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--edge-forces", action="store_true",
                        help="burrs whose edges rub, as in cortical bone; without, the published law")
    parser.add_argument("--quick", action="store_true", help="fewer runs: under half a minute")


def cases(quick: bool, edge_forces: bool) -> list[dict[str, Any]]:
    """The slides of the figures; `quick` leaves `hold` out."""
    couplings = PUBLISHED_COUPLINGS if quick else (*PUBLISHED_COUPLINGS, "hold")
    made = [{"force_model": model, "coupling": coupling, "milling_rate_hz": PUBLISHED_RATE_HZ}
            for model in ("milling", "point-spring") for coupling in couplings]
    made.append({"force_model": "milling", "coupling": "implicit", "milling_rate_hz": 1000.0})
    return [case | {"edge_forces": edge_forces} for case in made]


def name_of(case: dict[str, Any]) -> str:
    if case.get("part") == "edges":
        return f"on rails, edges: {case['edges']}"
    if case.get("part") == "rails":
        return f"on rails at {case['rpm']:g} rpm, strokes of {case['stroke_mm']:g} mm"
    return f"{case['force_model']}_{case['coupling']}"


@functools.cache
def slide_of(edge_forces: bool, stroke_mm: float = 8.0) -> _studies.PolishingSlide:
    return _studies.PolishingSlide(edges_of(edge_forces), stroke_mm=stroke_mm)


def edges_of(edge_forces: bool) -> tuple[float, float, float]:
    return EDGES_N_PER_MM if edge_forces else (0.0, 0.0, 0.0)


def depth_mm(slide: _studies.PolishingSlide, burr_z_mm: Any) -> Any:
    """Depth of the burr's lowest point below the surface."""
    return slide.start_mm[2] + slide.burr_radius_mm - burr_z_mm


def measure(logs: pathlib.Path, case: dict[str, Any]) -> dict[str, Any]:
    edges = edges_of(case["edge_forces"])
    if case.get("part") == "edges":
        return polishing_claims.measure_edges(case["edges"], edges)
    if case.get("part") == "rails":
        return polishing_claims.measure_on_rails(slide_of(case["edge_forces"], case["stroke_mm"]), case["rpm"], edges)
    return measure_by_hand(logs, case)


def measure_by_hand(logs: pathlib.Path, case: dict[str, Any]) -> dict[str, Any]:
    """The record of a slide, a sample a millisecond from the first bone removed on, and how it ended. The session's
    own log is left in the folder `logs`."""
    slide = slide_of(case["edge_forces"])
    log = logs / f"{name_of(case)}.csv"
    reached_end, faults = slide.run(case["force_model"], case["coupling"], case["milling_rate_hz"], log)
    record = pd.read_csv(log)
    record = record[(record["removed_mm3"] > 0.0).cummax()]
    depths_mm = depth_mm(slide, record["burr_z_mm"].to_numpy())
    stray_mm = (record["burr_y_mm"] - slide.start_mm[1]).abs()
    return {"reached_end": reached_end, "faults": faults, "t_s": record["t_s"].to_numpy(), "depth_mm": depths_mm,
            "force_n": record[["force_x_n", "force_y_n", "force_z_n"]].to_numpy(),
            "largest_depth_mm": max(0.0, *depths_mm) if len(depths_mm) else 0.0,
            "stray_mm": float(stray_mm.max()) if len(stray_mm) else 0.0}


def run(options: argparse.Namespace, study: StudyRun) -> None:
    logs = study.file("runs")
    make_folder(logs)
    setups = cases(options.quick, options.edge_forces)
    of_claims = [] if options.quick else polishing_claims.cases(options.edge_forces)
    outcomes = study.sweep(functools.partial(measure, logs), setups + of_claims, name_of)
    found, asked = outcomes[: len(setups)], outcomes[len(setups) :]
    series = {name_of(setup): series_of(record) for setup, record in zip(setups, found)}
    for name, table in series.items():
        study.table(name, table)
    meant = as_meant(slide_of(options.edge_forces))
    study.table("as_meant", meant)
    figures = table_of(setups, found)
    study.table("figures", figures)
    for line in csv_of(figures).splitlines():
        study.say(line)
    from osteomill.studies import polishing_charts

    study.chart("polishing_depth", polishing_charts.depth(series, meant))
    study.chart("polishing_milling", polishing_charts.milling(series))
    study.chart("polishing_point_spring", polishing_charts.point_spring(series))
    if asked:
        rails, by_edges = asked[: -len(polishing_claims.EDGES)], asked[-len(polishing_claims.EDGES) :]
        edges = polishing_claims.edge_table_of(by_edges)
        claims = _claims_of(figures, dict(zip(series, found)), rails, edges)
        study.table("claims", claims)
        for _, claim in claims.iterrows():
            study.say(f"{'holds' if claim['holds'] else 'FAILS'} {claim['claim']} ({claim['where']}): {claim['measured']:.3f} "
                      f"{claim['must_be']} {claim['bar']:g}, {claim['measure']}")
    study.say(f"figures.csv, the runs (CSV) and charts (SVG) are in {study.out}")


def _claims_of(figures: pd.DataFrame, by_hand: dict[str, Any], rails: list[Any], edges: pd.DataFrame) -> pd.DataFrame:
    strokes, single, slow = rails
    records = {"milling, on rails": strokes, "milling, on rails, one stroke": single, "milling, implicit": by_hand["milling_implicit"],
               "point-spring, interpolate": by_hand["point-spring_interpolate"], f"rpm over: {polishing_claims.SLOW_RPM:g}": slow}
    limit_cycles_n = {f"{row['force_model']}, {row['coupling']}": row["limit_cycle_n"] for _, row in figures.iterrows()}
    return polishing_claims.claims_of(records, limit_cycles_n, edges, CHATTER_N)


def make_folder(folder: pathlib.Path) -> None:
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise RuntimeError(f"{folder}: cannot be made a folder: {error.strerror}") from None


def series_of(record: dict[str, Any]) -> pd.DataFrame:
    """Time from first contact, depth and force."""
    t_s = np.array(record["t_s"])
    first_s = t_s[0] if len(t_s) else 0.0
    force_n = np.array(record["force_n"]).reshape(-1, 3)[::TICKS_A_LINE]
    return pd.DataFrame({"t_s": t_s[::TICKS_A_LINE] - first_s, "depth_mm": np.array(record["depth_mm"])[::TICKS_A_LINE],
                         **{f"force_{axis}_n": force_n[:, i] for i, axis in enumerate("xyz")}})


def as_meant(slide: _studies.PolishingSlide) -> pd.DataFrame:
    """The slide without an arm or bone: time from first contact, and depth."""
    def depth_at(time_s: float) -> float:
        return float(depth_mm(slide, slide.meant_mm(time_s)[2]))

    ticks = int(slide.meant_s / TICK_S)
    contact = next((tick for tick in range(ticks) if depth_at(tick * TICK_S) > 0.0), ticks)
    rows = range(0, ticks - contact + 1, TICKS_A_LINE)
    return pd.DataFrame({"t_s": [tick * TICK_S for tick in rows], "depth_mm": [depth_at((contact + tick) * TICK_S) for tick in rows]})


def table_of(setups: list[dict[str, Any]], found: list[dict[str, Any]]) -> pd.DataFrame:
    """A line a run: slide, depth, stray, force, limit cycle, depth at which chatter begins, faults."""
    rows = []
    for setup, record in zip(setups, found):
        t_s, force_n = np.array(record["t_s"]), np.array(record["force_n"]).reshape(-1, 3)
        windows = windows_of(t_s, np.array(record["depth_mm"]), force_n, WINDOW_S)
        rows.append({
            **{key: setup[key] for key in ("force_model", "coupling", "milling_rate_hz")},
            "reached_end": record["reached_end"],
            "slide_s": t_s[-1] - t_s[0] if len(t_s) else 0.0,
            "largest_depth_mm": record["largest_depth_mm"],
            "stray_mm": record["stray_mm"],
            "mean_force_n": float(np.linalg.norm(force_n, axis=1).mean()) if len(force_n) else 0.0,
            "limit_cycle_n": limit_cycle_n(windows),
            "onset_depth_mm": onset_of_chatter_mm(windows),
            "faults": record["faults"],
        })
    return pd.DataFrame(rows)


def windows_of(t_s: Array, depths_mm: Array, force_n: Array, window_s: float) -> pd.DataFrame:
    """The record in windows; the last, if shorter, is left out: their mean depth, and the rms of the force about its
    own slow part. Samples are taken to be evenly spaced. Within half of SLOW_PART_S from either end the slow part is the mean of
    the existing values."""
    length, width = samples_in(t_s, window_s), samples_in(t_s, SLOW_PART_S)
    count = len(t_s) // length
    fast = force_n - moving_mean(force_n, width)
    squares = (fast**2).sum(axis=1)[: count * length].reshape(count, length)
    depths = depths_mm[: count * length].reshape(count, length)
    return pd.DataFrame({"depth_mm": depths.mean(axis=1), "fast_rms_n": np.sqrt(squares.mean(axis=1))})


def samples_in(t_s: Array, span_s: float) -> int:
    """Samples in a span, at least one."""
    period_s = float(t_s[-1] - t_s[0]) / (len(t_s) - 1) if len(t_s) > 1 else math.inf
    return max(1, math.floor(span_s / period_s + 0.5))


def moving_mean(values: Array, width: int) -> Array:
    """Centred mean of so many values on either side that they are about `width` in all."""
    sums = np.vstack([np.zeros((1, values.shape[1])), values.cumsum(axis=0)])
    places = np.arange(len(values))
    first, end = np.maximum(places - width // 2, 0), np.minimum(places + width // 2 + 1, len(values))
    return np.asarray((sums[end] - sums[first]) / (end - first)[:, None])


def limit_cycle_n(windows: pd.DataFrame) -> float:
    """Amplitude of the limit cycle: nine tenths of the windows stay below it. It is not the largest, because at a stroke's turn
    or a new pass the force rightly changes fast. 0 without windows."""
    ordered = np.sort(windows["fast_rms_n"].to_numpy())
    return float(ordered[int(0.9 * (len(ordered) - 1))]) if len(ordered) else 0.0


def onset_of_chatter_mm(windows: pd.DataFrame) -> float | None:
    """Depth at which chatter begins: of the first of two consecutive windows that both chatter. None: nowhere."""
    chatters = (windows["fast_rms_n"] >= CHATTER_N).to_numpy()
    both = np.flatnonzero(chatters[:-1] & chatters[1:])
    return float(windows["depth_mm"].iloc[both[0]]) if len(both) else None
