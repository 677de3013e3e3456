"""Which runs a lab should make: the D-optimal design, and the obvious choice beside it."""

import itertools
import unittest

import numpy as np

from osteomill.studies.calibration import design
from osteomill.studies.calibration.design import Lattice, candidates_of, one_factor_at_a_time, optimal_design
from osteomill.studies.calibration.fit import LARGEST_CONDITION, fit_forces
from osteomill.studies.calibration.forces import regressors_of
from synthetic_runs import exact_forces

SMALL = Lattice(diameters_mm=(1.0, 4.0), feeds_mm_per_s=(1.0, 10.0), rpm=(20_000.0,), depths_mm=(0.4, 1.0),
                tilts_deg=(0.0, 30.0), tilt_directions_deg=(0.0, 90.0, 180.0))


class CalibrationDesignTest(unittest.TestCase):
    def test_candidates_are_what_a_lab_can_cut(self):
        settings, regressors = candidates_of(SMALL)
        # No slot of 1 mm by the 1 mm burr; an upright burr leans nowhere.
        self.assertEqual(len(settings), (1 + 2) * 2 * 4)
        self.assertTrue((settings.depth_mm <= 0.5 * settings.diameter_mm).all())
        for setting, of_candidate in zip(settings.itertuples(), regressors):
            np.testing.assert_allclose(of_candidate, regressors_of(setting), rtol=0, atol=1e-9)

    def test_is_the_best_of_all_where_all_can_be_tried(self):
        settings, regressors = candidates_of(SMALL)
        found = optimal_design(settings[:12], regressors[:12], 4, seed=1)
        best = max(np.linalg.det(np.einsum("rax,ray->xy", regressors[list(four)], regressors[list(four)]))
                   for four in itertools.combinations(range(12), 4))
        self.assertAlmostEqual(found.determinant / best, 1.0, places=6)

    def test_tells_more_than_one_factor_at_a_time(self):
        lattice = Lattice(diameters_mm=(4.0,), rpm=(20_000.0,), tilts_deg=(0.0, 30.0), tilt_directions_deg=(0.0, 180.0))
        best, obvious = optimal_design(*candidates_of(lattice), 12, seed=1), one_factor_at_a_time(lattice, 12)
        self.assertEqual((len(best.settings), len(obvious.settings)), (12, 12))
        self.assertLess(best.condition, LARGEST_CONDITION)
        self.assertGreater(design.efficiency(best, obvious), 2.0)

    def test_promises_the_uncertainty_that_a_fit_then_has(self):
        best = optimal_design(*candidates_of(SMALL), 12, seed=1)
        np.testing.assert_allclose(fit_forces(exact_forces(best.settings, 0.05)).uncertainty, 0.05 * best.uncertainty, rtol=1e-6)

    def test_is_the_same_for_every_seed_that_finds_it(self):
        tables = [optimal_design(*candidates_of(SMALL), 8, seed).settings for seed in (1, 2, 3)]
        self.assertTrue(tables[0].equals(tables[1]) and tables[0].equals(tables[2]))

    def test_is_refused_where_the_lists_cannot_give_it(self):
        one_feed = candidates_of(Lattice(**{**vars(SMALL), "feeds_mm_per_s": (5.0, 6.0)}))
        for candidates, runs, why in (
            (candidates_of(SMALL), 25, "the lists make 24 settings"),
            (one_feed, 12, "the feed of a tooth is"),
            (one_feed, 2, "at least 3"),
        ):
            with self.assertRaisesRegex(ValueError, why):
                optimal_design(*candidates, runs, seed=1)


if __name__ == "__main__":
    unittest.main()
