"""Kernels of milling, and the motions that they are tried on. No time is asserted."""

import json
import math
import pathlib
import tomllib
import unittest

import numpy as np

from osteomill import Burr, _studies
from osteomill.studies import tradeoff_force
from osteomill.studies.force_series import ForceSeries, relative_error
from osteomill.studies.studied_motions import error_and_ripple, studied_motions

TREE = pathlib.Path(__file__).parents[2]
CASES = TREE / "tests" / "data" / "milling_forces.json"


class KernelTest(unittest.TestCase):
    def test_agrees_with_forces_that_others_integrated(self):
        told = {case["name"]: case for case in json.loads(CASES.read_text())}
        motions = _studies.steady_cases(CASES)
        self.assertEqual([motion.name for motion in motions], list(told))
        for motion in motions:
            truth = told[motion.name]
            reference_n, removal = motion.reference()
            self.assertLess(relative_error(reference_n, truth["mean_force_N"]), 3e-3, motion.name)
            self.assertLess(relative_error(removal, truth["removal_mm3_s"]), 3e-3, motion.name)
            series = ForceSeries(*motion.run(_studies.Milling()))
            self.assertLess(relative_error(series.mean_force_n(), truth["mean_force_N"]), 0.02, motion.name)
            self.assertLess(relative_error(series.removal_mm3_per_s(), truth["removal_mm3_s"]), 0.02, motion.name)

    def test_a_full_scan_feels_what_the_crescent_feels(self):
        block = _studies.Block((-4, -3, -3), (4, 3, 0), 0.2)
        way = [(-1 + 0.05 * i, 0.03, 1.1) for i in range(30)]
        models = [_studies.Milling(summation="bins", coverage="binary", search=search) for search in ("crescent", "full_scan")]
        crescent, scan = _studies.run_path(models, block, Burr(diameter_mm=3.0), (0, 0, 1), 0.01, way)
        np.testing.assert_allclose(crescent[1], scan[1], atol=1e-6)
        np.testing.assert_allclose(crescent[2], scan[2], atol=1e-12)

    def test_refuses_what_is_no_way_to_mill(self):
        with self.assertRaisesRegex(ValueError, "coverage: 'blurred' is not one of binary, linear, smoothed"):
            _studies.Milling(coverage="blurred")
        with self.assertRaisesRegex(ValueError, "multiples of 16"):
            _studies.Block.cube(100, 0.1)

    def test_memory_follows_the_bone(self):
        alone, boxed, larger = (_studies.Block.cube(32, 0.1), _studies.Block.cube(32, 0.1, 128), _studies.Block.cube(64, 0.1))
        self.assertAlmostEqual(alone.bone_mm3, 3.2**3)
        self.assertEqual(alone.memory_bytes, boxed.memory_bytes)
        self.assertGreater(larger.memory_bytes, 7 * alone.memory_bytes)


class SeriesTest(unittest.TestCase):
    def test_ripple_is_of_whole_windows(self):
        pushes = np.array([[0.0, 0.0, 1.0 + 0.1 * (-1) ** (i // 10)] for i in range(45)])
        series = ForceSeries(0.001, pushes, np.ones(45), np.ones(45))
        mean = series.mean_force_n()[2]
        windows = [1.1, 0.9, 1.1, 0.9]
        self.assertAlmostEqual(series.ripple(), math.sqrt(sum((w / mean - 1.0) ** 2 for w in windows) / 4))
        self.assertAlmostEqual(series.largest_step(), 1.1 / mean)
        self.assertEqual(ForceSeries(0.001, np.zeros((3, 3)), np.zeros(3), np.zeros(3)).ripple(), 0.0)


class TradeoffTest(unittest.TestCase):
    def test_finer_voxels_are_truer_and_the_published_ones_are_not_as_true(self):
        motions = studied_motions(1.2)
        errors = {}
        for name, model in (("default", _studies.Milling()), ("published", _studies.Milling(**tradeoff_force.PUBLISHED))):
            errors[name], ripple = error_and_ripple(motions, model, voxel_mm=0.2)
            self.assertGreater(ripple, 0.0)
        self.assertLess(errors["default"], 0.01)
        self.assertGreater(errors["published"], 3.0 * errors["default"])

    def test_knows_what_the_built_in_scenes_start_with(self):
        for scene, (burr_mm, rpm, has_edges) in tradeoff_force.SCENES.items():
            told = tomllib.loads((TREE / "scenes" / f"{scene}.toml").read_text())
            burrs = {burr["name"]: burr for burr in told["burrs"]}
            first = burrs[told["start_burr"]]
            self.assertEqual((first["diameter_mm"], first["rpm"]), (burr_mm, rpm), scene)
            self.assertEqual(any(first.get("edge_coefficients_n_per_mm", (0.0,))), has_edges, scene)


if __name__ == "__main__":
    unittest.main()
