"""Tables of the study `force`, to the digit as they were in tests/data/force_study; times are not among them."""

import pathlib
import unittest

import pandas as pd

from osteomill.studies import force, force_curves, force_random
from osteomill.studies.tables import csv_of

GOLDEN = pathlib.Path(__file__).parents[1] / "data" / "force_study"


def random_table(**drawn):
    cases = force_random.cases_of({"seed": 1, "voxel_mm": 0.1, "depth_mm": None, "edge_forces": False, "heads": False} | drawn)
    outcomes = [force.measure(case) for case in cases]
    return force_random.table_of(cases, outcomes), outcomes


class GoldenTest(unittest.TestCase):
    maxDiff = None

    def expect(self, name, table):
        self.assertEqual(csv_of(table), (GOLDEN / f"{name}.csv").read_text(), name)

    def test_random_motions(self):
        for name, drawn in (("random", {"count": 12, "seed": 11}),
                            ("random_heads", {"count": 4, "seed": 31, "heads": True, "edge_forces": True}),
                            ("random_half_a_voxel", {"count": 4, "seed": 24, "edge_forces": True, "depth_mm": 0.05})):
            table, _ = random_table(**drawn)
            self.expect(name, table.drop(columns="step_us"))

    def test_curves(self):
        for name, varied in (("curve_depth", "depth_mm"), ("curve_feed", "feed_mm_per_s"), ("curve_rpm", "thousand_rpm")):
            cases = [case for case in force_curves.curve_cases(True) if case["varied"] == varied]
            self.expect(name, force_curves.curve_table(cases, [force.measure(case) for case in cases]))

    def test_contact_models(self):
        cases = force_curves.contact_cases(True)
        self.expect("contact", force_curves.contact_table(cases, [force.measure(case) for case in cases]))


class SummaryTest(unittest.TestCase):
    def test_has_the_keys_that_scripts_rely_on(self):
        table = pd.DataFrame({
            "name": [f"motion {i}" for i in range(100)],
            "error_percent": [0.01 * (i + 1) for i in range(100)],
            "ripple_percent": [0.1 * (i + 1) for i in range(100)],
            "dives": [i >= 50 for i in range(100)],
            "feed_mm_per_s": [5.0 if i < 10 else 4.9 for i in range(100)],
            "milling_rate_hz": 100.0, "largest_step": 1.0, "step_us": 1.0,
        })
        summary = force_random.summary_of({"seed": 1, "voxel_mm": 0.1, "edge_forces": False, "heads": False}, table,
                                          [{"deviations": [0.01]}] * 100)
        self.assertEqual(summary["cases"], 100)
        self.assertAlmostEqual(summary["median_error_percent"], 0.5, delta=0.011)
        self.assertAlmostEqual(summary["p95_error_percent"], 0.95, delta=0.011)
        self.assertAlmostEqual(summary["max_error_percent"], 1.0)
        self.assertAlmostEqual(summary["ripple_p90_percent"], 4.5, delta=0.11, msg="of the first fifty")
        self.assertAlmostEqual(summary["ripple_p90_from_5_mm_per_s_percent"], 0.91, delta=0.001, msg="of the first ten")
        self.assertAlmostEqual(summary["window_p95_percent"], 1.0)
        self.assertEqual(summary["largest_step_max"], 0.0, "none was at 1 kHz")
        self.assertEqual([row["name"] for row in summary["worst"]], [f"motion {i}" for i in range(99, 89, -1)])


class ChartTableTest(unittest.TestCase):
    def test_error_falls_with_the_size_of_voxels(self):
        cases = force_curves.convergence_cases(True)
        table = force_curves.convergence_table(cases, [force.measure(case) for case in cases])
        self.assertEqual(table["smoothed_error_percent"].tolist(), sorted(table["smoothed_error_percent"], reverse=True))
        self.assertGreater(table["smoothed_slope"].iloc[0], 0.5)
        self.assertTrue((table["there_or_gone_error_percent"] > 3.0 * table["smoothed_error_percent"]).all())

    def test_memory_follows_the_bone(self):
        cases = [case for case in force_curves.memory_cases(True) if case["of"] == "box"]
        table = force_curves.memory_table(cases, [force.measure(case) for case in cases])
        self.assertEqual(table["mebibytes"].nunique(), 1)
        self.assertGreater(table["box_mm3"].iloc[-1], 500 * table["box_mm3"].iloc[0])


if __name__ == "__main__":
    unittest.main()
