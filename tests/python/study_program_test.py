"""The study program as a user calls it: its files, its messages, its exit status."""

import json
import pathlib
import shutil
import unittest

from support import NO_STUDY, FolderTest, run_study

DATA = pathlib.Path(__file__).parents[1] / "data"
CASES = DATA / "milling_forces.json"


class ProgramTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def made(self, *words):
        """The output of a study that ends well, its files in self.out."""
        outcome = run_study(*words, "--out", self.out)
        self.assertEqual(outcome.returncode, 0, f"{words}: {outcome.stderr}")
        return outcome

    def json(self, name):
        return json.loads((self.out / name).read_text())

    def expect_charts(self, *names):
        for name in names:
            self.assertIn("</svg>", (self.out / f"{name}.svg").read_text(), name)

    def expect_refused(self, words, code, reason):
        """Exit status and one line on standard error."""
        outcome = run_study(*words)
        self.assertEqual(outcome.returncode, code, words)
        self.assertRegex(outcome.stderr, r"\Aosteomill_study: [^\n]*\n\Z")
        self.assertIn(reason, outcome.stderr, words)


class StudyProgramTest(ProgramTest):
    def test_runs_the_reference_cases_within_their_bars(self):
        outcome = self.made("force", "--cases", CASES)
        self.assertIn(f"{self.out}/cases.json", outcome.stdout)
        reports, cases = self.json("cases.json"), json.loads(CASES.read_text())
        self.assertEqual(len(reports), len(cases))
        for report, case in zip(reports, cases):
            name = case["name"]
            self.assertEqual(report["name"], name)
            self.assertEqual(report["file"]["mean_force_N"], case["mean_force_N"])
            # The bars of an upright 5 mm burr deeper than three voxels, and of any other motion.
            easy = (case["radius_mm"] == 2.5 and case["depth_mm"] > 0.3 and case["spindle_axis"][2] == 1.0 and
                    case["previous_groove_mm_higher"] is None and case["velocity_mm_s"][2] == 0)
            self.assertLess(report["error_percent"], 1.0 if easy else 2.0, name)
            self.assertLess(report["file_error_percent"], 1.0 if easy else 2.0, name)
            self.assertLess(report["removal_error_percent"], 2.0, name)
            self.assertGreaterEqual(report["step_us"]["p99"], report["step_us"]["p50"], name)
            self.assertGreater(report["step_us"]["p50"], 0.0, name)
            if easy:
                self.assertLess(report["ripple_percent"], 2.0, name)

    def test_cuts_as_it_is_told(self):
        one = self.folder / "one.json"
        one.write_text(json.dumps([json.loads(CASES.read_text())[2]]))
        self.made("force", "--cases", one, "--voxel-mm", "0.2", "--milling-rate-hz", "1000", "--travel-mm", "0.6")
        report = self.json("cases.json")[0]
        self.assertEqual((report["voxel_mm"], report["milling_rate_hz"], report["steps"]), (0.2, 1000.0, 100))
        self.assertAlmostEqual(report["travel_mm"], 0.6, delta=1e-9)

    def test_calibrates_bone_and_foam(self):
        self.made("calibrate", DATA / "calibration_runs.csv")
        # The coefficients that the table was made with.
        known = ((230.0, 40.0, 20.0, 0.5, 0.8, 0.1), (30.0, 8.0, 4.0, 0.05, 0.1, 0.02))
        found = self.json("calibration.json")
        self.assertEqual(len(found), 2)
        for material, values in zip(found, known):
            self.assertEqual(len(material["coefficients"]), 6)
            for coefficient, value in zip(material["coefficients"], values):
                self.assertAlmostEqual(coefficient["value"], value, delta=3.0 * coefficient["standard_uncertainty"], msg=coefficient)
        self.assertIn("edge_coefficients_n_per_mm = [", (self.out / "scene.toml").read_text())
        self.assertIn("\n48,foam,2,up,3,", (self.out / "residuals.csv").read_text())
        self.expect_charts("calibration_fit", "calibration_residuals")

    def test_chooses_runs_for_a_calibration_that_cannot_be_fitted_empty(self):
        outcome = self.made("calibrate", "--design", "--runs", "6", "--diameters-mm", "4", "--tilts-deg", "0,30", "--rpm", "20000")
        self.assertIn("one factor at a time:", outcome.stdout)
        self.expect_refused(["calibrate", self.out / "design.csv", "--out", self.out], 1,
                            "design.csv:2: force_feed_n is ''; it must be a number")
        self.expect_refused(["calibrate", "--out", self.out], 2, "a table of runs, or --design")
        self.expect_refused(["calibrate", "nowhere.csv", "--out", self.out], 1, "nowhere.csv: cannot be read")
        self.expect_refused(["calibrate", "nowhere.csv", "--seed", "2"], 2, "--design")

    def test_joins_the_bytes_of_one_process_from_parts(self):
        # Studies that measure no times.
        for number, study in enumerate((["stability", "--rails", "5", "--seed", "3"],
                                        ["stability", "--sites", "--quick", "--only", "plate of 1 mm"],
                                        ["calibrate", DATA / "calibration_runs.csv"], ["calibrate", "--design", "--runs", "6"])):
            whole, parts, joined = (self.folder / f"{name}{number}" for name in ("whole", "parts", "joined"))
            for words in ([*study, "--out", whole], *([*study, "--shard", part, "--out", parts] for part in ("1/2", "2/2")),
                          [study[0], "--merge", parts, "--out", joined]):
                outcome = run_study(*words)
                self.assertEqual(outcome.returncode, 0, f"{words}: {outcome.stderr}")
            files = list(whole.iterdir())
            self.assertTrue(files)
            for file in files:
                self.assertEqual((joined / file.name).read_bytes(), file.read_bytes(), f"{study}: {file}")

    def test_is_repeated_from_the_manifest_of_its_folder(self):
        self.made("stability", "--rails", "2", "--seed", "3")
        manifest = self.json("manifest.json")
        self.assertEqual(manifest["command"], ["stability", "--rails", "2", "--seed", "3"])
        self.assertEqual(manifest["settings"]["--seed"], "3")
        self.assertTrue(manifest["settings"]["--jobs"], "not given")
        repeated = run_study("repeat", self.out)
        self.assertEqual(repeated.returncode, 0, repeated.stdout + repeated.stderr)
        self.assertIn("columns are as they were", repeated.stdout)

        kept = self.json("rails.json")
        kept["implicit"]["cases"] = 3
        (self.out / "rails.json").write_text(json.dumps(kept))
        of_another = run_study("repeat", self.out)
        self.assertEqual(of_another.returncode, 1)
        self.assertIn("rails.json: /implicit/cases: cells that differ: 1, by up to 1; ", of_another.stdout)
        self.expect_refused(["repeat", self.folder / "nowhere"], 1, "manifest.json: cannot be read")
        for command in (["sessions", "/"], ["stability", "--quick", "sessions", "/"], ["stability", "--rails", "2", "--out=elsewhere"],
                        ["stability", "--rails", "2", "--quick", "bridge"],
                        ["stability", "--database", "postgresql://elsewhere/\x1b[2J"]):
            (self.out / "manifest.json").write_text(json.dumps(manifest | {"command": command}))
            self.expect_refused(["repeat", self.out], 1, NO_STUDY)
        self.expect_refused(["stability", "--rails", "2", "bridge"], 2, "bridge")

    def test_refuses_deep_json_of_a_folder_that_it_repeats(self):
        deep = "[" * 100_000 + "]" * 100_000
        self.out.mkdir()
        (self.out / "manifest.json").write_text(deep)
        self.expect_refused(["repeat", self.out], 1, "manifest.json: its lists and objects lie more than")
        (self.out / "manifest.json").write_text('{"command": ["stability", "--rails", "2"], "version": "0", "commit": "0"}')
        (self.out / "rails.json").write_text(deep)
        self.expect_refused(["repeat", self.out], 1, "rails.json: its lists and objects lie more than")

    def test_writes_over_no_file_that_it_reads(self):
        self.out.mkdir()
        cases = shutil.copy(CASES, self.out / "cases.json")
        self.expect_refused(["force", "--cases", cases, "--out", self.out], 2, "--out and --cases are the same")
        self.assertEqual(cases.read_text(), CASES.read_text())

    def test_says_in_one_line_what_is_wrong(self):
        bad, in_the_way = self.folder / "bad.json", self.folder / "file"
        bad.write_text('[{"name": "half a case"}]')
        in_the_way.write_text("in the way")
        for words, code, reason in (
            (["force", "--cases", "nowhere.json", "--out", self.out], 1, "nowhere.json: cannot be read"),
            (["force", "--cases", bad, "--out", self.out], 1, "case 1 'half a case': 'radius_mm' is missing"),
            (["force", "--cases", CASES, "--out", in_the_way / "out"], 1, "file/out: cannot be made a folder"),
            ([], 2, "a study to run: force, tradeoff, choose, stability, arms, polishing, render, realtime, bridge, states, calibrate, "
                    "sessions, assist or repeat"),
            (["farce"], 2, "farce"),
            (["realtime", "--quick", "--duration-s", "60"], 2, "--duration-s"),
            (["force", "--cases", CASES, "--voxel-mm", "0"], 2, "--voxel-mm"),
            (["force", "--case", "x.json"], 2, "--case"),
            (["stability", "--shard", "3/2"], 2, "'3/2' is no part I/N with 1 <= I <= N"),
            (["stability", "--methods", "hold,glue"], 2, "glue"),
            (["stability", "--delays", "7"], 2, "7"),
            (["stability", "--merge", "a", "--quick"], 2, "--merge"),
        ):
            self.expect_refused(words, code, reason)

    def test_has_help_and_a_version(self):
        help_text = run_study("force", "--help")
        self.assertEqual(help_text.returncode, 0)
        self.assertIn("--voxel-mm", help_text.stdout)
        self.assertIn("(0.1)", help_text.stdout)
        self.assertEqual(run_study("--version").returncode, 0)


if __name__ == "__main__":
    unittest.main()
