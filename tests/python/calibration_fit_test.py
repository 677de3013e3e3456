"""The fit of a calibration: exact forces, reasons to refuse, which runs to distrust."""

import dataclasses
import unittest

import numpy as np
import pandas as pd

from osteomill.studies.calibration.fit import LARGEST_CONDITION, fit_forces, refuse_one_feed, scaled_condition
from osteomill.studies.calibration.forces import regressors_of
from synthetic_runs import KNOWN, exact_forces, measured, settings_of, twelve_settings

OF_ONE_FEED_AND_DEPTH = settings_of(tilt_deg=[10.0] * 6, tilt_direction_deg=[0.0, 60.0, 120.0, 180.0, 240.0, 300.0])


def changed(forces, rows, by_n):
    force_n = forces.force_n.copy()
    force_n[rows] += by_n
    return dataclasses.replace(forces, force_n=force_n)


class SlotForceTest(unittest.TestCase):
    def test_of_an_upright_slot_is_that_of_the_closed_form(self):
        settings = settings_of(diameter_mm=[5.0] * 2, rpm=[10_000.0] * 2, depth_mm=[1.0] * 2,
                               turns=["clockwise", "counter-clockwise"])
        run, other = settings.itertuples()
        per_turn_mm = run.feed_mm_per_s / (run.rpm / 60.0)
        kappa = np.arccos(1.0 - run.depth_mm / 2.5)
        i_s = 2.5 * (kappa / 2.0 - np.sin(2.0 * kappa) / 4.0)
        i_c = 2.5 * np.sin(kappa) ** 2 / 2.0
        r = regressors_of(run)
        np.testing.assert_allclose(
            [r[0, 1], r[0, 2], abs(r[1, 0]), r[2, 1]],
            per_turn_mm * np.array([-i_s / 4.0, -i_c / 4.0, run.depth_mm / 4.0, i_c / np.pi]), atol=2e-3 * per_turn_mm)
        # An edge that is engaged over half a turn: mean of cos psi 1/pi over the whole, arc R kappa.
        self.assertAlmostEqual(abs(r[1, 3]), run.edges / np.pi * 2.5 * kappa, delta=0.01)
        # Seen from above, the front of a clockwise burr moves to the right: the bone there pushes it to the left.
        self.assertGreater(r[1, 0], 0.0)
        self.assertAlmostEqual(regressors_of(other)[1, 0], -r[1, 0])

    def test_is_as_exact_as_a_dynamometer_asks(self):
        settings = settings_of(depth_mm=[0.1, 2.0, 0.8], tilt_deg=[30.0, 60.0, 20.0], tilt_direction_deg=[40.0, 180.0, 0.0])
        settings["previous_groove_mm_higher"] = [np.nan, np.nan, 0.3]
        for run in settings.itertuples():
            exact_n = regressors_of(run, finer=4) @ KNOWN
            np.testing.assert_array_less(np.linalg.norm(regressors_of(run) @ KNOWN - exact_n), 3e-3 * np.linalg.norm(exact_n))


class CalibrationFitTest(unittest.TestCase):
    def refusal(self, forces, is_robust=False):
        with self.assertRaises(ValueError) as refused:
            fit_forces(forces, is_robust)
        self.assertNotIn("\n", str(refused.exception))
        return str(refused.exception)

    def test_finds_the_coefficients_of_exact_forces(self):
        for is_robust in (False, True):
            fit = fit_forces(exact_forces(twelve_settings(), 0.1), is_robust)
            np.testing.assert_allclose(fit.value, KNOWN, rtol=1e-9)
            self.assertLess(fit.chi_squared, 1e-15)
            self.assertEqual((fit.degrees_of_freedom, fit.widened_by), (30, 1.0))

    def test_widens_intervals_where_forces_scatter_more_than_their_spreads_say(self):
        fit = fit_forces(measured(exact_forces(twelve_settings()), np.random.default_rng(1), noise=3.0))
        self.assertAlmostEqual(fit.widened_by, 3.0, delta=1.0)
        self.assertLess(fit.probability, 1e-6)

    def test_believes_forces_by_their_spreads(self):
        forces = changed(exact_forces(twelve_settings()), slice(0, 3), 5.0)
        forces.spread_n[:3] = 1000.0
        np.testing.assert_allclose(fit_forces(forces).value, KNOWN, rtol=1e-3)

    def test_finds_a_drift_beside_the_coefficients(self):
        for drift, true_drift_n in (("slope", [0.1, -0.05, 0.15]), ("line", [0.1, -0.05, 0.15, 0.02, 0.0, -0.03])):
            forces = exact_forces(twelve_settings(), drift=drift)
            drifting = changed(forces, slice(None), forces.regressors[:, 6:] @ true_drift_n)
            fit = fit_forces(drifting)
            np.testing.assert_allclose(fit.value, [*KNOWN, *true_drift_n], rtol=1e-7, atol=1e-9)

    def test_gives_runs_that_went_wrong_little_weight(self):
        wrong = changed(exact_forces(twelve_settings()), slice(6, 9), 2.0)
        robust, squares = fit_forces(wrong, is_robust=True), fit_forces(wrong)
        self.assertLess(np.linalg.norm((robust.value - KNOWN) / KNOWN), 0.2 * np.linalg.norm((squares.value - KNOWN) / KNOWN))
        self.assertLess(robust.weight[6:9].max(), 0.1)
        self.assertGreater(np.delete(robust.weight, [6, 7, 8]).min(), 0.5)

    def test_is_the_least_squares_fit_where_nothing_is_far_from_the_law(self):
        forces = measured(exact_forces(twelve_settings()), np.random.default_rng(3), noise=0.01)
        np.testing.assert_allclose(fit_forces(forces, is_robust=True).value, fit_forces(forces).value, rtol=1e-6)

    def test_refuses_what_the_runs_cannot_tell_apart(self):
        said = self.refusal(exact_forces(OF_ONE_FEED_AND_DEPTH, 0.01))
        self.assertIn("cannot tell K_r, K_re apart", said)
        self.assertIn("feed of a revolution", said)
        # Small spreads make no design better.
        self.assertGreater(scaled_condition(exact_forces(OF_ONE_FEED_AND_DEPTH, 1e-6).design()), LARGEST_CONDITION)

    def test_refuses_directions_that_one_depth_confounds(self):
        forces = exact_forces(settings_of(feed_mm_per_s=[1.0, 3.0, 12.0, 24.0]), 0.01)
        # Nothing is known of the upward force, and that along the feed is one sum of K_r and K_a at one depth.
        forces.spread_n[2::3] = 1e6
        self.assertRegex(self.refusal(forces), r"^(?=.*K_r)(?=.*K_a)(?!.*K_t\b).*apart")

    def test_refuses_a_drift_that_the_order_of_the_runs_confounds(self):
        faster_and_faster = settings_of(feed_mm_per_s=np.linspace(1.0, 9.0, 8))
        said = self.refusal(exact_forces(faster_and_faster, drift="slope"))
        self.assertRegex(said, "cannot tell K_t, .*drift_.* apart")
        self.assertIn("in the column order", said)

    def test_refuses_one_feed_however_the_runs_differ_otherwise(self):
        grid = [(depth, tilt, faster) for depth in (0.1, 0.5, 2.0) for tilt in (0.0, 45.0) for faster in (1.0, 2.0)]
        depths, tilts, faster = map(np.array, zip(*grid))
        settings = settings_of(rpm=10_000.0 * faster, feed_mm_per_s=4.0 * faster, depth_mm=depths, tilt_deg=tilts)
        with self.assertRaisesRegex(ValueError, "3 to 3 um.*cannot be told apart.*2 times"):
            refuse_one_feed(settings)
        settings.loc[0, "feed_mm_per_s"] *= 2.0
        refuse_one_feed(settings)

    def test_refuses_fewer_forces_than_it_can_check(self):
        said = self.refusal(exact_forces(twelve_settings()[:2]))
        self.assertIn("6 forces of 2 runs for 6 coefficients", said)
        self.assertIn("at least 3 runs", said)
        self.assertIn("at least 4 runs", self.refusal(exact_forces(twelve_settings()[:2], drift="slope")))

    def test_refuses_intervals_that_tell_nothing(self):
        self.assertRegex(self.refusal(exact_forces(twelve_settings(), 100.0)), "the interval of .* would tell nothing")

    def test_predicts_each_run_by_the_others(self):
        exact = exact_forces(twelve_settings())
        predicted_n = fit_forces(changed(exact, 3, 10.0)).predicted_n.ravel()
        np.testing.assert_allclose(predicted_n[3:6], exact.force_n[3:6], atol=1e-9)  # what is wrong is left out
        self.assertGreater(np.linalg.norm(predicted_n[6:9] - exact.force_n[6:9]), 0.01)

    def test_says_which_run_alone_carries_a_coefficient(self):
        settings = pd.concat([OF_ONE_FEED_AND_DEPTH, settings_of(feed_mm_per_s=[60.0], tilt_deg=[10.0])])
        fit = fit_forces(exact_forces(settings))
        self.assertEqual(np.isnan(fit.predicted_n).any(axis=1).tolist(), [False] * 6 + [True])
        self.assertIn("whether run 7 is right", self.refusal(exact_forces(settings), is_robust=True))

    def test_is_surprised_by_a_run_that_the_others_contradict(self):
        forces = measured(exact_forces(twelve_settings()), np.random.default_rng(5))
        fit = fit_forces(changed(forces, slice(12, 15), 0.4))
        self.assertEqual(np.argmin(fit.outlying), 4)
        self.assertLess(12 * fit.outlying[4], 0.001)
        self.assertGreater(np.abs(fit.studentised[4]).min(), 3.0)
        self.assertGreater(np.delete(fit.outlying, 4).min(), 0.05 / 12)

    def test_bad_runs_hide_each_other_only_from_least_squares(self):
        bad = measured(exact_forces(twelve_settings()), np.random.default_rng(5))
        for run in (4, 6, 9):
            bad = changed(bad, slice(3 * run, 3 * run + 3), 0.3)
        self.assertGreater(12 * fit_forces(bad).outlying.min(), 0.05)
        robust = fit_forces(bad, is_robust=True)
        self.assertEqual(sorted(np.argsort(robust.outlying)[:3]), [4, 6, 9])
        self.assertLess(12 * robust.outlying.min(), 0.05)


if __name__ == "__main__":
    unittest.main()
