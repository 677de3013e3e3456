"""Kernels of milling, and the charts of speed against accuracy that are made of them. No time is asserted."""

import json
import math
import pathlib
import tempfile
import tomllib
import types
import unittest

import numpy as np

from osteomill import Burr, _studies
from osteomill.studies import tradeoff, tradeoff_coupling, tradeoff_force
from osteomill.studies.force_series import ForceSeries, relative_error
from osteomill.studies.study_run import StudyRun
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

    def test_front_holds_what_nothing_beats(self):
        self.assertEqual(tradeoff_force.on_front([1.0, 2.0, 3.0, 3.0], [5.0, 6.0, 1.0, 2.0]), [True, False, True, False])

    def test_quick_page_has_numbers_and_the_default_near_the_front(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            with open(out / "said", "w+") as said:
                tradeoff.run(types.SimpleNamespace(quick=True), StudyRun(out, ["tradeoff"], "", said=said, aside=said))
            found = json.loads((out / "tradeoff.json").read_text())
            page = (out / "tradeoff.svg").read_text()
        for row in found["force"]:
            for key in ("error_percent", "ripple_percent", "step_us", "published_us", "times_faster"):
                self.assertTrue(math.isfinite(row[key]) and row[key] > 0.0, (key, row))
        fresh = [row for row in found["force"] if row["varied"] == "voxels"]
        default = next(row for row in fresh if row["is_default"])
        # Near: nothing of its cost or less is more than twice as true. Times of choices beside it are of the same order
        # on a busy machine too; the published step takes many times as long.
        self.assertTrue(any(row["on_front"] for row in fresh))
        truest = min(row["error_percent"] for row in fresh)
        self.assertLessEqual(default["error_percent"], 2.0 * truest)
        self.assertGreater(default["times_faster"], 1.0)
        self.assertEqual([row["scene"] for row in found["needs"]], list(tradeoff_force.SCENES))
        self.assertTrue(all(row["is_held"] for row in found["needs"]))
        couplings = {row["method"]: row for row in found["coupling"]}
        self.assertEqual(set(couplings), set(tradeoff_coupling.QUICK_METHODS))
        for row in couplings.values():
            self.assertTrue(row["tick_us"] > 0.0 and row["rms_error_percent"] > 0.0, row)
        self.assertEqual(couplings["implicit"]["stable_percent"], 100.0)
        self.assertLess(couplings["hold"]["stable_percent"], 100.0)
        self.assertLess(couplings["implicit"]["rms_error_percent"], couplings["hold"]["rms_error_percent"])
        for words in ("time of a step (median), us", "error of the mean force, %", "the default, voxels of 0.1 mm"):
            self.assertIn(words, page)


if __name__ == "__main__":
    unittest.main()
