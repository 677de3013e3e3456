"""Whole studies by the program, quickly, and heads of burrs in the claims about the force."""

import csv
import unittest

from force_claims_test import ForceClaims
from study_program_test import ProgramTest
from support import run_study


class WholeStudiesTest(ProgramTest):
    def draws(self, *words):
        """The output of a study that draws; the test is skipped without OpenGL."""
        outcome = run_study(*words, "--out", self.out)
        if "OpenGL" in outcome.stderr:
            self.skipTest(f"needs OpenGL without a display: {outcome.stderr}")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return outcome

    def test_draws_its_charts_quickly(self):
        outcome = self.made("force", "--quick")
        self.assertIn(str(self.out), outcome.stdout, "says where the files are")
        self.assertIn("cases 100 %\n", outcome.stderr)
        self.assertLess(self.json("force.json")["random"]["median_error_percent"], 1.0)
        self.expect_charts("curves", "contact")

    def test_polishes_quickly(self):
        outcome = self.made("polishing", "--quick")
        self.assertIn(str(self.out), outcome.stdout, "says where the files are")
        self.assertIn("cases 100 %\n", outcome.stderr)
        with (self.out / "figures.csv").open() as table:
            rows = {tuple(row[:3]): [float(cell or 0) for cell in row[3:]] for row in csv.reader(table)
                    if row[:2] in (["milling", "implicit"], ["milling", "interpolate"])}
        # Reached the end; slide, s; depth, stray, mm; mean force, limit cycle, N; depth at which it begins, mm; faults.
        reached, slide_s, depth_mm, _, _, cycle_n, _, faults = rows["milling", "implicit", "1000"]
        self.assertEqual(reached, 1.0)
        self.assertAlmostEqual(slide_s, 7.6, delta=0.5)
        self.assertAlmostEqual(depth_mm, 3.5, delta=0.1)
        self.assertLess(cycle_n, 0.2, "steady")
        self.assertEqual(faults, 0.0)
        published = rows["milling", "interpolate", "100"]
        self.assertEqual(len(published), 8)
        self.assertGreater(published[5], 0.2, "chatters")
        self.expect_charts("polishing_depth", "polishing_milling", "polishing_point_spring")

    def test_draws_and_measures_pictures_quickly(self):
        outcome = self.draws("render", "--quick")
        found = self.json("render.json")
        self.assertIn(found["gl_renderer"], outcome.stdout)
        for point in found["accuracy"]:
            self.assertGreater(point["frame_ms"], 0.0)
        [default] = [point for point in found["accuracy"] if point["is_default"]]
        self.assertGreaterEqual(default["psnr_db"], 40.0)
        self.expect_charts("render_accuracy")

    def test_measures_the_full_rate_of_what_draws(self):
        outcome = self.draws("render", "--full-rate", "--frames", "1", "--size-px", "160x90")
        found = self.json("full_rate.json")
        self.assertEqual("no GPU: a software rasteriser draws" in outcome.stdout, found["is_software_renderer"])
        self.assertEqual(len(found["rows"]), 8, "two bones: orbit, carve, two ways of stereo")
        for row in found["rows"]:
            self.assertGreater(row["p99_ms"], 0.0, row)
            self.assertEqual(row["gl_renderer"], found["gl_renderer"])
        head = found["bones"]["head"]
        self.assertEqual(head["times_coarser"], 1, "the bone itself")
        self.assertLessEqual(head["texture_bytes"], 629 << 20, "what a graphics card has to have for a whole head")
        self.expect_charts("render_full_rate")
        self.expect_refused(["render", "--gpu", "63", "--full-rate", "--out", self.out], 1, "GPU 63: EGL lists ")
        self.expect_refused(["render", "--full-rate", "--size-px", "wide", "--out", self.out], 2, "'wide', not WIDTHxHEIGHT")
        self.expect_refused(["render", "--size-px", "160x90", "--out", self.out], 2, "--full-rate")


class ForceClaimsOfHeads(ForceClaims):
    def test_hold_where_edges_rub(self):
        self.expect(60, "--seed", "20261125", "--heads", "--edge-forces", median_error_percent=2.0, window_p95_percent=10.0)

    def test_hold_for_chips(self):
        self.expect(150, "--seed", "20261124", "--heads", median_error_percent=0.3, p95_error_percent=2.0)


if __name__ == "__main__":
    unittest.main()
