"""A run of a study: its cases in one process, in several, in parts, killed, joined; the files that it leaves."""

import io
import json
import math
import os
import unittest

import numpy as np
import pandas as pd

from support import FolderTest

from osteomill.part_files import JoinedParts, Part, part_named
from osteomill.studies import charts
from osteomill.studies.progress import ProgressLine, time_left
from osteomill.studies.study_run import PartIsDone, StudyRun

CASES = [{"feed_mm_per_s": feed} for feed in (0.5, 1.0, 2.0, 4.0, 8.0)]


def force(case):
    """Counts in a file how often it is called; not finite for one."""
    with open(os.environ["OSTEOMILL_TEST_CALLS"], "a", encoding="utf-8") as calls:
        calls.write("x")
    return {"force_n": np.array([1.0 / 3.0 * case["feed_mm_per_s"]]), "ripple": math.nan if case == CASES[1] else 1}


def fails_at_two(case):
    if case["feed_mm_per_s"] == 2.0:
        raise ValueError("no bone\nat all")
    return 1


def is_killed(case):
    os.kill(os.getpid(), 9)


class StudyRunTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.calls = self.folder / "calls"
        os.environ["OSTEOMILL_TEST_CALLS"] = str(self.calls)

    def study(self, out="out", command=("force", "--quick"), program="build 1", **settings):
        self.said, self.aside = io.StringIO(), io.StringIO()
        return StudyRun(self.folder / out, list(command), program, said=self.said, aside=self.aside, **settings)

    def whole(self):
        return self.study("whole").sweep(force, CASES)

    def part(self, shard, out="parts"):
        with self.assertRaises(PartIsDone):
            self.study(out, part=part_named(shard)).sweep(force, CASES)

    def refusal(self, work):
        with self.assertRaises((ValueError, RuntimeError)) as refused:
            work()
        self.assertNotIn("\n", str(refused.exception))
        return str(refused.exception)

    def joined(self):
        return JoinedParts(sorted((self.folder / "parts").glob("*.jsonl")))

    def test_gives_what_a_loop_gives_in_any_way(self):
        text = json.dumps([{"force_n": [1.0 / 3.0 * case["feed_mm_per_s"]], "ripple": math.nan if case == CASES[1] else 1}
                           for case in CASES])
        self.assertEqual(json.dumps(self.whole()), text)
        self.assertEqual(json.dumps(self.study("by two", jobs=2).sweep(force, CASES)), text)
        for shard in ("1/2", "2/2"):
            self.part(shard)
        self.assertIn("part 2 of 2 is in ", self.said.getvalue())
        self.assertEqual(json.dumps(self.study(joined=self.joined()).sweep(force, CASES)), text)

    def test_goes_on_where_it_was_and_leaves_nothing_when_it_is_done(self):
        run = self.study()
        run.sweep(force, CASES)
        file = self.folder / "out" / "cases-1-of-1.jsonl"
        lines = file.read_text().splitlines(True)
        file.write_text("".join(lines[:3]) + lines[3][:9])  # the third case is torn
        self.calls.write_text("")
        again = self.study()
        again.sweep(force, CASES)
        self.assertEqual(self.calls.read_text(), "xxx")
        self.assertIn("2 of 5 cases are done in ", self.said.getvalue())
        self.assertIn("cases 100 %\n", self.aside.getvalue())
        self.assertEqual(sorted(file.read_text().splitlines()), sorted("".join(lines).splitlines()))
        again.forget_outcomes()
        self.assertFalse(file.exists())

    def test_does_not_go_on_with_what_is_of_another_build_or_list(self):
        self.whole()
        self.assertIn("holds cases of another build", self.refusal(lambda: self.study("whole", program="2").sweep(force, CASES)))
        self.assertIn("holds cases of another sweep", self.refusal(lambda: self.study("whole").sweep(force, CASES[:2])))
        self.assertIn("holds cases of another sweep", self.refusal(lambda: self.study("whole", ["force"]).sweep(force, CASES)))

    def test_says_which_case_fails(self):
        for jobs in (1, 2):
            run = self.study(jobs=jobs)
            line = self.refusal(lambda: run.sweep(fails_at_two, CASES, name=lambda case: f"feed {case['feed_mm_per_s']:g}"))
            self.assertEqual(line, "case 'feed 2': no bone at all")
        self.assertIn("a process ended", str(self.refused_os_error(lambda: self.study("killed", jobs=2).sweep(is_killed, CASES))))

    def refused_os_error(self, work):
        with self.assertRaises(OSError) as refused:
            work()
        return refused.exception

    def test_takes_no_hostile_part(self):
        self.part("1/2")
        self.part("2/2")
        file = self.folder / "parts" / "cases-2-of-2.jsonl"
        header, case, *_ = file.read_text().splitlines(True)
        deep = "[" * 100_000 + "]" * 100_000
        for text, why in (
            ("", "first line says of no cases"),
            ("{}\n", "first line says of no cases"),
            (deep + "\n", "first line says of no cases"),
            ("[1]\n", "first line says of no cases"),
            (header.replace('"of": 2', '"of": 1e999'), "first line says of no cases"),
            (header.replace('"of": 2', '"of": 1'), "first line says of no cases"),
            (header.replace('"shard": 2', '"shard": true'), "first line says of no cases"),
            (header + "nonsense\n", "line 2: is no case"),
            (header + '{"case": -1, "outcome": 1}\n', "line 2: is no case"),
            (header + '{"case": 1, "outcome": ' + deep + "}\n", "line 2: its lists and objects lie too deep"),
            (header + '{"case": ' + "9" * 5000 + ', "outcome": 1}\n', "line 2: is no case"),
            (header + case + case, "is there twice"),
            (header + case + "\n", "line 3: is no case"),
            (header, "has done 0 of its 2 cases"),
            (header.replace('"of": 2', '"of": 99999999999999'), "others are of another number"),
        ):
            file.write_text(text)
            self.assertIn(why, self.refusal(lambda: self.study(joined=self.joined()).sweep(force, CASES)), text[:80])
        file.write_bytes(header.encode() + b'"\xe4"\n')
        self.assertIn("no text in UTF-8", self.refusal(self.joined))
        file.unlink()
        os.mkfifo(file)
        self.assertIn("cannot be read", self.refusal(self.joined))
        self.assertIn("cannot be ", self.refusal(lambda: self.study("parts", part=Part(2, 2)).sweep(force, CASES)))

    def test_writes_tables_as_documented(self):
        run = self.study()
        frame = pd.DataFrame({"name": ["a,b", "=1", None], "n": [1, 2, 3], "value": [1.0 / 3.0, 1e-9, math.nan],
                              "holds": [True, False, True], "mixed": [np.int64(-4), None, 2.5]})
        run.table("table", frame)
        self.assertEqual((run.out / "table.csv").read_text(),
                         'name,n,value,holds,mixed\n"a,b",1,0.333333,1,-4\n"\'=1",2,1e-09,0,\n,3,,1,2.5\n')
        run.json("found", {"a": np.float64(0.1), "b": [math.inf, (1, "ö")], "c": np.arange(2)})
        self.assertEqual((run.out / "found.json").read_text(encoding="utf-8"),
                         '{\n "a": 0.1,\n "b": [\n  null,\n  [\n   1,\n   "ö"\n  ]\n ],\n "c": [\n  0,\n  1\n ]\n}\n')

    def test_replaces_a_link_of_its_files_and_not_what_it_leads_to(self):
        run = self.study()
        precious = self.folder / "precious"
        precious.write_text("mine")
        run.file("found.json").symlink_to(precious)
        run.json("found", 1)
        self.assertEqual(precious.read_text(), "mine")
        (self.folder / "file").write_text("in the way")
        self.assertIn("file/out: cannot be made a folder", self.refusal(lambda: self.study("file/out").json("found", 1)))

    def test_draws_the_same_bytes_twice(self):
        def drawn():
            figure = charts.figure()
            axes = figure.subplots()
            axes.plot([1, 2], [3, 4], label="a line")
            axes.fill_between([1, 2], [2, 3], [4, 5], alpha=0.3)
            axes.legend()
            return charts.svg_of(figure)

        self.assertEqual(drawn(), drawn())
        self.assertIn(">a line</text>", drawn())
        self.assertIn("#0072b2", drawn())

    def test_says_how_much_time_is_left(self):
        now_s = 0.0
        out = io.StringIO()
        line = ProgressLine(out, "cases", lambda: now_s)
        for done in (0.0, 0.05, 0.1, 0.11, 0.5, 1.0):
            line.report(done)
            now_s += 3.0
        line.end()
        self.assertEqual(out.getvalue(), "cases 10 %, 54 s left\ncases 50 %, 12 s left\ncases 100 %\n")
        self.assertEqual([time_left(s) for s in (0.0, 99.5, 101.0, 7501.0)], ["", "2 min left", "2 min left", "2 h 6 min left"])


if __name__ == "__main__":
    unittest.main()
