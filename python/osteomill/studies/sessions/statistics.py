"""Statistics of several sessions: means, trends with practice, two groups compared, runs of passes.

Intervals are of 95 %.
"""

import dataclasses
import enum
import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
import scipy.special
import scipy.stats

CONFIDENCE = 0.95
FEWEST_REFERENCES = 4
FEWEST_COMPARED = 3  # of each group: fewer allow no statement about others
MOST_RANKED = 200

Interval = tuple[float, float]


class Possible(enum.Enum):
    """Range of values that a metric can have."""

    ANY = enum.auto()
    NOT_NEGATIVE = enum.auto()
    SHARE = enum.auto()  # from 0 to 1

    def interval(self, mean: float, half: float) -> Interval:
        """Student's interval mean -+ half, computed on a scale without impossible values, and carried back.

        The scale is the square root, for shares its arcsine; to first order (the delta method) both stretch `half` by
        their slope at the mean.
        """
        if self is Possible.NOT_NEGATIVE and mean > 0.0:
            middle, half = math.sqrt(mean), half / (2.0 * math.sqrt(mean))
            return max(0.0, middle - half) ** 2, (middle + half) ** 2
        if self is Possible.SHARE and 0.0 < mean < 1.0:
            middle, half = math.asin(math.sqrt(mean)), half / (2.0 * math.sqrt(mean * (1.0 - mean)))
            return math.sin(max(0.0, middle - half)) ** 2, math.sin(min(0.5 * math.pi, middle + half)) ** 2
        return self.cut((mean - half, mean + half))

    def cut(self, interval: Interval) -> Interval:
        low = -math.inf if self is Possible.ANY else 0.0
        high = 1.0 if self is Possible.SHARE else math.inf
        return min(max(interval[0], low), high), min(max(interval[1], low), high)

    def difference(self, interval: Interval) -> Interval:
        """Interval of the difference of two such values: two shares are never more than 1 apart."""
        most = 1.0 if self is Possible.SHARE else math.inf
        return max(interval[0], -most), min(interval[1], most)


@dataclasses.dataclass(frozen=True)
class Mean:
    """Mean of values that are about normal, with its interval by Student's t; None for fewer than two values."""

    n: int
    mean: float
    interval: Interval | None


def mean_of(values: Sequence[float], possible: Possible = Possible.ANY) -> Mean | None:
    """None if there are no values."""
    n = len(values)
    if n == 0:
        return None
    mean = float(np.mean(values))
    if n == 1:
        return Mean(1, mean, None)
    half = _errors(n - 1.0) * float(np.std(values, ddof=1)) / math.sqrt(n)
    return Mean(n, mean, possible.interval(mean, half))


def middle_half(values: Sequence[float]) -> Interval | None:
    """From the first quartile to the third (Hyndman and Fan, definition 7); None for fewer than four values."""
    if len(values) < FEWEST_REFERENCES:
        return None
    low, high = np.quantile(values, (0.25, 0.75))
    return float(low), float(high)


@dataclasses.dataclass(frozen=True)
class PracticeTrend:
    """y_ij = a_i + b ln(n_ij) + e_ij: a level a_i for each trainee, one slope b for all, by least squares.

    So differences between trainees do not count as learning; R: lm(y ~ trainee + log(n)). The line is that of the trainees at
    their mean level, each weighed by the number of attempts; its interval is that of this mean.
    """

    n: int
    degrees: float
    mean_log: float
    mean_value: float
    spread: float  # sum of squares of ln(n) within trainees
    slope: float  # change per factor e of attempts
    variance: float  # of e

    def slope_interval(self) -> Interval:
        half = _errors(self.degrees) * math.sqrt(self.variance / self.spread)
        return self.slope - half, self.slope + half

    def p(self) -> float:
        """Two-sided, of no trend."""
        if self.variance == 0.0:
            return 1.0 if self.slope == 0.0 else 0.0
        return _two_sided_p(self.slope / math.sqrt(self.variance / self.spread), self.degrees)

    def at(self, attempt: float) -> float:
        return self.mean_value + self.slope * (math.log(attempt) - self.mean_log)

    def interval_at(self, attempt: float, possible: Possible = Possible.ANY) -> Interval:
        off = math.log(attempt) - self.mean_log
        half = _errors(self.degrees) * math.sqrt(self.variance * (1.0 / self.n + off * off / self.spread))
        return possible.interval(self.at(attempt), half)


def practice_trend(values: pd.DataFrame) -> PracticeTrend | None:
    """Trend from columns trainee, attempt (from 1) and value; None if no trainee has two attempts, or no degree of freedom is
    left."""
    if values.empty:
        return None
    both = pd.DataFrame({"log": np.log(values["attempt"]), "value": values["value"]})
    within = both - both.groupby(values["trainee"]).transform("mean")
    spread = float((within["log"] ** 2).sum())
    degrees = len(values) - values["trainee"].nunique() - 1.0
    if not spread > 0.0 or degrees < 1.0:
        return None
    product = float((within["log"] * within["value"]).sum())
    slope = product / spread
    variance = max(0.0, float((within["value"] ** 2).sum()) - slope * product) / degrees
    return PracticeTrend(len(values), degrees, float(both["log"].mean()), float(both["value"].mean()), spread, slope, variance)


@dataclasses.dataclass(frozen=True)
class WelchComparison:
    """Welch's t of two means whose variances may differ (Biometrika 34, 1947), and Hedges' g in its exact form."""

    difference: float  # first less second
    interval: Interval
    p: float  # two-sided
    hedges_g: float


def compare_means(first: Sequence[float], second: Sequence[float]) -> WelchComparison | None:
    """None if a group has fewer than two values, or neither varies."""
    if len(first) < 2 or len(second) < 2:
        return None
    n = np.array([len(first), len(second)], float)
    variance = np.array([np.var(first, ddof=1), np.var(second, ddof=1)])
    squared_errors = variance / n
    squared_error = float(squared_errors.sum())
    if not squared_error > 0.0:
        return None
    difference = float(np.mean(first) - np.mean(second))
    degrees = squared_error**2 / float((squared_errors**2 / (n - 1.0)).sum())
    half = _errors(degrees) * math.sqrt(squared_error)
    pooled_degrees = float(n.sum()) - 2.0
    pooled = math.sqrt(float(((n - 1.0) * variance).sum()) / pooled_degrees)
    return WelchComparison(
        difference,
        (difference - half, difference + half),
        float(scipy.stats.ttest_ind(first, second, equal_var=False).pvalue),
        _small_sample_correction(pooled_degrees) * difference / pooled,
    )


@dataclasses.dataclass(frozen=True)
class RankComparison:
    """Mann and Whitney's test (Annals of Mathematical Statistics 18, 1947), exact for the ranks at hand.

    Ties are midranks, which SciPy's exact test ignores: all ways to deal them out are counted. Cliff's delta is the
    chance that a value of the first group is above one of the second, less the chance that it is below.
    """

    u: float  # of the first group: pairs in which it is above, ties half
    p: float  # two-sided: twice the smaller tail
    cliffs_delta: float


def compare_ranks(first: Sequence[float], second: Sequence[float]) -> RankComparison | None:
    """None if a group is empty, or there are more than MOST_RANKED values."""
    n1, n2 = len(first), len(second)
    if n1 == 0 or n2 == 0 or n1 + n2 > MOST_RANKED:
        return None
    # Twice the midranks are whole numbers.
    ranks = np.rint(2.0 * scipy.stats.rankdata(np.concatenate([first, second]))).astype(int)
    rank_sum = int(ranks[:n1].sum())
    ways = _ways_of_sums(ranks, n1)
    at_most, at_least = ways[: rank_sum + 1].sum(), ways[rank_sum:].sum()
    u = 0.5 * rank_sum - 0.5 * n1 * (n1 + 1.0)
    p = min(1.0, 2.0 * float(min(at_most, at_least) / ways.sum()))
    return RankComparison(u, p, 2.0 * u / (n1 * n2) - 1.0)


def _ways_of_sums(ranks: "np.ndarray[tuple[int], np.dtype[np.int64]]", count: int) -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
    """Number of ways in which `count` of the ranks have each sum."""
    ways = np.zeros((count + 1, int(ranks.sum()) + 1))
    ways[0, 0] = 1.0
    behind = 1  # the largest sum so far
    for n, rank in enumerate(ranks.tolist(), 1):
        behind += rank
        most = min(n, count)
        ways[1 : most + 1, rank:behind] += ways[:most, : behind - rank].copy()
    found: "np.ndarray[tuple[int], np.dtype[np.float64]]" = ways[count]
    return found


@dataclasses.dataclass(frozen=True)
class CusumDesign:
    """Cumulative sum of failures against an acceptable rate: Wald's sequential test.

    A failure adds 1 - step, a pass subtracts step. A rise beyond one level shows that failures are at the unacceptable rate, a
    fall that they are at the acceptable one. Bolsin and Colson, International Journal for Quality in Health Care 12 (2000).
    """

    acceptable_rate: float = 0.2
    unacceptable_rate: float = 0.4
    error: float = 0.1  # the probability of either wrong conclusion

    def step(self) -> float:
        return self._q() / (self._p() + self._q())

    def level(self) -> float:
        """The rise, or the fall, that decides."""
        return math.log((1.0 - self.error) / self.error) / (self._p() + self._q())

    def sums(self, has_passed: Sequence[bool]) -> list[float]:
        """Sums, from 0 on."""
        steps = [(0.0 if passed else 1.0) - self.step() for passed in has_passed]
        return [0.0, *np.cumsum(steps).tolist()]

    def _p(self) -> float:
        return math.log(self.unacceptable_rate / self.acceptable_rate)

    def _q(self) -> float:
        return math.log((1.0 - self.acceptable_rate) / (1.0 - self.unacceptable_rate))


def _errors(degrees: float) -> float:
    """Number of standard errors between an estimate and either end of its interval."""
    return float(scipy.stats.t.ppf(0.5 + 0.5 * CONFIDENCE, degrees))


def _two_sided_p(t: float, degrees: float) -> float:
    return 2.0 * float(scipy.stats.t.sf(abs(t), degrees))


def _small_sample_correction(degrees: float) -> float:
    """Gamma(m/2) / (sqrt(m/2) Gamma((m-1)/2)), about 1 - 3 / (4 m - 1)."""
    gammas = scipy.special.gammaln(0.5 * degrees) - scipy.special.gammaln(0.5 * (degrees - 1.0))
    return math.exp(float(gammas)) / math.sqrt(0.5 * degrees)
