"""The mean forces of runs, linear in the unknowns: the six coefficients of the mechanistic milling law, and a drift
of the dynamometer.

Each piece ds of an edge takes chip forces, K_t K_r K_a times the chip's cross-section, and edge forces,
K_te K_re K_ae times ds (Lee and Altintas 1996). The column of a coefficient is the force if it is 1 and the others
are 0: along the feed, across it (to the left), and up, of the bone on the burr.
"""

import dataclasses
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from osteomill._studies import mean_slot_force_n

Array = npt.NDArray[np.float64]

COEFFICIENTS = {"K_t": "N/mm^2", "K_r": "N/mm^2", "K_a": "N/mm^2", "K_te": "N/mm", "K_re": "N/mm", "K_ae": "N/mm"}
AXES = ("feed", "across", "up")
FORCES_OF_A_RUN = len(AXES)


SLOPES = [f"drift_{axis}" for axis in AXES]  # N, from the first run that was made to the last
ZEROS = [f"zero_{axis}" for axis in AXES]  # N, at the first
#: Unknowns that each way of drifting adds.
DRIFTS: dict[str, list[str]] = {"none": [], "slope": SLOPES, "line": SLOPES + ZEROS}


@dataclasses.dataclass(frozen=True)
class Forces:
    """Three rows a run: feed, across, up. A column for each unknown."""

    runs: list[str]
    unknowns: list[str]
    regressors: Array
    force_n: Array
    spread_n: Array

    def design(self) -> Array:
        """The design in spreads."""
        return self.regressors / self.spread_n[:, None]

    def of_run(self, run: int) -> "Forces":
        return self._part(np.arange(len(self.runs)) == run)

    def without(self, run: int) -> "Forces":
        return self._part(np.arange(len(self.runs)) != run)

    def _part(self, taken: npt.NDArray[np.bool_]) -> "Forces":
        rows = np.repeat(taken, FORCES_OF_A_RUN)
        names = [name for name, is_taken in zip(self.runs, taken) if is_taken]
        return Forces(names, self.unknowns, self.regressors[rows], self.force_n[rows], self.spread_n[rows])


def forces_of(runs: pd.DataFrame, drift: str = "none") -> Forces:
    """Forces of a table from read_runs. A drift adds to each axis a constant zero, and a slope times the run's
    `time`."""
    of_each_axis = np.eye(FORCES_OF_A_RUN)
    law = np.vstack([regressors_of(run) for run in runs.itertuples()])
    slopes = np.kron(runs[["time"]].to_numpy(float), of_each_axis)
    zeros = np.kron(np.ones((len(runs), 1)), of_each_axis)
    unknowns = list(COEFFICIENTS) + list(DRIFTS[drift])
    return Forces(
        runs=runs.run.tolist(),
        unknowns=unknowns,
        regressors=np.hstack([law, slopes, zeros])[:, : len(unknowns)],
        force_n=runs[[f"force_{axis}_n" for axis in AXES]].to_numpy(float).ravel(),
        spread_n=runs[[f"spread_{axis}_n" for axis in AXES]].to_numpy(float).ravel(),
    )


def regressors_of(run: Any, finer: int = 1) -> Array:
    """(3, 6), for a run's setting, a row of a table; within 0.3 % of a far finer quadrature."""
    tilt, toward = np.radians((run.tilt_deg, run.tilt_direction_deg))
    higher = getattr(run, "previous_groove_mm_higher", np.nan)
    columns = [
        mean_slot_force_n(
            diameter_mm=run.diameter_mm,
            edges=int(run.edges),
            turns=run.turns,
            rpm=run.rpm,
            feed_mm_per_s=run.feed_mm_per_s,
            depth_mm=run.depth_mm,
            axis=(np.sin(tilt) * np.cos(toward), np.sin(tilt) * np.sin(toward), np.cos(tilt)),
            previous_groove_mm_higher=None if np.isnan(higher) else higher,
            cutting_n_per_mm2=one[:3],
            edge_n_per_mm=one[3:],
            finer=finer,
        )
        for one in np.eye(len(COEFFICIENTS))
    ]
    return np.column_stack(columns)


def feed_per_tooth_mm(runs: Any) -> Any:
    """Feed of a tooth in a run, or in each run of a table."""
    return runs.feed_mm_per_s / (runs.rpm / 60.0) / runs.edges
