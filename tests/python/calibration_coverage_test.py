"""The coverage of a calibration's intervals, over many simulated labs, is as promised.

Each lab makes the 24 runs of the default design in random order, with noise of 0.05 N; its dynamometer drifts, or some of its
runs go wrong: they were a fifth too deep or too shallow, and all three forces with it. `python3 calibration_coverage_test.py
LABS` prints the table of docs/calibration.md.
"""

import dataclasses
import io
import pathlib
import sys
import unittest

import numpy as np
import pandas as pd
import scipy.stats

from osteomill.studies.calibration.fit import fit_forces
from osteomill.studies.calibration.forces import AXES, COEFFICIENTS
from osteomill.studies.calibration.report import SURPRISING
from synthetic_runs import KNOWN, exact_forces, runs_of

SPREAD_N = 0.05
DESIGN = pathlib.Path(__file__).resolve().parents[1] / "data" / "calibration_golden" / "design.txt"


@dataclasses.dataclass(frozen=True)
class Lab:
    """A fault of the lab."""

    what: str
    drift_n: float = 0.0  #: along each axis, either way, from the first run to the last
    zeroed_at: float = 0.0  #: 0 before the first run, 0.5 half way
    wrong_runs: float = 0.0  #: share


CLEAN = Lab("nothing is wrong")
DRIFTS = [Lab(f"drift of {drift_n:g} N", drift_n=drift_n) for drift_n in (0.05, 0.1, 0.15)]
NO_ZERO = Lab("drift of 0.15 N, zeroed half way", drift_n=0.15, zeroed_at=0.5)
WRONG = [Lab(f"{100 * share:g} % of runs wrong", wrong_runs=share) for share in (0.1, 0.2)]
BOTH = Lab("drift of 0.1 N, 10 % of runs wrong", drift_n=0.1, wrong_runs=0.1)

#: The table's rows: a lab, and how it is fitted.
ROWS = [
    *((lab, {}) for lab in (CLEAN, *DRIFTS, *WRONG)),
    *((lab, {"drift": "slope"}) for lab in (CLEAN, *DRIFTS, NO_ZERO)),
    *((lab, {"drift": "line"}) for lab in (CLEAN, NO_ZERO)),
    *((lab, {"is_robust": True}) for lab in (CLEAN, *WRONG)),
    (BOTH, {"drift": "slope", "is_robust": True}),
]


class Simulation:
    """Labs of one kind, fitted in one way. The same seed gives the same labs."""

    def __init__(self, lab, labs, seed, drift="none", is_robust=False):
        head = "".join(DESIGN.read_text(encoding="utf-8").splitlines(keepends=True)[:25])
        settings = pd.read_csv(io.StringIO(head)).filter(regex="diameter|edges|turns|rpm|feed_mm|depth|tilt")
        self.lab, self.drift, self.is_robust = lab, drift, is_robust
        self.exact = exact_forces(runs_of(settings), SPREAD_N, drift)
        self.usual_half_width = fit_forces(exact_forces(runs_of(settings), SPREAD_N)).half_width
        self.held = np.zeros(len(KNOWN), int)  #: by how many labs' intervals, each coefficient
        self.widths = np.zeros(len(KNOWN))
        self.accusing = self.wrong = self.found = 0  #: labs that name a good run; runs that are wrong; those of them that are named
        random = np.random.default_rng(seed)
        for _ in range(labs):
            self._add(random)
        self.widths /= labs * self.usual_half_width

    def _add(self, random):
        runs = len(self.exact.runs)
        order = random.permutation(runs) / (runs - 1)
        drift_n = self.lab.drift_n * random.choice([-1.0, 1.0], len(AXES))
        noise_n = SPREAD_N * random.normal(size=(runs, len(AXES)))
        is_wrong = random.random(runs) < self.lab.wrong_runs
        too_much = np.where(is_wrong, random.choice([-0.2, 0.2], runs), 0.0)
        force_n = self.exact.force_n.reshape(runs, -1) * (1.0 + too_much[:, None]) + noise_n
        force_n += np.outer(order - self.lab.zeroed_at, drift_n)
        regressors = self.exact.regressors.copy()
        if self.drift != "none":
            regressors[:, len(COEFFICIENTS) : len(COEFFICIENTS) + len(AXES)] = np.kron(order[:, None], np.eye(len(AXES)))
        fit = fit_forces(dataclasses.replace(self.exact, regressors=regressors, force_n=force_n.ravel()), self.is_robust)
        half_width = fit.half_width[: len(KNOWN)]
        self.held += np.abs(fit.value[: len(KNOWN)] - KNOWN) <= half_width
        self.widths += half_width
        is_named = runs * fit.outlying < SURPRISING
        self.accusing += bool((is_named & ~is_wrong).any())
        self.wrong += int(is_wrong.sum())
        self.found += int((is_named & is_wrong).sum())


class CalibrationCoverageTest(unittest.TestCase):
    LABS = 100

    def assert_held(self, lab, low_percent, high_percent, **how):
        """Each coefficient's share of labs is compatible with the level; by chance the check fails for one seed of a thousand."""
        found = Simulation(lab, self.LABS, seed=11, **how)
        low = scipy.stats.binom.ppf(0.001 / 12, self.LABS, low_percent / 100)
        high = scipy.stats.binom.isf(0.001 / 12, self.LABS, high_percent / 100)
        self.assertGreaterEqual(found.held.min(), low, found.held)
        self.assertLessEqual(found.held.max(), high, found.held)
        return found

    def test_holds_in_95_of_100_labs_where_nothing_is_wrong(self):
        for drift in ("none", "slope", "line"):
            with self.subTest(drift):
                self.assert_held(CLEAN, 95, 95, drift=drift)

    def test_a_drift_that_is_left_in_spoils_the_intervals(self):
        found = Simulation(DRIFTS[-1], self.LABS, seed=11)
        self.assertLess(found.held.min(), 0.6 * self.LABS)

    def test_a_slope_holds_where_the_dynamometer_drifts(self):
        for lab in DRIFTS:
            with self.subTest(lab.what):
                self.assert_held(lab, 95, 95, drift="slope")

    def test_a_line_holds_where_the_zero_is_not_known(self):
        self.assert_held(NO_ZERO, 95, 95, drift="line")

    def test_the_jackknife_of_a_robust_fit_holds(self):
        self.LABS = 60
        self.assert_held(CLEAN, 93, 96, is_robust=True)
        found = self.assert_held(WRONG[0], 93, 99, is_robust=True)
        squares = Simulation(WRONG[0], self.LABS, seed=11)
        self.assertLess(found.widths.mean(), 0.4 * squares.widths.mean())

    def test_names_runs_that_are_wrong_and_few_others(self):
        """Which cannot be named are those whose error is small, or hidden by others."""
        clean = Simulation(CLEAN, self.LABS, seed=12)
        self.assertLessEqual(clean.accusing, scipy.stats.binom.isf(0.001, self.LABS, SURPRISING))
        wrong = Simulation(WRONG[0], 100, seed=12, is_robust=True)
        self.assertGreater(wrong.found, 0.9 * wrong.wrong)


def table(labs):
    """Markdown."""
    head = ["in the lab", "fitted with", "intervals that hold, %", "the worst coefficient's, %", "width", "wrong runs named, %",
            "labs where a good run is named, %"]
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    for lab, how in ROWS:
        found = Simulation(lab, labs, seed=1, **how)
        options = [f"`--drift {how['drift']}`"] if "drift" in how else []
        options += ["`--robust`"] if "is_robust" in how else []
        held = 100.0 * found.held / labs
        named = f"{100.0 * found.found / found.wrong:.0f}" if found.wrong else ""
        cells = [lab.what, " ".join(options), f"{held.mean():.1f}", f"{held.min():.1f}",
                 f"{found.widths.min():.2f} to {found.widths.max():.2f}", named, f"{100.0 * found.accusing / labs:.0f}"]
        lines.append("| " + " | ".join(cells) + " |")
        print(lines[-1], file=sys.stderr, flush=True)
    return "\n".join(lines)


if __name__ == "__main__":
    if len(sys.argv) > 1 and sys.argv[1].isdecimal():
        print(table(int(sys.argv[1])))
    else:
        unittest.main()
