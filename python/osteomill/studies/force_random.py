"""Steady motions drawn at random, and the accuracy of the voxel model over them: the check of the documents' promise, on
motions to which nothing was tuned.

A motion is of a burr of 1 to 5 mm, 4 to 12 edges, either sense of rotation, 5 000 to 80 000 rpm, its spindle leaning
by up to 70 degrees, at 0.2 to 60 mm/s, one voxel to the equator deep, over a surface that lies anyhow. One in three
dives; a third of the others follow a groove that the same burr cut before.
"""

import functools
from typing import Any

import numpy as np
import pandas as pd

from osteomill import _studies
from osteomill.studies.force_series import ForceSeries, relative_error

Drawn = dict[str, Any]  # arguments of random_motions
# Places of the bone's surface in the lattice beside its own.
OFFSETS_VOXELS = (-0.25, -0.125, 0.125, 0.25)


def cases_of(drawn: Drawn, offsets_voxels: tuple[float, ...] = ()) -> list[dict[str, Any]]:
    """Each motion, also with the bone's surface, and the burr with it, off its place in the lattice."""
    return [{"part": "random", "index": index, "drawn": drawn, "offsets_voxels": offsets_voxels} for index in range(drawn["count"])]


@functools.lru_cache(maxsize=1)
def _motions(drawn: tuple[tuple[str, Any], ...]) -> list[_studies.RandomMotion]:
    return _studies.random_motions(**dict(drawn))


def motion_of(case: dict[str, Any]) -> _studies.RandomMotion:
    motions = _motions(tuple(sorted(case["drawn"].items())))
    return motions[int(case["index"])]


def measure(case: dict[str, Any]) -> dict[str, Any]:
    drawn = motion_of(case)
    series = ForceSeries(*drawn.run(_studies.Milling()))
    force_n, reference_n = series.mean_force_n(), drawn.reference()
    moved_n = [ForceSeries(*drawn.run(_studies.Milling(), surface_voxels=by)).mean_force_n() for by in case["offsets_voxels"]]
    parts_n = drawn.reference_parts() if moved_n else 0.0
    return {"reference_n": reference_n, "force_n": force_n, "error": relative_error(force_n, reference_n),
            "ripple": series.ripple(), "deviations": series.deviations(), "largest_step": series.largest_step(),
            "changes": [relative_error(moved, force_n) for moved in moved_n],
            "changes_of_parts": [float(np.linalg.norm(moved - force_n)) / parts_n for moved in moved_n],
            "step_us": float(np.percentile(series.step_us, 50))}


def table_of(cases: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    """A line a motion."""
    rows = []
    for case, found in zip(cases, outcomes):
        drawn = motion_of(case)
        motion, burr = drawn.motion, drawn.motion.burr
        rows.append({
            "name": motion.name, "diameter_mm": burr.diameter_mm, "depth_mm": motion.depth_mm,
            "spindle_tilt_deg": drawn.tilt_deg, "spindle_azimuth_deg": drawn.azimuth_deg, "dives": drawn.dives,
            "feed_mm_per_s": motion.feed_mm_per_s, "rpm": burr.rpm, "edges": burr.edges, "clockwise": motion.clockwise,
            "groove_mm_higher": motion.groove_mm_higher, "milling_rate_hz": drawn.milling_rate_hz, "voxel_mm": drawn.voxel_mm,
            **{f"reference_{axis}_n": value for axis, value in zip("xyz", found["reference_n"])},
            **{f"force_{axis}_n": value for axis, value in zip("xyz", found["force_n"])},
            "error_percent": 100.0 * found["error"],
            **({"change_percent": 100.0 * max(found["changes"]), "change_of_parts_percent": 100.0 * max(found["changes_of_parts"])}
               if found["changes"] else {}),
            "ripple_percent": 100.0 * found["ripple"],
            "largest_step": found["largest_step"], "step_us": found["step_us"],
        })
    return pd.DataFrame(rows)


def summary_of(drawn: Drawn, table: pd.DataFrame, outcomes: list[dict[str, Any]]) -> dict[str, Any]:
    """Summary of all; values that a dive does not have are of motions along the surface alone."""
    along = table[~table["dives"]]
    windows = [100.0 * share for found, dives in zip(outcomes, table["dives"]) if not dives for share in found["deviations"]]
    brisk = along[along["feed_mm_per_s"] >= 5.0]
    fast = along[along["milling_rate_hz"] >= 1000.0]
    worst = table.sort_values("error_percent", ascending=False, kind="stable").head(10)
    return {
        "seed": drawn["seed"], "voxel_mm": drawn["voxel_mm"], "edge_forces": drawn["edge_forces"], "heads": drawn["heads"],
        "cases": len(table),
        "median_error_percent": percentile(table["error_percent"], 50),
        **{f"p{share}_error_percent": percentile(table["error_percent"], share) for share in (90, 95, 99)},
        "max_error_percent": percentile(table["error_percent"], 100),
        **(_changes(table, along) if "change_percent" in table else {}),
        "along_median_error_percent": percentile(along["error_percent"], 50),
        "along_p90_error_percent": percentile(along["error_percent"], 90),
        "ripple_p90_percent": percentile(along["ripple_percent"], 90),
        "ripple_p90_from_5_mm_per_s_percent": percentile(brisk["ripple_percent"], 90),
        "ripple_max_percent": percentile(along["ripple_percent"], 100),
        "window_p95_percent": percentile(windows, 95),
        "largest_step_p99": percentile(fast["largest_step"], 99),
        "largest_step_max": percentile(fast["largest_step"], 100),
        "step_us_p50": percentile(table["step_us"], 50),
        "worst": worst[["name", "error_percent", "ripple_percent"]].to_dict("records"),
    }


def _changes(table: pd.DataFrame, along: pd.DataFrame) -> dict[str, float]:
    return {
        **{f"p{share}_change_percent": percentile(table["change_percent"], share) for share in (50, 95, 99, 100)},
        "along_max_change_percent": percentile(along["change_percent"], 100),
        "p99_change_of_parts_percent": percentile(table["change_of_parts_percent"], 99),
        "max_change_of_parts_percent": percentile(table["change_of_parts_percent"], 100),
    }


def percentile(values: Any, share: float) -> float:
    """0 if there are no values."""
    return float(np.percentile(values, share)) if len(values) else 0.0


def words_of(summary: dict[str, Any]) -> str:
    moved = ("; with the surface a quarter of a voxel off in the lattice the mean changes by at most {p95_change_percent:.2f} % in 95 of "
             "100, {p99_change_percent:.2f} in 99, {p100_change_percent:.2f} at worst ({along_max_change_percent:.2f} along the surface); of the sum of "
             "its parts' magnitudes by {p99_change_of_parts_percent:.2f} % in 99 of 100, {max_change_of_parts_percent:.2f} at worst"
             if "p50_change_percent" in summary else "")
    return (
        "{cases} motions of seed {seed}: error median {median_error_percent:.2f} %, 90 % within {p90_error_percent:.2f}, "
        "95 % within {p95_error_percent:.2f}, 99 % within {p99_error_percent:.2f}, worst {max_error_percent:.2f} %; "
        "along the surface error median {along_median_error_percent:.2f} %, 90 % within {along_p90_error_percent:.2f}, "
        "ripple 90 % within {ripple_p90_percent:.2f} (from 5 mm/s on {ripple_p90_from_5_mm_per_s_percent:.2f}), worst "
        "{ripple_max_percent:.2f} %; means over 10 ms there 95 % within {window_p95_percent:.2f} %, largest step at 1 kHz "
        "{largest_step_max:.2f} times the mean (99 % under {largest_step_p99:.2f})" + moved).format(**summary)
