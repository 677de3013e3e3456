"""Runs as a dynamometer would give them, of coefficients that are known."""

import dataclasses

import numpy as np
import pandas as pd

from osteomill.studies.calibration.forces import forces_of
from osteomill.studies.calibration.runs import FORCES, SPREADS

KNOWN = np.array([230.0, 40.0, 20.0, 0.5, 0.8, 0.1])


def settings_of(**varied):
    """A table of settings; those not given are a usual run's."""
    count = max(len(values) for values in varied.values())
    usual = {"diameter_mm": 4.0, "edges": 8, "turns": "clockwise", "rpm": 20_000.0, "feed_mm_per_s": 6.0, "depth_mm": 0.5,
             "tilt_deg": 0.0, "tilt_direction_deg": 0.0}
    return pd.DataFrame({name: varied.get(name, [value] * count) for name, value in usual.items()})


def twelve_settings():
    """Two feeds of a revolution, three spindles, two depths."""
    grid = [(feed, depth, tilt, toward) for feed in (1.0, 10.0) for depth in (0.5, 1.2)
            for tilt, toward in ((0.0, 0.0), (35.0, 90.0), (35.0, 200.0))]
    feeds, depths, tilts, directions = zip(*grid)
    return settings_of(feed_mm_per_s=feeds, depth_mm=depths, tilt_deg=tilts, tilt_direction_deg=directions)


def runs_of(settings, spread_n=0.05):
    """A table of runs, made in its order, whose forces are still to be measured."""
    names = [str(number) for number in range(1, len(settings) + 1)]
    return settings.assign(run=names, material="bone", time=np.linspace(0.0, 1.0, len(names)),
                           **{name: 0.0 for name in FORCES}, **{name: spread_n for name in SPREADS})


def exact_forces(settings, spread_n=0.05, drift="none"):
    """The law's force for each setting, without noise and drift."""
    forces = forces_of(runs_of(settings, spread_n), drift)
    return dataclasses.replace(forces, force_n=forces.regressors[:, : len(KNOWN)] @ KNOWN)


def measured(forces, random, noise=1.0):
    """The same with normal noise of so many spreads."""
    return dataclasses.replace(forces, force_n=forces.force_n + noise * forces.spread_n * random.normal(size=len(forces.force_n)))
