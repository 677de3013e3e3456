"""The table of runs of a calibration: its columns, and errors in one line."""

import unittest

import numpy as np

from support import FolderTest

from osteomill.studies.calibration.runs import read_runs, table_to_fill_in
from synthetic_runs import settings_of

HEADER = ("run,material,diameter_mm,edges,turns,rpm,feed_mm_per_s,depth_mm,tilt_deg,tilt_direction_deg,"
          "force_feed_n,force_across_n,force_up_n,spread_feed_n,spread_across_n,spread_up_n")
LINE = "a,bone,4,8,clockwise,20000,6,0.5,30,90,-1,2,3,0.1,0.2,0.3"


class CalibrationRunsTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "runs.csv"

    def read(self, text):
        self.file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_runs(self.file)

    def assert_refused(self, text, where, what):
        with self.assertRaises((ValueError, RuntimeError)) as refused:
            self.read(text)
        said = str(refused.exception)
        self.assertIn(f"runs.csv{where}: ", said)
        self.assertIn(what, said)
        self.assertNotIn("\n", said)

    def test_says_how_a_run_was_cut_and_what_was_felt(self):
        other = " b ; bone;4;8;counter-clockwise;20000;6;0.5;0;0;-1;2;3;1e-1;.2;0.3;0.25"
        runs = self.read("\ufeff# a lab\r\n" + HEADER + ",previous_groove_mm_higher\r\n\r\n" + LINE + ",\r\n" + other)
        self.assertEqual(runs.run.tolist(), ["a", "b"])
        self.assertEqual(runs.material.tolist(), ["bone", "bone"])
        self.assertEqual(runs.turns.tolist(), ["clockwise", "counter-clockwise"])
        self.assertEqual(runs.tilt_deg.tolist(), [30.0, 0.0])
        np.testing.assert_array_equal(runs.previous_groove_mm_higher, [np.nan, 0.25])
        self.assertEqual(runs.force_feed_n.tolist(), [-1.0, -1.0])
        self.assertEqual(runs.spread_across_n.tolist(), [0.2, 0.2])

    def test_knows_when_a_run_was_made(self):
        three = [LINE.replace("a,", f"{name},", 1) for name in "abc"]
        self.assertEqual(self.read("\n".join([HEADER, *three])).time.tolist(), [0.0, 0.5, 1.0])
        numbered = "\n".join([HEADER + ",order"] + [f"{line},{order}" for line, order in zip(three, (7, 2, 40))])
        self.assertEqual(self.read(numbered).time.tolist(), [0.5, 0.0, 1.0])
        self.assert_refused(numbered.replace(",40", ",7"), "", "two runs have the order 7; each must have its own")
        self.assert_refused(numbered.replace(",40", ","), ":4", "order is ''; it must be a number, in the order")

    def test_reads_what_it_asked_to_be_filled_in(self):
        table = table_to_fill_in(settings_of(depth_mm=[0.3, 0.5], diameter_mm=[4.0, 2.0], rpm=[20_000.0, 1234.5]), "enamel")
        self.assertEqual(table.splitlines()[2], "2,enamel,2,8,clockwise,1234.5,6,0.5,0,0,,,,,,")
        self.assert_refused(table, ":2", "force_feed_n is ''; it must be a number")
        runs = self.read(table.replace(",,,,,,", ",1,2,3,4,5,6"))
        self.assertEqual(runs.rpm.tolist(), [20_000.0, 1234.5])
        self.assertEqual(set(runs.material), {"enamel"})

    def test_refuses_what_is_wrong_in_one_line(self):
        whole = HEADER + "\n" + LINE + "\n"
        for text, where, what in (
            ("", "", "holds no run"),
            (HEADER + "\n", "", "holds no run"),
            (HEADER + ",colour\n" + LINE + ",red\n", ":1", "unknown column 'colour'"),
            (HEADER + ",rpm\n" + LINE + ",1\n", ":1", "column 'rpm' is there twice"),
            (HEADER[: HEADER.rindex(",")] + "\n", ":1", "column 'spread_up_n' is missing"),
            (whole + LINE[:20] + "\n", ":3", "values; there must be 16, one for each column"),
            (whole.replace("0.2,0.3", "0.2,0.3,9"), ":2", "17 values; there must be 16"),
            (whole.replace(",-1,", ",nan,"), ":2", "force_feed_n is 'nan'; it must be a number"),
            (whole.replace(",-1,", ",inf,"), ":2", "force_feed_n is 'inf'"),
            (whole.replace(",-1,", ",1.2.3,"), ":2", "force_feed_n is '1.2.3'"),
            (whole.replace(",-1,", ",1_2,"), ":2", "force_feed_n is '1_2'"),
            (whole.replace("0.2,0.3", "0,0.3"), ":2", "spread_across_n is '0'; it must be a number above 0"),
            (whole.replace("clockwise", "left"), ":2", "turns is 'left'; it must be clockwise or counter-clockwise"),
            (whole.replace(",0.5,", ",2.5,"), ":2", "depth_mm is '2.5'; it must be a number above 0, at most the burr's radius"),
            (whole.replace(",8,", ",8.5,"), ":2", "edges is '8.5'; it must be a whole number"),
            (whole.replace("bone", ""), ":2", "material is ''; it must be a text"),
            (whole.replace("bone", "bo\x1bne"), ":2", "it must be a text in UTF-8 without control characters"),
            (whole.replace("bone", "bön").encode("latin-1"), ":2", "it must be a text in UTF-8"),
            (whole + LINE + "\n", ":3", "run is 'a'; it must be a name that no other line has"),
            (whole.replace(",0.5,", ",0,5,").replace("a,", "a;", 1), ":2", "write 0.5, not 0,5"),
            (whole.encode("utf-16"), ":1", "is text in UTF-16"),
        ):
            with self.subTest(what):
                self.assert_refused(text, where, what)
        with self.assertRaisesRegex(RuntimeError, r"gone.csv: cannot be read: .*a table in CSV"):
            read_runs(self.file.with_name("gone.csv"))
        with self.assertRaisesRegex(RuntimeError, "it is a folder, a pipe or a device"):
            read_runs(self.file.parent)


if __name__ == "__main__":
    unittest.main()
