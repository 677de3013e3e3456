"""The most informative runs for the six coefficients: a D-optimal design (largest determinant of the information matrix, smallest
volume of the coefficients' joint confidence region), found by exchange (Fedorov 1972 in the form of Cook and Nachtsheim 1980)
over a lattice of settings that the lab can give.

The mean force is linear in the coefficients, so the design does not depend on their values. All forces count as
equally well known: noise and drift of a dynamometer hardly depend on the force. A setting is taken once; a lab
repeats it to get its spread.
"""

import dataclasses
import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from osteomill.studies.calibration.fit import LARGEST_CONDITION, refuse_one_feed, scaled_condition
from osteomill.studies.calibration.forces import COEFFICIENTS, Array, regressors_of

FEWEST_RUNS = 3
STARTS = 8
#: A smaller difference between logarithms of determinants is none: two designs, mirrored left to right, are equally good.
EQUAL = 1e-9


@dataclasses.dataclass(frozen=True)
class Lattice:
    """Settings that the lab can make; every combination is a candidate, except those deeper than the burr's radius."""

    diameters_mm: Sequence[float] = (2.0, 4.0)
    feeds_mm_per_s: Sequence[float] = (1.0, 4.0, 16.0)
    rpm: Sequence[float] = (10_000.0, 20_000.0, 40_000.0)
    depths_mm: Sequence[float] = (0.2, 0.5, 1.0)
    tilts_deg: Sequence[float] = (0.0, 30.0, 45.0)
    tilt_directions_deg: Sequence[float] = (0.0, 90.0, 180.0, 270.0)
    edges: int = 8
    turns: str = "clockwise"

    def leaning(self) -> list[tuple[float, float]]:
        """Tilts with their directions: an upright burr leans nowhere."""
        return [(tilt, direction) for tilt in self.tilts_deg for direction in (self.tilt_directions_deg if tilt else (0.0,))]


@dataclasses.dataclass(frozen=True)
class Design:
    """Settings and their information, for forces that are all known to 1 N."""

    settings: pd.DataFrame
    determinant: float  #: of the information matrix, 0 if coefficients are lost
    condition: float  #: see LARGEST_CONDITION
    uncertainty: Array  #: standard, of each coefficient for each N of spread; infinite if it is lost


def candidates_of(lattice: Lattice) -> tuple[pd.DataFrame, Array]:
    """Settings, and the regressors of each (n, 3, 6)."""
    settings, regressors = [], []
    for diameter, depth, (tilt, direction) in itertools.product(lattice.diameters_mm, lattice.depths_mm, lattice.leaning()):
        if depth > 0.5 * diameter:
            continue
        first = None
        for feed, rpm in itertools.product(lattice.feeds_mm_per_s, lattice.rpm):
            settings.append({"diameter_mm": diameter, "edges": lattice.edges, "turns": lattice.turns, "rpm": rpm,
                             "feed_mm_per_s": feed, "depth_mm": depth, "tilt_deg": tilt, "tilt_direction_deg": direction})
            if first is None:
                first = pd.Series(settings[-1])
                of_geometry = regressors_of(first)
            # Geometry decides the forces. Beyond it, chip forces depend only on the feed of a revolution, edge forces on nothing.
            faster = (feed / rpm) / (first.feed_mm_per_s / first.rpm)
            regressors.append(of_geometry * ([faster] * 3 + [1.0] * 3))
    return pd.DataFrame(settings), np.array(regressors)


def optimal_design(settings: pd.DataFrame, regressors: Array, runs: int, seed: int) -> Design:
    """The best of STARTS exchanges from random designs. ValueError in one line if there are fewer candidates than runs, fewer
    than three runs, or no design separates all coefficients.
    """
    if runs < FEWEST_RUNS:
        raise ValueError(f"{runs} runs cannot give six coefficients; at least {FEWEST_RUNS}")
    if len(settings) < runs:
        raise ValueError(f"the lists make {len(settings)} settings (none is deeper than the burr's radius) for {runs} runs: "
                         "add values to a list, or ask for fewer runs")
    # Columns of like size, so that determinants are neither lost nor infinite.
    scaled = regressors / np.sqrt(np.mean(np.sum(regressors**2, axis=1), axis=0))
    information = scaled.transpose(0, 2, 1) @ scaled
    random = np.random.default_rng(seed)
    found = [_exchanged(information, runs, random) for _ in range(STARTS)]
    best = max(value for value, _ in found)
    taken = min(taken for value, taken in found if value > best - EQUAL)
    design = design_of(settings.iloc[taken], regressors[taken])
    refuse_one_feed(design.settings)
    if not design.condition <= LARGEST_CONDITION:
        raise ValueError(
            f"no {runs} of these settings tell the six coefficients apart (condition {design.condition:.3g}, at most "
            f"{LARGEST_CONDITION:g} is accepted): feeds of a revolution, depths and tilts must vary")
    return design


def _exchanged(information: Array, runs: int, random: np.random.Generator) -> tuple[float, list[int]]:
    """Improves a random design: each run is exchanged for the best candidate until no exchange is an improvement.

    The logarithm of the determinant, and the candidates in their order.
    """
    taken = random.permutation(len(information))[:runs]
    # A random design may hold no information on a coefficient: a trace of everything lets it recover.
    total = EQUAL * np.eye(len(COEFFICIENTS)) + information[taken].sum(axis=0)
    has_changed = True
    while has_changed:
        has_changed = False
        for place in range(runs):
            rest = total - information[taken[place]]
            values = _log_determinant(rest + information)
            values[taken] = -np.inf
            best = int(np.argmax(values))
            if values[best] > _log_determinant(total) + EQUAL:
                taken[place] = best
                total = rest + information[best]
                has_changed = True
    return float(_log_determinant(total)), sorted(int(run) for run in taken)


def _log_determinant(information: Array) -> Array:
    sign, logarithm = np.linalg.slogdet(information)
    return np.where(sign > 0.0, logarithm, -np.inf)


def one_factor_at_a_time(lattice: Lattice, runs: int) -> Design:
    """The obvious choice: the middle of each list, then one list after the other through its other values; from the
    start again until there are enough runs. A tilt is varied in all its directions."""
    diameter = _middle(lattice.diameters_mm)
    middle: dict[str, Any] = {"diameter_mm": diameter, "edges": lattice.edges, "turns": lattice.turns, "rpm": _middle(lattice.rpm),
              "feed_mm_per_s": _middle(lattice.feeds_mm_per_s), "depth_mm": min(_middle(lattice.depths_mm), 0.5 * diameter),
              "tilt_deg": 0.0, "tilt_direction_deg": 0.0}
    varied = {"diameter_mm": lattice.diameters_mm, "feed_mm_per_s": lattice.feeds_mm_per_s, "rpm": lattice.rpm,
              "depth_mm": lattice.depths_mm}
    rows = [middle]
    rows += [middle | {factor: value} for factor, values in varied.items() for value in values if value != middle[factor]]
    rows += [middle | {"tilt_deg": tilt, "tilt_direction_deg": direction} for tilt, direction in lattice.leaning() if tilt]
    rows = [row for row in rows if row["depth_mm"] <= 0.5 * row["diameter_mm"]]
    settings = pd.DataFrame(itertools.islice(itertools.cycle(rows), runs))
    return design_of(settings, np.array([regressors_of(run) for run in settings.itertuples()]))


def _middle(values: Sequence[float]) -> float:
    return sorted(values)[len(values) // 2]


def design_of(settings: pd.DataFrame, regressors: Array) -> Design:
    stacked = np.vstack(list(regressors))
    information = stacked.T @ stacked
    condition = scaled_condition(stacked)
    if condition >= 1e6:  # far below where rounding makes an inverse worthless
        return Design(settings, 0.0, condition, np.full(len(COEFFICIENTS), np.inf))
    uncertainty = np.sqrt(np.diag(np.linalg.inv(information)))
    return Design(settings, max(0.0, float(np.linalg.det(information))), condition, uncertainty)


def efficiency(design: Design, other: Design) -> float:
    """Number of runs of `other` that are as informative as one of `design`; infinite if `other` does not separate the
    coefficients."""
    if other.determinant == 0.0:
        return np.inf
    return float((design.determinant / other.determinant) ** (1.0 / len(COEFFICIENTS)))
