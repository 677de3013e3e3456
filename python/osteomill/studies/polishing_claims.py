"""The paper's claims about its experiment, and whether they hold in ours: one number decides each claim.

Forces rise with depth: rank correlation of the size of each component's slow part, in windows of 0.4 s, with depth; at
least 0.5, which twenty windows reach by chance once in eighty times. For a fresh slot the published equations themselves give the
greatest F_z at tan kappa_d = K_r / K_a, at 1.4 mm with a 5 mm burr, and a pull into the bone below 2.9 mm.

The components are not proportional to each other: 5 % of their power or more lies off any single line (two thirds is the
most that can).

Without sample-estimate-hold the contact is nearly unstable, with it stable: the limit cycle's rms reaches the bound of chatter,
or stays below it.

More edges, and a faster spindle, lower the force: by a twentieth at least.

They are tested on the records of the hand, and on the model alone on rails: the burr follows the intended path exactly, through a
block. Edges are resolved at 10 kHz and 2500 rpm, so slowly that even twelve edges take 2 ms to the next, in a slot 1 mm deep.
"""

import math
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy import stats

from osteomill import Burr, _studies
from osteomill.studies.force_series import ForceSeries

RISING_BAR, RISING_WINDOW_S = 0.5, 0.4
OFF_LINE_BAR = 0.05
LOWERED_BAR = 0.95
SPINDLE_RPM, SLOW_RPM, RESOLVED_RPM = 80_000.0, 10_000.0, 2_500.0
STROKE_MM, SINGLE_STROKE_MM = 8.0, 40.0
FEED_MM_PER_S = 6.0
VOXEL_MM = 0.1
EDGES = (1, 12)
REVOLUTIONS = 10  # that are measured, after as many

Array = NDArray[np.float64]


def cases(edge_forces: bool) -> list[dict[str, Any]]:
    """Beside the figures' own runs: the model on rails, and by number of edges."""
    rails = [{"part": "rails", "rpm": rpm, "stroke_mm": stroke_mm} for rpm, stroke_mm in
             ((SPINDLE_RPM, STROKE_MM), (SPINDLE_RPM, SINGLE_STROKE_MM), (SLOW_RPM, STROKE_MM))]
    return [case | {"edge_forces": edge_forces} for case in [*rails, *({"part": "edges", "edges": edges} for edges in EDGES)]]


def measure_on_rails(slide: _studies.PolishingSlide, rpm: float, edges_n_per_mm: Any) -> dict[str, Any]:
    """A record as of a hand that is exactly where it means to be, steps of a millisecond."""
    surface_z_mm = float(slide.start_mm[2])
    way = np.array([slide.meant_mm(tick * 0.001) for tick in range(int(slide.meant_s * 1000.0))])
    way[:, 2] -= surface_z_mm
    depths_mm = slide.burr_radius_mm - way[:, 2]
    first = max(0, int(np.argmax(depths_mm > 0.0)) - 1)
    way, depths_mm = way[first:], depths_mm[first:]
    burr = Burr(diameter_mm=2.0 * slide.burr_radius_mm, rpm=rpm, edge_coefficients_n_per_mm=edges_n_per_mm)
    margin_mm = slide.burr_radius_mm + 5.0 * VOXEL_MM
    block = _studies.Block(way.min(axis=0) - margin_mm, way.max(axis=0) + margin_mm, VOXEL_MM)
    [run] = _studies.run_path([_studies.Milling()], block, burr, (0.0, 0.0, 1.0), 0.001, way)
    series = ForceSeries(*run)
    begun = int(np.argmax(series.removed_mm3 > 0.0))
    force_n = series.force_n[begun:]
    return {"t_s": np.arange(len(force_n)) * 0.001, "depth_mm": depths_mm[1:][begun:], "force_n": force_n}


def measure_edges(edges: int, edges_n_per_mm: Any) -> dict[str, Any]:
    """Forces of a steady slot, instant by instant: the mean force, that of one tooth, the peak within the tooth period."""
    rate_hz, radius_mm, depth_mm = 10_000.0, 2.5, 1.0
    steps = round(rate_hz * 60.0 / RESOLVED_RPM)  # of a revolution
    burr = Burr(diameter_mm=2.0 * radius_mm, rpm=RESOLVED_RPM, edges=edges, edge_coefficients_n_per_mm=edges_n_per_mm)
    way = np.zeros((2 * REVOLUTIONS * steps + 1, 3))
    way[:, 0] = np.arange(len(way)) * FEED_MM_PER_S / rate_hz
    way[:, 2] = radius_mm - depth_mm
    margin_mm = radius_mm + 5.0 * VOXEL_MM
    block = _studies.Block(way.min(axis=0) - margin_mm, way.max(axis=0) + margin_mm, VOXEL_MM)
    [run] = _studies.run_path([_studies.Milling(summation="instants")], block, burr, (0.0, 0.0, 1.0), 1.0 / rate_hz, way)
    measured = ForceSeries(*run).force_n[-REVOLUTIONS * steps :]
    mean_n = float(np.linalg.norm(measured.mean(axis=0)))
    lengths_n = np.linalg.norm(measured, axis=1)
    return {"mean_n": mean_n, "one_tooth_n": mean_n / edges, "peak_n": float(np.percentile(lengths_n, 99))}


def edge_table_of(found: list[dict[str, Any]]) -> pd.DataFrame:
    return pd.DataFrame([{"edges": edges} | one for edges, one in zip(EDGES, found)])


def claims_of(records: dict[str, dict[str, Any]], limit_cycles_n: dict[str, float], edges: pd.DataFrame, chatter_n: float) -> pd.DataFrame:
    """`records`: of hands and of rails, by where; `limit_cycles_n`: of each of the figures' runs, by model and coupling."""
    asked = {where: record for where, record in records.items() if "rpm over" not in where}
    rows = [row for where, record in asked.items() for row in _rising(where, record)]
    rows += [_claim("components are not proportional to each other", where, "share of their power off one line",
                    share_off_line(forces_of(record)), "at least", OFF_LINE_BAR) for where, record in asked.items()]
    for where, limit_cycle_n in limit_cycles_n.items():
        coupling = where.rpartition(", ")[2]
        claim, must_be = (("without sample-estimate-hold it is nearly unstable", "at least") if coupling in ("interpolate", "hold")
                          else ("implicit is steady (not in the paper)", "at most") if coupling == "implicit"
                          else ("with sample-estimate-hold it is steady", "at most"))
        rows.append(_claim(claim, where, "limit cycle, N rms", limit_cycle_n, must_be, chatter_n))
    few, many = edges.iloc[0], edges.iloc[-1]
    for claim, number, measure in (("more edges lower the mean force, equation (2)", "mean_n", "mean |F|, ratio"),
                                   ("more edges lower the force of one tooth", "one_tooth_n", "mean |F| of a tooth, ratio"),
                                   ("more edges lower the peak in the tooth period, equation (1)", "peak_n", "99th percentile of |F(t)|, ratio")):
        rows.append(_claim(claim, f"on rails, 10 kHz, {many['edges']:g} edges over {few['edges']:g}", measure, many[number] / few[number],
                           "at most", LOWERED_BAR))
    fast, slow = (mean_length_n(forces_of(records[where])) for where in ("milling, on rails", f"rpm over: {SLOW_RPM:g}"))
    rows.append(_claim("a faster spindle lowers the force", f"milling, on rails, {SPINDLE_RPM:.0f} rpm over {SLOW_RPM:.0f}",
                       "mean |F|, ratio", fast / slow, "at most", LOWERED_BAR))
    return pd.DataFrame(rows)


def _claim(claim: str, where: str, measure: str, measured: float, must_be: str, bar: float) -> dict[str, Any]:
    holds = measured >= bar if must_be == "at least" else measured <= bar
    return {"claim": claim, "where": where, "measure": measure, "measured": measured, "must_be": must_be, "bar": bar, "holds": holds}


def _rising(where: str, record: dict[str, Any]) -> list[dict[str, Any]]:
    depths_mm, slow_n = slow_windows_of(np.array(record["t_s"]), np.array(record["depth_mm"]), forces_of(record))
    rows = []
    for axis, name in enumerate(("F_x", "F_y", "F_z")):
        largest_mm = float(depths_mm[int(np.argmax(slow_n[:, axis]))]) if len(depths_mm) else 0.0
        rows.append(_claim(f"{name} rises with depth", where, f"rank correlation with depth; largest at {largest_mm:.1f} mm",
                           rank_correlation(depths_mm, slow_n[:, axis]), "at least", RISING_BAR))
    return rows


def slow_windows_of(t_s: Array, depths_mm: Array, force_n: Array) -> tuple[Array, Array]:
    """Mean depth of each whole window, and the rms of each component's slow part."""
    from osteomill.studies.polishing import SLOW_PART_S, moving_mean, samples_in

    length = samples_in(t_s, RISING_WINDOW_S)
    count = len(t_s) // length
    slow = moving_mean(force_n, samples_in(t_s, SLOW_PART_S))[: count * length].reshape(count, length, 3)
    return (np.asarray(depths_mm[: count * length].reshape(count, length).mean(axis=1)),
            np.asarray(np.sqrt((slow**2).mean(axis=1))))


def forces_of(record: dict[str, Any]) -> Array:
    return np.asarray(record["force_n"], dtype=np.float64).reshape(-1, 3)


def mean_length_n(force_n: Array) -> float:
    return float(np.linalg.norm(force_n, axis=1).mean()) if len(force_n) else math.nan


def rank_correlation(x: Array, y: Array) -> float:
    """Spearman's; 0 if one of them does not change."""
    if len(x) < 2 or np.ptp(x) == 0.0 or np.ptp(y) == 0.0:
        return 0.0
    return float(stats.spearmanr(x, y)[0])


def share_off_line(force_n: Array) -> float:
    """Share of the power of the three components, each scaled to equal strength, that lies off the line that holds most of it."""
    power = force_n.T @ force_n
    strength = np.sqrt(np.diag(power))
    scale = np.outer(strength, strength)
    power = np.divide(power, scale, out=np.zeros_like(power), where=scale > 0.0)
    whole = float(np.trace(power))
    return max(0.0, 1.0 - float(np.linalg.eigvalsh(power)[-1]) / whole) if whole > 0.0 else 0.0
