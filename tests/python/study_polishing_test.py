"""The study `polishing`: its tables as they were in tests/data/polishing_study, and the measures of a force."""

import json
import unittest

import numpy as np
import pandas as pd
from study_files import DATA, run_of

from osteomill.studies import polishing, polishing_claims
from osteomill.studies.tables import csv_of

KEPT = DATA / "polishing_study"


class GoldenTest(unittest.TestCase):
    maxDiff = None

    def test_slides_as_it_did(self):
        with run_of("polishing", polishing, "--quick") as (out, said):
            for name in ("figures", "as_meant", "milling_implicit"):
                self.assertEqual((out / f"{name}.csv").read_text(), (KEPT / f"{name}.csv").read_text(), name)
            self.assertIn("\nmilling,interpolate,100,1,", said)
            for chart in ("depth", "milling", "point_spring"):
                self.assertIn("</svg>", (out / f"polishing_{chart}.svg").read_text())
            self.assertTrue((out / "runs" / "point-spring_interpolate.csv").exists())

    def test_slides_with_edges_as_it_did(self):
        kept = pd.read_csv(KEPT / "figures_edges.csv")
        with run_of("polishing", polishing, "--quick", "--edge-forces") as (out, _):
            pd.testing.assert_frame_equal(pd.read_csv(out / "figures.csv"), kept)


def sine(hz, t_s):
    return np.sin(2.0 * np.pi * hz * t_s)


class ForceMeasuresTest(unittest.TestCase):
    t_s = np.arange(4000) * 0.001
    depth_mm = 0.5 * t_s

    def windows(self, x, y, z):
        force_n = np.column_stack([np.broadcast_to(part, self.t_s.shape) for part in (x, y, z)])
        return polishing.windows_of(self.t_s, self.depth_mm, force_n, 0.1)

    def test_tell_a_limit_cycle_from_a_slow_force(self):
        windows = self.windows(0.3 * sine(20.0, self.t_s), 2.0 + self.t_s, sine(0.2, self.t_s))
        self.assertEqual(len(windows), 40)
        # 20 Hz has whole periods in the slow part's tenth of a second: none of it is left there.
        self.assertAlmostEqual(polishing.limit_cycle_n(windows), 0.3 / np.sqrt(2.0), delta=0.005)
        self.assertAlmostEqual(windows["depth_mm"][20], 0.5 * 2.0495, msg="its middle")

    def test_say_where_chatter_begins(self):
        def onset(begin_s, end_s):
            chatters = (self.t_s >= begin_s) & (self.t_s < end_s)
            return polishing.onset_of_chatter_mm(self.windows(1.0, 0.0, np.where(chatters, 0.5 * sine(30.0, self.t_s), 0.0)))

        self.assertAlmostEqual(onset(2.0, 4.0), 1.0, delta=0.03)
        self.assertIsNone(onset(2.0, 2.1), "one window is a stroke that turns round")
        self.assertIsNone(onset(5.0, 6.0))

    def test_leave_out_a_tenth_of_the_windows_where_force_rightly_changes_fast(self):
        fast = np.full(100, 0.05)
        fast[:90:10] = 1.0
        windows = pd.DataFrame({"depth_mm": 0.0, "fast_rms_n": fast})
        self.assertEqual(polishing.limit_cycle_n(windows), 0.05)
        windows.loc[5:94:10, "fast_rms_n"] = 1.0
        self.assertEqual(polishing.limit_cycle_n(windows), 1.0)
        self.assertEqual(polishing.limit_cycle_n(windows[:0]), 0.0)

    def test_of_a_hand_that_met_no_bone_are_none(self):
        record = {"reached_end": False, "faults": 1, "t_s": [], "depth_mm": [], "force_n": [], "largest_depth_mm": 0.0, "stray_mm": 0.0}
        [setup, *_] = polishing.cases(True, False)
        self.assertEqual(csv_of(polishing.table_of([setup], [record])).splitlines()[1], "milling,interpolate,100,0,0,0,0,0,0,,1")
        self.assertEqual(len(polishing.series_of(json.loads(json.dumps(record)))), 0)

class ClaimsTest(unittest.TestCase):
    def test_components_on_one_line_are_proportional(self):
        pull = np.sin(np.arange(1000) * 0.1)
        self.assertAlmostEqual(polishing_claims.share_off_line(np.outer(pull, (3.0, 0.2, 1.0))), 0.0)
        apart = np.eye(3)[np.arange(999) % 3]
        self.assertAlmostEqual(polishing_claims.share_off_line(apart), 2.0 / 3.0)
        self.assertEqual(polishing_claims.share_off_line(np.zeros((4, 3))), 0.0)

    def test_ranks_tell_what_rises(self):
        depths = np.arange(20.0)
        self.assertAlmostEqual(polishing_claims.rank_correlation(depths, depths**3), 1.0)
        self.assertAlmostEqual(polishing_claims.rank_correlation(depths, -depths), -1.0)
        self.assertEqual(polishing_claims.rank_correlation(depths, np.ones(20)), 0.0)

    def test_the_mean_force_does_not_know_the_number_of_edges(self):
        one, four = (polishing_claims.measure_edges(edges, (0.0, 0.0, 0.0)) for edges in (1, 4))
        self.assertAlmostEqual(four["mean_n"] / one["mean_n"], 1.0, delta=0.05)
        self.assertAlmostEqual(four["one_tooth_n"], four["mean_n"] / 4)
        self.assertLess(four["peak_n"], 0.8 * one["peak_n"])

    def test_a_claim_is_decided_by_its_number(self):
        t_s = np.arange(4000) * 0.001
        record = {"t_s": t_s, "depth_mm": t_s, "force_n": np.column_stack([t_s, 0.1 * t_s, 1.0 - 0.2 * t_s])}
        edges = pd.DataFrame({"edges": [1, 12], "mean_n": [9.4, 9.5], "one_tooth_n": [9.4, 0.8], "peak_n": [25.0, 11.0]})
        claims = polishing_claims.claims_of({"milling, on rails": record, "rpm over: 10000": record},
                                            {"milling, interpolate": 0.24, "milling, implicit": 0.19}, edges, 0.2)
        self.assertEqual(claims["holds"].tolist(), [True, True, False, True, True, True, False, True, True, False])
        self.assertEqual(claims["where"].tolist()[-1], "milling, on rails, 80000 rpm over 10000")


if __name__ == "__main__":
    unittest.main()
