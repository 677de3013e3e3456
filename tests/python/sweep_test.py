"""A sweep of cases from Python: in one process, in parts, killed, joined; and the same under Dask and Slurm."""

import contextlib
import importlib.util
import io
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import unittest

import numpy as np

from support import FolderTest

from osteomill.part_files import Part
from osteomill.sweep import sweep

CASES = [{"feed_mm_per_s": feed, "depth_mm": depth} for feed in (0.3, 1.0, 7.0) for depth in (0.1, 1.0)]


def force(case):
    """Not bone's, but of both numbers, and not finite for one."""
    n = np.sqrt(case["feed_mm_per_s"]) / (case["depth_mm"] - 1.0 or np.nan)
    return {"force_n": np.array([n, n / 3.0]), "steps": np.int64(7), "name": f"{case['depth_mm']} mm"}


def force_in_thirds(case):
    """Kills its process at the third case, once."""
    once = pathlib.Path(os.environ["OSTEOMILL_TEST_ONCE"])
    if case == CASES[2] and not once.exists():
        once.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return force(case)


DOCUMENT = pathlib.Path(__file__).resolve().parents[2] / "docs" / "cluster.md"


def scripts_of_document():
    """The page's scripts, by the name in their first line."""
    blocks = re.findall(r"```python\n# (\w+\.py)\n(.*?)```", DOCUMENT.read_text(encoding="utf-8"), re.DOTALL)
    return dict(blocks)


class SweepTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.parts = self.folder / "parts"

    def part(self, shard, function=force):
        with self.assertRaises(SystemExit) as end, contextlib.redirect_stdout(io.StringIO()):
            sweep(function, CASES, jobs=1, shard=shard, out=self.parts)
        self.assertEqual(end.exception.code, 0)

    def refusal(self, **options):
        with self.assertRaises(ValueError) as refused:
            sweep(force, CASES, **options)
        self.assertNotIn("\n", str(refused.exception))
        return str(refused.exception)

    def test_gives_what_a_loop_gives(self):
        found = sweep(force, CASES, jobs=2)
        self.assertEqual(len(found), 6)
        for case, outcome in zip(CASES, found):
            np.testing.assert_array_equal(outcome["force_n"], force(case)["force_n"])
            self.assertEqual((outcome["steps"], outcome["name"]), (7, f"{case['depth_mm']} mm"))

    def test_parts_join_to_the_same(self):
        for shard in ("1/3", "2/3", "3/3"):
            self.part(shard)
        whole = json.dumps(sweep(force, CASES, jobs=1))
        self.assertEqual(json.dumps(sweep(force, CASES, merge=self.parts)), whole)

    def test_a_part_goes_on_where_it_was(self):
        self.part("1/2")
        file = self.parts / "sweep-1-of-2.jsonl"
        whole = file.read_text()
        file.write_text(whole[: whole.index("\n", whole.index("\n") + 1) + 9])  # its second case is torn
        kept = file.read_text().splitlines()[1]
        self.part("1/2")
        self.assertIn(kept, file.read_text())
        self.assertEqual(sorted(file.read_text().splitlines()), sorted(whole.splitlines()))

    def test_refuses_parts_that_do_not_fit(self):
        self.assertIn("holds no sweep-", self.refusal(merge=self.folder))
        self.part("1/2")
        self.assertEqual(self.refusal(merge=self.parts), "missing of 2 parts: 2")
        self.part("2/2")
        file = self.parts / "sweep-2-of-2.jsonl"
        text = file.read_text()
        copy = self.parts / "again" / "sweep-2-of-2.jsonl"
        copy.parent.mkdir()
        copy.write_text(text)
        self.assertIn("part 2 is there twice: in ", self.refusal(merge=self.parts))
        copy.unlink()
        file.write_text("".join(text.splitlines(True)[:-1]))
        self.assertIn("has done 2 of its 3 cases: run part 2/2 again", self.refusal(merge=self.parts))
        with self.assertRaisesRegex(ValueError, "cases of another sweep"):
            sweep(force, CASES[:4], merge=self.parts)
        with self.assertRaisesRegex(ValueError, "'3/2' is no part"):
            sweep(force, CASES, shard="3/2")
        with self.assertRaisesRegex(ValueError, "a case is there twice"):
            sweep(force, CASES + CASES[:1])

    def test_parts_are_alike(self):
        keys = [str(i) for i in range(100)]
        parts = [Part(number, 3).cases(keys) for number in (1, 2, 3)]
        self.assertEqual(sorted(sum(parts, [])), list(range(100)))
        self.assertEqual([len(part) for part in parts], [34, 33, 33])

    def run_script(self, name, **environment):
        for script, text in scripts_of_document().items():
            (self.folder / script).write_text(text)
        done = subprocess.run([sys.executable, name], cwd=self.folder, env=os.environ | environment, check=True,
                              capture_output=True, text=True)
        return done.stdout

    def test_the_documents_script_needs_no_change_for_an_array(self):
        whole = self.run_script("peaks.py")
        self.assertEqual(len(json.loads(whole)), 3)
        self.assertGreater(min(json.loads(whole)), 0.1, "it measures a force")
        for shard in ("1/2", "2/2"):
            said = self.run_script("peaks.py", OSTEOMILL_SHARD=shard, OSTEOMILL_OUT=str(self.parts))
            self.assertTrue(said.startswith(f"part {shard[0]} of 2 is in "), said)
        self.assertEqual(self.run_script("peaks.py", OSTEOMILL_MERGE=str(self.parts)), whole)
        if importlib.util.find_spec("distributed"):
            self.assertEqual(self.run_script("peaks_by_dask.py"), whole)

    def test_dasks_map_outlives_a_worker(self):
        try:
            from dask.distributed import Client, LocalCluster
        except ImportError:
            self.skipTest("python3-distributed is not installed")
        os.environ["OSTEOMILL_TEST_ONCE"] = str(self.folder / "killed")
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
            found = client.gather(client.map(force_in_thirds, CASES))
        self.assertTrue((self.folder / "killed").exists())
        for outcome, case in zip(found, CASES):
            np.testing.assert_array_equal(outcome["force_n"], force(case)["force_n"])


if __name__ == "__main__":
    unittest.main()
