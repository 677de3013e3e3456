"""Readings of sensors during a motion: the force within the tooth period at 10 kHz, and a force sensor's reading of it.

The sensor is a model, stated here and in the file: a Butterworth low pass of second order, then white noise on each axis, of a root
mean square that is drawn once a motion between 42 and 48 mN (as published for such sensors), then steps of 1 mN.
"""

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from osteomill import Burr, _studies

Array = NDArray[np.float64]

RATE_HZ = 10_000
PER_STEP = RATE_HZ // 1000
NOISE_N = (0.042, 0.048)


@dataclasses.dataclass(frozen=True)
class ForceSensor:
    """Noise in N, root mean square of an axis; 0 for none of it, and for a step, of none."""

    noise_n: float = 0.045
    step_n: float = 0.001
    low_pass_hz: float = 2000.0

    @staticmethod
    def drawn(rng: np.random.Generator) -> "ForceSensor":
        return ForceSensor(noise_n=float(rng.uniform(*NOISE_N)))

    def low_passed(self, force_n: Array) -> Array:
        from scipy import signal

        return np.asarray(signal.sosfilt(signal.butter(2, self.low_pass_hz, fs=RATE_HZ, output="sos"), force_n, axis=0))

    def read(self, force_n: Array, rng: np.random.Generator) -> Array:
        """(n, 3) at RATE_HZ."""
        read_n = self.low_passed(force_n) + self.noise_n * rng.standard_normal(force_n.shape)
        return np.asarray(self.step_n * np.round(read_n / self.step_n) if self.step_n > 0.0 else read_n, dtype=np.float64)


def force_within_tooth_n(milled: Mapping[str, Any], burr: Burr, phase_rad: float = 0.0) -> Array:
    """Force of the bone on the burr at RATE_HZ, (n, 3): equation (1) of docs/milling-model.md by its harmonics (studies/states/milled_path.h).
    `phase_rad`: where the first edge stands at time 0. Mean and harmonics are linear between milliseconds."""
    mean_n = finer(milled["force_n"])
    angle_rad = phase_rad + _studies.turns(burr) * 2.0 * np.pi * burr.rpm / 60.0 * (1 + np.arange(len(mean_n))) / RATE_HZ
    force_n = mean_n
    for harmonic in range(milled["harmonic_n"].shape[1]):
        wave = np.exp(1j * (harmonic + 1) * burr.edges * angle_rad)
        if (harmonic + 1) * burr.edges * burr.rpm / 60.0 < 0.5 * RATE_HZ:  # above nothing is told apart from what is below
            force_n = force_n + 2.0 * np.real(finer(milled["harmonic_n"][:, harmonic]) * wave[:, None])
    return force_n


def finer(steps: NDArray[Any]) -> NDArray[Any]:
    """A row each millisecond's end, as rows at RATE_HZ, linear between; the first is held before it."""
    before = np.concatenate([steps[:1], steps[:-1]])[:, None]
    share = ((1 + np.arange(PER_STEP)) / PER_STEP).reshape((1, PER_STEP) + (1,) * (steps.ndim - 1))
    return np.asarray((before + share * (steps[:, None] - before)).reshape((-1, *steps.shape[1:])))


def held(steps: NDArray[Any]) -> NDArray[Any]:
    """A row a millisecond, as rows at RATE_HZ that are the same for as long."""
    return np.repeat(steps, PER_STEP, axis=0)


def thinned(rows: NDArray[Any], every: int) -> NDArray[Any]:
    """One row in `every`, of a signal: what the lower rate cannot tell apart is filtered out."""
    from scipy import signal

    return np.asarray(signal.resample_poly(rows, 1, every, axis=0)) if every > 1 else rows
