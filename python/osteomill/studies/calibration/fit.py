"""Fit of the six coefficients, with intervals and with reasons to refuse them.

Each force is divided by its spread, so that chi^2 = sum ((measured - fitted) / spread)^2 is least. The spreads are
standard deviations that the lab has measured, so the intervals are those of known variances (GUM: 1.96 standard
uncertainties), not estimated again from a few residuals. If chi^2 is so large that chance would exceed it in less than one set
of runs in twenty, the spreads do not explain the scatter. Then the uncertainties are multiplied by the Birge ratio, sqrt(chi^2 /
degrees of freedom), which is an estimate from the residuals, and Student's t takes the place of 1.96.

A robust fit takes less than the square of a large residual (soft L1, the smooth form of Huber's loss), so that runs that went
wrong have little weight. The distribution of the residuals is then unknown, so the interval comes from the runs themselves: by
the jackknife, which fits again without each run (Tukey 1958), and Student's t with a degree of freedom less than there are runs.
It also holds if all three forces of a run went wrong together.
"""

import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np
import scipy.optimize
import scipy.stats

from osteomill.studies.calibration.forces import AXES, COEFFICIENTS, SLOPES, ZEROS, Array, Forces, feed_per_tooth_mm

#: Condition number of the design, its rows divided by the spreads and its columns by their lengths, above which a
#: fit is refused. Depths, run-out and the law itself are true to some 3 %; errors of the design grow by up to this
#: factor in the coefficients, and 30 turns 3 % into everything. It is also where Belsley, Kuh and Welsch (1980) begin
#: to call dependencies strong.
LARGEST_CONDITION = 30.0
#: Least ratio of the largest to the smallest feed of a tooth. With one feed only the law's geometry separates chip forces from edge
#: forces: K_t t and K_te differ by how t falls towards the flanks of the slot, and a fit could not check that.
LEAST_VARIATION_OF_FEED = 2.0
#: The spreads are not believed if sound runs scatter so much in less than this share of tables.
IMPROBABLE = 0.05
TWO_SIDED_95 = 0.975
#: Residual at which soft L1 turns from squares to distances, in spreads: Huber's choice, which costs a twentieth of the
#: information in a table without outliers.
LARGE_RESIDUAL = 1.345
#: Information on the scatter in a median of absolute residuals, as a share of that in their squares, for a table without outliers.
EFFICIENCY_OF_MEDIAN = 0.37
#: A coefficient is named if its part in a dependency is at least this share of the largest part.
NOTABLE_PART = 0.2


@dataclasses.dataclass(frozen=True)
class Solution:
    """Solution from the forces, before their scatter is judged."""

    value: Array
    covariance: Array  #: for forces that scatter by their spreads
    condition: float  #: of the scaled design, see LARGEST_CONDITION
    freedom: int  #: forces too many
    scatter: float  #: of the forces about the fit, in spreads; NaN where none is too many
    scatter_freedom: float  #: how well that is known


@dataclasses.dataclass(frozen=True)
class Fit:
    unknowns: list[str]
    value: Array
    half_width: Array  #: of the 95 % interval
    uncertainty: Array  #: standard
    correlation: Array
    chi_squared: float
    degrees_of_freedom: int
    probability: float  #: of a chi^2 as large as that or larger by chance
    widened_by: float  #: the Birge ratio, or 1
    condition: float
    fitted_n: Array
    weight: Array  #: of each force, 1 in a fit of least squares
    predicted_n: Array  #: (runs, 3), of each run by the others; NaN if they cannot separate the coefficients
    studentised: Array  #: (runs, 3), what is wrong with that, in standard deviations
    outlying: Array  #: (runs,), probability that a run is so far off by chance


def refuse_one_feed(settings: Any) -> None:
    """ValueError in one line if the feed of a tooth hardly varies."""
    feeds_mm = feed_per_tooth_mm(settings)
    smallest, largest = feeds_mm.min(), feeds_mm.max()
    if largest < LEAST_VARIATION_OF_FEED * smallest:
        raise ValueError(
            f"the feed of a tooth is {1e3 * smallest:.3g} to {1e3 * largest:.3g} um in all runs, so chip forces (K_t, K_r, "
            "K_a) and edge forces (K_te, K_re, K_ae) cannot be told apart: the largest must be at least "
            f"{LEAST_VARIATION_OF_FEED:g} times the smallest")


def scaled_condition(design: Array) -> float:
    """Infinite if a column has no part in anything, or there are fewer rows than columns."""
    lengths = np.linalg.norm(design, axis=0)
    if len(design) < design.shape[1] or not lengths.all():
        return np.inf
    return float(np.linalg.cond(design / lengths))


def fit_forces(forces: Forces, is_robust: bool = False) -> Fit:
    """ValueError in one line: for fewer than three runs (six forces leave nothing to check six coefficients by), for a design
    that cannot separate coefficients (it names them), for an interval that means more force than was measured anywhere (it names
    it).
    """
    _refuse_too_few(forces)
    _refuse_inseparable(forces)
    whole = solve(forces, is_robust)
    rest = [solve(others, is_robust) if _tells_all_apart(others := forces.without(run)) else None
            for run in range(len(forces.runs))]
    fitted_n = forces.regressors @ whole.value
    residuals = (forces.force_n - fitted_n) / forces.spread_n
    chi_squared = float(residuals @ residuals)
    probability = float(scipy.stats.chi2.sf(chi_squared, whole.freedom))
    widened_by = 1.0
    if is_robust:
        covariance, factor = _jackknifed(forces, rest), _students(len(forces.runs) - 1)
    elif probability < IMPROBABLE:
        widened_by = float(np.sqrt(chi_squared / whole.freedom))
        covariance, factor = widened_by**2 * whole.covariance, _students(whole.freedom)
    else:
        covariance, factor = whole.covariance, float(scipy.stats.norm.ppf(TWO_SIDED_95))
    uncertainty = np.sqrt(np.diag(covariance))
    surprises = [_surprise(forces.of_run(run), others) for run, others in enumerate(rest)]
    fit = Fit(
        unknowns=forces.unknowns,
        value=whole.value,
        half_width=factor * uncertainty,
        uncertainty=uncertainty,
        correlation=covariance / np.outer(uncertainty, uncertainty),
        chi_squared=chi_squared,
        degrees_of_freedom=whole.freedom,
        probability=probability,
        widened_by=widened_by,
        condition=whole.condition,
        fitted_n=fitted_n,
        weight=_weights(residuals) if is_robust else np.ones_like(residuals),
        predicted_n=np.array([_predicted_n(forces.of_run(run), others) for run, others in enumerate(rest)]),
        studentised=np.array([studentised for studentised, _ in surprises]),
        outlying=np.array([probability for _, probability in surprises]),
    )
    _refuse_what_tells_nothing(forces, fit)
    return fit


def _students(freedom: int) -> float:
    return float(scipy.stats.t.ppf(TWO_SIDED_95, freedom))


def solve(forces: Forces, is_robust: bool = False) -> Solution:
    """Solution of a design that separates all unknowns."""
    design = forces.design()
    lengths = np.linalg.norm(design, axis=0)  # coefficients differ by a factor of a hundred and more
    left, singular, right = np.linalg.svd(design / lengths, full_matrices=False)
    measured = forces.force_n / forces.spread_n
    scaled_value = right.T @ (left.T @ measured / singular)
    if is_robust:
        scaled_value = _softly_fitted(design / lengths, measured, scaled_value)
    residuals = measured - design / lengths @ scaled_value
    freedom = len(residuals) - len(lengths)
    return Solution(
        value=scaled_value / lengths,
        covariance=(right.T / singular**2) @ right / np.outer(lengths, lengths),
        condition=float(singular[0] / singular[-1]),
        freedom=freedom,
        scatter=_scatter(residuals, freedom, is_robust),
        scatter_freedom=freedom * EFFICIENCY_OF_MEDIAN if is_robust else freedom,
    )


def _softly_fitted(design: Array, measured: Array, begin: Array) -> Array:
    found = scipy.optimize.least_squares(
        lambda value: design @ value - measured,
        begin,
        jac=lambda value: design.copy(),  # which least_squares scales in place
        loss="soft_l1",
        f_scale=LARGE_RESIDUAL,
        xtol=1e-12,
        ftol=1e-12,
        gtol=1e-12,
    )
    return np.asarray(found.x)


def _weights(residuals: Array) -> Array:
    """Weights of soft L1: psi(r) / r."""
    weights: Array = 1.0 / np.sqrt(1.0 + (residuals / LARGE_RESIDUAL) ** 2)
    return weights


def _scatter(residuals: Array, freedom: int, is_robust: bool) -> float:
    if freedom <= 0:
        return np.nan
    if is_robust:  # of most forces, whatever the others are
        return float(np.median(np.abs(residuals)) / scipy.stats.norm.ppf(0.75) * np.sqrt(len(residuals) / freedom))
    return float(np.sqrt(residuals @ residuals / freedom))


def _jackknifed(forces: Forces, rest: Sequence[Solution | None]) -> Array:
    """Covariance of the values, from the change that each run makes in them."""
    for run, others in zip(forces.runs, rest):
        if others is None:
            raise ValueError(f"a robust fit cannot tell whether run {run} is right: without it coefficients cannot be told "
                             "apart; repeat it under another name")
    values = np.array([others.value for others in rest if others is not None])
    changes = values - values.mean(axis=0)
    return np.asarray((1.0 - 1.0 / len(values)) * changes.T @ changes)


def _predicted_n(run: Forces, others: Solution | None) -> Array:
    return run.force_n * np.nan if others is None else run.regressors @ others.value


def _surprise(run: Forces, others: Solution | None) -> tuple[Array, float]:
    """Distance of a run from the prediction by the others: of each force by the standard deviation of the difference (externally
    studentised), and the probability of all three together by chance (Hotelling's F). NaN if the others cannot predict it.
    """
    error_n = run.force_n - _predicted_n(run, others)
    if others is None or not others.scatter > 0.0:
        return error_n * np.nan, np.nan
    covariance = others.scatter**2 * (np.diag(run.spread_n**2) + run.regressors @ others.covariance @ run.regressors.T)
    distance = float(error_n @ np.linalg.solve(covariance, error_n)) / len(error_n)
    probability = float(scipy.stats.f.sf(distance, len(error_n), others.scatter_freedom))
    return error_n / np.sqrt(np.diag(covariance)), probability


def _tells_all_apart(forces: Forces) -> bool:
    return scaled_condition(forces.design()) <= LARGEST_CONDITION


def _refuse_too_few(forces: Forces) -> None:
    count, unknowns = len(forces.force_n), len(forces.unknowns)
    if count <= unknowns:
        raise ValueError(
            f"{count} forces of {len(forces.runs)} runs for {unknowns} coefficients: there must be more forces than "
            f"coefficients, so at least {unknowns // len(AXES) + 1} runs")


def _refuse_inseparable(forces: Forces) -> None:
    design = forces.design()
    lengths = np.linalg.norm(design, axis=0)
    for name, length in zip(forces.unknowns, lengths):
        if not length > 0.0:
            raise ValueError(f"no run has a force that depends on {name}")
    condition = scaled_condition(design)
    if condition <= LARGEST_CONDITION:
        return
    least_seen = np.abs(np.linalg.svd(design / lengths)[2][-1])
    names = [name for name, part in zip(forces.unknowns, least_seen) if part >= NOTABLE_PART * least_seen.max()]
    raise ValueError(f"the runs cannot tell {', '.join(names)} apart (condition {condition:.3g}, at most "
                     f"{LARGEST_CONDITION:g} is accepted): {_advice(names)}")


def _advice(names: list[str]) -> str:
    if set(names) & set(SLOPES):
        return "drift parts from the law when the order of the runs is random: number them in the column order"
    if set(names) & set(ZEROS):
        return "an unknown zero parts from the law when depth and tilt vary: add runs, or zero before the first and take a slope"
    are_of_edges = {name.endswith("e") for name in names}
    if len(are_of_edges) == 2:
        return "chip and edge forces part when the feed of a revolution varies: add runs of other feeds or speeds"
    return "directions part when depth and tilt vary: add runs that are deeper, shallower or tilted"


def _refuse_what_tells_nothing(forces: Forces, fit: Fit) -> None:
    """An interval of a coefficient means a force: the one that its half width would make in the run where it makes most."""
    largest_n = np.abs(forces.force_n).max()
    for i, (name, unit) in enumerate(COEFFICIENTS.items()):
        stands_for_n = fit.half_width[i] * np.abs(forces.regressors[:, i]).max()
        if stands_for_n > largest_n:
            raise ValueError(
                f"the interval of {name}, {fit.value[i]:.3g} +- {fit.half_width[i]:.3g} {unit}, stands for up to "
                f"{stands_for_n:.3g} N, and no force is above {largest_n:.3g} N: it would tell nothing; measure more often, "
                "or larger forces")
