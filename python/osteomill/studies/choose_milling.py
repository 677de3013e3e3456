"""The cheapest voxel size, milling rate, force model and coupling with which a case's force is true enough.

Force: each burr of the case is run through the five motions of studied_motions.py, by the law that the case gives it. The error
is that of the mean force against the analytical reference, the peak error the largest ripple of means over 10 ms; the burr that
fares worst counts. Coupling: the case's own simulated hand, light and firm, mills for some seconds of session time. Its mean
force, and its largest mean over 10 ms, may differ from those of the same hand with the default coupling, model and rate by no
more than the allowed errors, and the safety monitor must not switch the force off.

The cost is a share of a core: a milling step of the case's largest burr as often as the rate says, and a thousand haptic
ticks. A coupling that solves with the bone needs its map at each step, which is part of the cost.

All pairs of a way to mill and a coupling are tried, from the cheapest on, and the first that holds is chosen. An error is
computed on the first request, and once.
"""

import dataclasses
import functools
import itertools
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from osteomill import Burr, Case, Session, _studies
from osteomill.studies.stability_points import METHODS
from osteomill.studies.studied_motions import LATTICE_SHIFTS, StudiedMotion, error_and_ripple, motions_of, run_motion

TICKS_HZ = 1000.0
DEFAULT_COUPLING, DEFAULT_MODEL, DEFAULT_RATE_HZ = "implicit", "milling", 1000.0
SOLVED_WITH_BONE = ("implicit", "virtual-coupling")
# Force models by haptic_server's --force-model; without edges the burr has the coefficients of chips alone.
MODELS: dict[str, dict[str, Any]] = {
    "milling": {},
    "milling-partial": {"coverage": "linear"},
    "published": {},
    "milling-bins": {"summation": "bins"},
}
VOXELS_MM = (0.3, 0.27, 0.2, 0.16, 0.1, 0.08, 0.05)
RATES_HZ = (50.0, 100.0, 250.0, 500.0, 1000.0)
QUICK_VOXELS_MM, QUICK_RATES_HZ, QUICK_COUPLINGS = (0.3, 0.2, 0.1), (100.0, 1000.0), ("hold", "interpolate", "implicit")


@dataclasses.dataclass(frozen=True)
class Way:
    """A way to mill and to pass the force on."""

    voxel_mm: float
    milling_rate_hz: float
    force_model: str
    coupling: str

    def differs_in(self, other: "Way") -> list[str]:
        return [field.name for field in dataclasses.fields(self) if getattr(self, field.name) != getattr(other, field.name)]


@dataclasses.dataclass(frozen=True)
class Errors:
    """In percent; infinite if the safety monitor switched the force off."""

    error_percent: float
    peak_percent: float

    def is_within(self, wanted: "Errors") -> bool:
        return self.error_percent <= wanted.error_percent and self.peak_percent <= wanted.peak_percent

    def worse(self, other: "Errors") -> "Errors":
        return Errors(max(self.error_percent, other.error_percent), max(self.peak_percent, other.peak_percent))


def ways(quick: bool) -> list[Way]:
    """All that are tried."""
    couplings = QUICK_COUPLINGS if quick else METHODS
    models = tuple(MODELS)[:2] if quick else tuple(MODELS)
    return [Way(*chosen) for chosen in itertools.product(QUICK_VOXELS_MM if quick else VOXELS_MM,
                                                         QUICK_RATES_HZ if quick else RATES_HZ, models, couplings)]


class Measured:
    """Costs and errors of the ways of milling a case, each measured on its first request."""

    def __init__(self, case: Case, quick: bool) -> None:
        self.case = case
        self.quick = quick
        by_size = {(burr.diameter_mm, burr.rpm): burr for burr in sorted(case.burrs, key=lambda burr: burr.diameter_mm)}
        self.burrs = [burr for burr in by_size.values() if _studies.is_ball(burr)] or [case.burrs[case.start_burr]]
        if quick:  # the smallest errs most, the largest costs most
            self.burrs = [self.burrs[0], self.burrs[-1]] if len(self.burrs) > 1 else self.burrs
        self._motions: dict[int, list[StudiedMotion]] = {}
        self.force_errors = functools.cache(self._force_errors)
        self.coupling_errors = functools.cache(self._coupling_errors)
        self.step_us = functools.cache(self._step_us)
        self.tick_us = functools.cache(self._tick_us)
        self._run = functools.cache(self._mean_and_peak_n)

    def core_percent(self, way: Way) -> float:
        """Cost in percent of one core."""
        step_us = self.step_us(way.voxel_mm, way.milling_rate_hz, way.force_model, way.coupling in SOLVED_WITH_BONE)
        return 1e-4 * (way.milling_rate_hz * step_us + TICKS_HZ * self.tick_us(way.coupling))

    def errors(self, way: Way, wanted: Errors | None = None) -> Errors:
        """Errors of the force, and, if these are within the wanted ones, of the coupling as well."""
        force = self.force_errors(way.voxel_mm, way.milling_rate_hz, way.force_model)
        if wanted is not None and not force.is_within(wanted):
            return force
        return force.worse(self.coupling_errors(way.milling_rate_hz, way.force_model, way.coupling))

    def _force_errors(self, voxel_mm: float, rate_hz: float, model: str) -> Errors:
        worst = Errors(0.0, 0.0)
        for number, burr in enumerate(self.burrs):
            error, ripple = error_and_ripple(self._motions_of(number), _milling(model), voxel_mm=voxel_mm, milling_rate_hz=rate_hz,
                                             shifts=LATTICE_SHIFTS[:1] if self.quick else LATTICE_SHIFTS,
                                             run_with=_felt_by(model, burr))
            worst = worst.worse(Errors(100.0 * error, 100.0 * ripple))
        return worst

    def _motions_of(self, number: int) -> list[StudiedMotion]:
        if number not in self._motions:
            self._motions[number] = motions_of(self.burrs[number], 0.9 if self.quick else 2.4)
        return self._motions[number]

    def _step_us(self, voxel_mm: float, rate_hz: float, model: str, with_map: bool) -> float:
        motion = self._motions_of(len(self.burrs) - 1)[0]
        milling = [_milling(model)] + ([_studies.Milling(), _studies.Milling(map=True)] if with_map else [])
        runs = run_motion(motion, milling, voxel_mm=voxel_mm, milling_rate_hz=rate_hz,
                          lattice_shift_mm=np.multiply(LATTICE_SHIFTS[0], voxel_mm), most_steps=20 if self.quick else 60)
        steps_us = [float(np.median(run.step_us)) for run in runs]
        return steps_us[0] + (max(0.0, steps_us[2] - steps_us[1]) if with_map else 0.0)

    def _tick_us(self, coupling: str) -> float:
        return float(np.median(_studies.coupling_tick_us(coupling, 200 if self.quick else 600)))

    def _coupling_errors(self, rate_hz: float, model: str, coupling: str) -> Errors:
        worst = Errors(0.0, 0.0)
        for hand in ("firm",) if self.quick else ("light", "firm"):
            mean_n, peak_n = self._run(hand, rate_hz, model, coupling)
            true_mean_n, true_peak_n = self._run(hand, DEFAULT_RATE_HZ, DEFAULT_MODEL, DEFAULT_COUPLING)
            if not true_peak_n > 0.0:
                continue  # the hand touches nothing
            error = float(np.linalg.norm(mean_n - true_mean_n)) / max(float(np.linalg.norm(true_mean_n)), 1e-9)
            worst = worst.worse(Errors(100.0 * error, 100.0 * abs(peak_n - true_peak_n) / true_peak_n))
        return worst

    def _mean_and_peak_n(self, hand: str, rate_hz: float, model: str, coupling: str) -> tuple[Any, float]:
        """Mean and peak of the force on the hand; the peak is infinite if the monitor switched the force off."""
        names: dict[str, Any] = {"hand": hand, "coupling": coupling, "force_model": model}
        with Session(self.case, milling_rate_hz=rate_hz, **names) as session:
            ran = session.run(3000 if self.quick else 8000)
        force_n = np.asarray(ran["force_n"])
        windows = force_n[: len(force_n) // 10 * 10].reshape(-1, 10, 3).mean(axis=1)
        peak_n = float(np.linalg.norm(windows, axis=1).max()) if len(windows) else 0.0
        has_let_go = bool(np.any(ran["fault"]))
        return force_n.mean(axis=0), np.inf if has_let_go else peak_n


def _milling(model: str) -> _studies.Milling:
    return _studies.Milling(**MODELS[model])


def _felt_by(model: str, burr: Burr) -> Burr | None:
    """The burr for which a model computes the force, if it is not the burr's own."""
    return _studies.chips_alone(burr) if model == "published" else None


@dataclasses.dataclass(frozen=True)
class Choice:
    way: Way
    core_percent: float
    errors: Errors
    is_held: bool  # no way is true enough: it is the truest of those tried
    tried: int     # ways, of which this is the dearest
    lost: dict[str, tuple[Way, Errors]]  # by setting: the dearest of those cheaper in it alone, and its errors


def cheapest(candidates: Iterable[Way], cost: Callable[[Way], float], errors: Callable[[Way], Errors], wanted: Errors) -> Choice:
    """The first in the order of cost whose errors are within the wanted ones."""
    by_cost = sorted(candidates, key=lambda way: (cost(way), dataclasses.astuple(way)))
    found: dict[Way, Errors] = {}
    chosen = None
    for way in by_cost:
        found[way] = errors(way)
        if found[way].is_within(wanted):
            chosen = way
            break
    is_held = chosen is not None
    if chosen is None:
        chosen = min(by_cost, key=lambda way: max(found[way].error_percent / wanted.error_percent,
                                                  found[way].peak_percent / wanted.peak_percent))
    lost = {}
    for setting in (field.name for field in dataclasses.fields(Way)):
        cheaper = [way for way in by_cost if chosen.differs_in(way) == [setting] and cost(way) < cost(chosen)]
        if cheaper:
            lost[setting] = (cheaper[-1], found[cheaper[-1]])
    return Choice(chosen, cost(chosen), found[chosen], is_held, len(found), lost)


def choose(case: Case, wanted: Errors, quick: bool, candidates: Sequence[Way] | None = None) -> Choice:
    measured = Measured(case, quick)
    return cheapest(candidates or ways(quick), measured.core_percent, lambda way: measured.errors(way, wanted), wanted)
