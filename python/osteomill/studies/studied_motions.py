"""Five motions that stand for many: polishing, tilted, plunging, a curved path, a block of two layers.

All are of an upright or leaning burr in flat bone {z <= 0}, 6 mm/s (the plunge 2) and, unless said, 10 000 rpm. They are given for
a burr of 5 mm; with another, depths, the layer and the bend of the path follow its size.
"""

import dataclasses
import functools
import math
from collections.abc import Callable, Sequence

import numpy as np

from osteomill import Burr, _studies
from osteomill.studies.force_series import Array, ForceSeries, relative_error

FEED_MM_PER_S = 6.0
PLUNGE_MM_PER_S = 2.0
FULL_SIZE_MM = 5.0
# Offsets of the lattice relative to the motion, as shares of a voxel: a mean over several is more telling than one. The bone's
# surface stays on faces of voxels.
LATTICE_SHIFTS = ((0.31, 0.17, 0.0), (0.77, 0.43, 0.0), (0.03, 0.91, 0.0))


@dataclasses.dataclass(frozen=True)
class StudiedMotion:
    name: str
    burr: Burr
    axis: tuple[float, float, float]
    position_mm: Callable[[float], Array]  # of the time in seconds
    duration_s: float
    layer: tuple[float, float] | None  # thickness in mm and relative stiffness
    reference_n: Array  # mean over the motion, by the analytical reference


def studied_motions(
    travel_mm: float = 2.4,
    diameter_mm: float = FULL_SIZE_MM,
    edge_coefficients_n_per_mm: Sequence[float] = (0.0, 0.0, 0.0),
    rpm: float = 10_000.0,
) -> list[StudiedMotion]:
    return _motions(travel_mm, diameter_mm, tuple(edge_coefficients_n_per_mm), rpm)


@functools.cache
def _motions(travel_mm: float, diameter_mm: float, edges: tuple[float, ...], rpm: float) -> list[StudiedMotion]:
    return motions_of(Burr(diameter_mm=diameter_mm, rpm=rpm, clockwise=False, edge_coefficients_n_per_mm=edges), travel_mm)


def motions_of(burr: Burr, travel_mm: float) -> list[StudiedMotion]:
    """The motions with this burr, as a ball."""
    size = burr.diameter_mm / FULL_SIZE_MM
    duration_s = travel_mm / FEED_MM_PER_S
    bend_mm = 3.0 * size

    def along(depth_mm: float) -> Callable[[float], Array]:
        return lambda t: np.array([FEED_MM_PER_S * t, 0.0, size * (2.5 - depth_mm)])

    def plunge(t: float) -> Array:
        return np.array([0.0, 0.0, -PLUNGE_MM_PER_S * t])

    def bend(t: float) -> Array:
        angle = FEED_MM_PER_S / bend_mm * t
        return np.array([bend_mm * math.sin(angle), bend_mm * (1.0 - math.cos(angle)), size * 1.5])

    upright, leaning = (0.0, 0.0, 1.0), (0.0, math.sqrt(0.5), math.sqrt(0.5))
    layer = (round(0.8 * size, 1), 0.4)  # whole voxels of the default, so that no layer ends within a voxel
    given = (
        ("polishing", upright, along(1.0), duration_s, None),
        ("tilted", leaning, along(1.5), duration_s, None),
        ("plunging", upright, plunge, 0.5 * travel_mm / PLUNGE_MM_PER_S, None),
        ("curved", upright, bend, duration_s, None),
        ("two layers", upright, along(1.5), duration_s, layer),
    )
    return [StudiedMotion(name, burr, axis, path, lasts_s, its_layer,
                          _mean_reference_n(burr, axis, path, lasts_s, its_layer, 8 if name == "curved" else 1))
            for name, axis, path, lasts_s, its_layer in given]


def _mean_reference_n(
    burr: Burr,
    axis: Sequence[float],
    path: Callable[[float], Array],
    duration_s: float,
    layer: tuple[float, float] | None,
    instants: int,
) -> Array:
    """Mean of the quasi-steady force over the motion, midpoint rule over time."""
    apart_s = 1e-4 * duration_s
    forces = []
    for t in (np.arange(instants) + 0.5) * duration_s / instants:
        velocity = np.asarray((path(t + apart_s) - path(t - apart_s)) / (2.0 * apart_s), dtype=np.float64)
        forces.append(_studies.reference_force(burr, path(t), axis, velocity, layer))
    return np.asarray(np.mean(forces, axis=0))


def run_motion(
    motion: StudiedMotion,
    models: Sequence[_studies.Milling],
    *,
    voxel_mm: float,
    milling_rate_hz: float,
    lattice_shift_mm: Sequence[float] | Array,
    run_in_s: float = 0.0,
    most_steps: int | None = None,
    run_with: Burr | None = None,
) -> list[ForceSeries]:
    """Series of each model, in turns step by step. `run_in_s`: the time that the burr moves before measurement, for a model that
    must forget its start in the bone; `most_steps`: of the measurement; `run_with`: the models' burr, if it is not the motion's
    own."""
    step_s = 1.0 / milling_rate_hz
    steps = max(1, round(motion.duration_s / step_s))
    if most_steps:
        steps = min(steps, most_steps)
    run_in = round(run_in_s / step_s)
    positions = np.array([motion.position_mm(i * step_s) for i in range(-run_in, steps + 1)]) + lattice_shift_mm
    margin = 0.5 * motion.burr.diameter_mm + 5.0 * voxel_mm
    block = _studies.Block(positions.min(axis=0) - margin, positions.max(axis=0) + margin, voxel_mm, motion.layer)
    runs = _studies.run_path(models, block, run_with or motion.burr, motion.axis, step_s, positions)
    return [ForceSeries(its_step_s, force_n[run_in:], removed_mm3[run_in:], step_us[run_in:])
            for its_step_s, force_n, removed_mm3, step_us in runs]


def error_and_ripple(
    motions: Sequence[StudiedMotion],
    model: _studies.Milling,
    *,
    voxel_mm: float,
    milling_rate_hz: float = 100.0,
    shifts: Sequence[Sequence[float]] = LATTICE_SHIFTS,
    run_in_s: float = 0.0,
    run_with: Burr | None = None,
) -> tuple[float, float]:
    """Error of the mean force, mean over motions and lattice offsets; and the largest ripple."""
    errors, ripples = [], []
    for motion in motions:
        for shift in shifts:
            (series,) = run_motion(motion, [model], voxel_mm=voxel_mm, milling_rate_hz=milling_rate_hz,
                                   lattice_shift_mm=np.multiply(shift, voxel_mm), run_in_s=run_in_s, run_with=run_with)
            errors.append(relative_error(series.mean_force_n(), motion.reference_n))
            if motion.name != "curved":  # its path turns the force; that is no ripple
                ripples.append(series.ripple())
    return float(np.mean(errors)), max(ripples)
