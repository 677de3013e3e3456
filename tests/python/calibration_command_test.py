"""The command osteomill_study calibrate: it still writes the files of its C++ version, and its statements about labs."""

import contextlib
import io
import json
import pathlib
import subprocess
import unittest

import numpy as np
import pandas as pd

from osteomill.studies.calibration.runs import FORCES
from osteomill.studies.program import main
from support import FolderTest, program
from synthetic_runs import KNOWN, exact_forces, measured, runs_of, twelve_settings

DATA = pathlib.Path(__file__).resolve().parents[1] / "data"
GOLDEN = DATA / "calibration_golden"
RUNS = DATA / "calibration_runs.csv"


def golden(name):
    return (GOLDEN / name).read_text(encoding="utf-8")


class CalibrationCommandTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def calibrate(self, *words, code=0):
        """In this process, which takes a second less than the program."""
        said, aside = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(aside):
            self.assertEqual(main(["calibrate", *map(str, words), "--jobs", "1", "--out", str(self.out)]), code, aside.getvalue())
        return aside.getvalue() if code else said.getvalue()

    def written(self, name):
        return (self.out / name).read_text(encoding="utf-8")

    def fitted(self, table, *options):
        file = self.out.parent / "lab.csv"
        table.drop(columns="time").to_csv(file, index=False)
        said = self.calibrate(file, *options)
        return said, json.loads(self.written("calibration.json"))[0]

    def test_fits_as_it_always_did(self):
        said = self.calibrate(RUNS)
        *numbers, where = said.splitlines(keepends=True)
        self.assertEqual("".join(numbers), golden("fit.txt"))
        self.assertIn(f"are in {self.out}", where)
        self.assertEqual(self.written("residuals.csv"), golden("residuals.csv"))
        self.assertEqual(self.written("scene.toml"), golden("scene.toml"))
        for found, kept in zip(json.loads(self.written("calibration.json")), json.loads(golden("calibration.json")), strict=True):
            self.assertEqual(found | {"drift": [], "distrusted_runs": []}, found)
            for key, value in kept.items():
                self.assert_equal_but_for_rounding(found[key], value)
        for chart in ("fit", "residuals"):
            self.assertIn("</svg>", self.written(f"calibration_{chart}.svg"))
        self.assertEqual(len(pd.read_csv(self.out / "runs.csv")), 48)

    def assert_equal_but_for_rounding(self, found, kept):
        """Linear algebra of another library differs in the last of sixteen digits."""
        if isinstance(kept, dict):
            self.assertEqual(list(found), list(kept))
            found, kept = list(found.values()), list(kept.values())
        if isinstance(kept, list):
            for one, other in zip(found, kept, strict=True):
                self.assert_equal_but_for_rounding(one, other)
        elif isinstance(kept, float):
            np.testing.assert_allclose(found, kept, rtol=1e-9, atol=1e-12)
        else:
            self.assertEqual(found, kept)

    def test_chooses_the_runs_that_it_always_chose(self):
        of_a_lab = ["--diameters-mm", "3,5", "--feeds-mm-per-s", "2,5,10", "--rpm", "15000,40000", "--depths-mm", "0.3,0.8",
                    "--tilts-deg", "0,20", "--edges", "6", "--material", "bovine cortical", "--runs", "24"]
        of_six = ["--runs", "6", "--diameters-mm", "4", "--tilts-deg", "0,30", "--rpm", "20000"]
        for words, name in (([], "design.txt"), (of_a_lab, "design_of_a_lab.txt"), (of_six, "design_of_six.txt")):
            with self.subTest(name):
                *said, where = self.calibrate("--design", *words).splitlines(keepends=True)
                self.assertEqual("".join(said), golden(name))
                self.assertTrue(golden(name).startswith(self.written("design.csv")))
                self.assertEqual(where, f"the table to fill in is {self.out}/design.csv\n")

    def test_says_in_one_line_what_is_wrong(self):
        self.calibrate("--design", "--runs", "6")
        for words, code, why in (
            ([self.out / "design.csv"], 1, "design.csv:2: force_feed_n is ''; it must be a number"),
            ([], 2, "a table of runs, or --design"),
            ([RUNS, "--design"], 2, "--design excludes data"),
            (["nowhere.csv"], 1, "nowhere.csv: cannot be read"),
            (["nowhere.csv", "--seed", "2"], 2, "--seed requires --design"),
            (["--design", "--robust"], 2, "--design excludes --robust"),
            (["--design", "--material", "a,b"], 2, "a name with a comma parts its column"),
            ([RUNS, "--drift", "curve"], 2, "'curve' is not one of none, slope, line"),
        ):
            with self.subTest(why):
                said = self.calibrate(*words, code=code)
                self.assertIn(why, said)
                self.assertEqual(said.count("\n"), 1)

    def test_names_the_material_that_cannot_be_fitted(self):
        table = runs_of(twelve_settings().assign(feed_mm_per_s=6.0)).drop(columns="time")
        file = self.out.parent / "one_feed.csv"
        table.to_csv(file, index=False)
        self.assertRegex(self.calibrate(file, code=1),
                         "^osteomill_study: case 'material bone': .*one_feed.csv: the feed of a tooth is .* in all runs")

    def lab(self, seed=7, noise=1.0, coefficients=KNOWN, spread_n=0.05):
        """A table as a lab fills it in."""
        exact = exact_forces(twelve_settings(), spread_n)
        forces = measured(exact, np.random.default_rng(seed), noise)
        force_n = forces.force_n + forces.regressors @ (np.asarray(coefficients) - KNOWN)
        return runs_of(twelve_settings(), spread_n).assign(**dict(zip(FORCES, force_n.reshape(-1, 3).T)))

    def test_gives_each_coefficient_with_its_interval(self):
        _, found = self.fitted(self.lab())
        k_t = found["coefficients"][0]
        self.assertEqual(k_t["name"], "K_t")
        self.assertTrue(k_t["interval_95"][0] < 230.0 < k_t["interval_95"][1])
        self.assertAlmostEqual(found["reduced_chi_squared"], 1.0, delta=0.6)
        self.assertEqual(found["leave_one_run_out"]["runs"], 12)
        self.assertEqual(found["warnings"], [])

    def test_warns_of_signs_that_are_wrong_and_of_scatter(self):
        for table, warning in (
            (self.lab(coefficients=[-230.0, *KNOWN[1:]]), "K_t is below 0 with its whole interval: check the signs"),
            (self.lab(noise=4.0), "scatter more than their spreads say"),
            (self.lab(noise=0.1, coefficients=[*KNOWN[:3], 0.0, 0.0, 0.0]), "K_te may be 0: its interval holds it"),
        ):
            said, found = self.fitted(table)
            self.assertIn("  note: ", said)
            self.assertTrue(any(warning in one for one in found["warnings"]), found["warnings"])

    def test_fits_a_drift_by_the_order_of_the_runs(self):
        order = np.random.default_rng(2).permutation(12)
        table = self.lab().assign(order=order + 1)
        for force, drift_n in zip(FORCES, (0.2, -0.2, 0.2)):
            table[force] += order / 11 * drift_n
        said, found = self.fitted(table, "--drift", "slope")
        self.assertRegex(said, r"(?m)^  drift_feed +0\.\d+ \+- 0\.\d+ +N$")
        self.assertEqual([one["name"] for one in found["drift"]], ["drift_feed", "drift_across", "drift_up"])
        for one, drift_n in zip(found["drift"], (0.2, -0.2, 0.2)):
            self.assertLess(abs(one["value"] - drift_n), 4.0 * one["standard_uncertainty"])
        self.assertGreater(found["probability"], 0.05)
        _, found = self.fitted(table)
        self.assertLess(found["probability"], 0.05)

    def test_names_runs_to_distrust(self):
        table = self.lab()
        table.loc[4, FORCES] *= 1.3  # it was cut too deep
        for options in ([], ["--robust"]):
            said, found = self.fitted(table, *options)
            self.assertEqual([one["run"] for one in found["distrusted_runs"]], ["5"])
            self.assertRegex(said, "(?m)^  note: run 5 is farther from what the others say than chance")
            runs = pd.read_csv(self.out / "runs.csv")
            self.assertEqual((runs.run[0], runs.is_distrusted.tolist()), (5, [1] + [0] * 11))
            self.assertEqual(runs.weight[0] < 0.5, bool(options))

    def test_writes_a_fragment_that_a_scene_takes(self):
        table = self.lab(noise=0.01, coefficients=[*KNOWN[:5], -0.3]).assign(material='bovine "cortical"')
        self.fitted(table)
        fragment = self.written("scene.toml")
        self.assertIn("K_ae is below 0, which a scene refuses: 0 here", fragment)
        self.assertIn("12 runs of lab.csv", fragment)
        self.assertRegex(fragment, r"edge_coefficients_n_per_mm = \[0\.\d+, 0\.\d+, 0\.00000\]")
        scene = self.out / "cube.toml"
        scene.write_text('name = "cube"\n[bone]\nphantom = "cube"\n' + fragment)
        checked = subprocess.run([program("haptic_server"), "--scene", scene, "--check"], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_draws_names_as_they_are(self):
        self.fitted(self.lab().assign(material="$x_1$ & co <1>"))
        self.assertIn("$x_1$ &amp; co &lt;1&gt;", self.written("calibration_fit.svg"))


if __name__ == "__main__":
    unittest.main()
