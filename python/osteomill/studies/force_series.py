"""A run of a milling model, step by step, and the few numbers that describe its quality."""

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class ForceSeries:
    """One entry a step."""

    step_s: float
    force_n: Array  # (n, 3)
    removed_mm3: Array
    step_us: Array  # time that the step took

    def mean_force_n(self) -> Array:
        return np.asarray(self.force_n.mean(axis=0))

    def removal_mm3_per_s(self) -> float:
        return float(self.removed_mm3.sum() / (self.step_s * len(self.removed_mm3)))

    def deviations(self, window_s: float = 0.01) -> Array:
        """|F - mean| over |mean|, F being the mean force of each whole `window_s` (of each step if a step is
        longer): the ripple for a hand that follows no faster than that. None for a mean of zero."""
        mean = self.mean_force_n()
        if not mean.any():
            return np.zeros(0)
        window = max(1, math.floor(window_s / self.step_s + 0.5))
        whole = len(self.force_n) // window
        means = self.force_n[: whole * window].reshape(whole, window, 3).mean(axis=1)
        return np.asarray(np.linalg.norm(means - mean, axis=1) / np.linalg.norm(mean))

    def ripple(self, window_s: float = 0.01) -> float:
        """Root mean square of the deviations; 0 for none."""
        shares = self.deviations(window_s)
        return float(np.sqrt((shares**2).mean())) if len(shares) else 0.0

    def largest_step(self) -> float:
        """The largest |F| of a step over |mean|; 0 for a mean of zero."""
        mean_n = float(np.linalg.norm(self.mean_force_n()))
        return float(np.linalg.norm(self.force_n, axis=1).max()) / mean_n if mean_n > 0.0 else 0.0


def relative_error(value: Array | float, reference: Array | float) -> float:
    """|value - reference| / |reference|; infinite if only the reference is zero, 0 if both are."""
    difference = float(np.linalg.norm(np.subtract(value, reference)))
    norm = float(np.linalg.norm(reference))
    if norm > 0.0:
        return difference / norm
    return math.inf if difference > 0.0 else 0.0
