"""A study as a job array under a real Slurm: a task killed and submitted again, the parts joined."""

import pathlib
import shutil
import unittest

import slurm_cluster
from support import FolderTest, eventually, program, run_study

ARRAY = pathlib.Path(__file__).parents[2] / "scripts" / "array.sbatch"
#: A corner of the map: nine cases of a twentieth of a second.
STUDY = ["stability", "--quick", "--methods", "interpolate", "--grips", "firm", "--milling-rates-hz", "1000", "--delays", "0"]


@unittest.skipIf(slurm_cluster.why_not(), slurm_cluster.why_not())
class ArrayJobTest(FolderTest):
    def study_that_stops_in_task_2(self):
        """The study, except in task 2: there a limit of its files kills it in the middle of a line, after its first case, and then the
        task sleeps until it is killed, too."""
        study, script = program("osteomill_study"), self.folder / "study.sh"
        script.write_text(f"""#!/bin/bash
[ "$SLURM_ARRAY_TASK_ID" = 2 ] || exec {study} "$@"
(ulimit -c 0; ulimit -f 1; exec {study} "$@")
touch {self.folder}/stopped
exec sleep infinity
""")
        script.chmod(0o700)
        return str(script)

    def expect_no_join(self, reason, *parts):
        refused = run_study("stability", "--out", self.folder / "refused", "--merge", *parts)
        self.assertEqual(refused.returncode, 1)
        self.assertEqual(refused.stderr.count("\n"), 1, refused.stderr)
        self.assertIn(reason, refused.stderr)

    def test_of_which_a_task_was_killed_joins_to_the_bytes_of_one_process(self):
        cluster = slurm_cluster.SlurmCluster(self.folder / "slurm")
        self.addCleanup(cluster.close)
        parts = self.folder / "parts"

        def submit(array, **variables):
            return cluster.submit({"OUT": str(parts), **variables}, f"--array={array}", f"--output={self.folder}/%a.log", ARRAY, *STUDY)

        job = submit("1-4", STUDY=self.study_that_stops_in_task_2())
        self.assertTrue(eventually(lambda: (self.folder / "stopped").exists() and len(cluster.tasks(job)) == 1))
        self.assertEqual(cluster.tasks(job), [f"{job}_2"])
        cluster.cancel(f"{job}_2")
        self.assertTrue(eventually(lambda: not cluster.tasks(job)))
        self.expect_no_join("cases-2-of-4.jsonl: has done 1 of its 2 cases", parts)

        again = submit("2", STUDY=program("osteomill_study"), PARTS="4")
        self.assertTrue(eventually(lambda: not cluster.tasks(again)))
        self.assertIn("1 of 2 cases are done in ", (self.folder / "2.log").read_text(), "it goes on where it was")

        joined = run_study("stability", "--merge", parts, "--out", self.folder / "joined")
        self.assertEqual(joined.returncode, 0, joined.stderr)
        self.assertEqual(run_study(*STUDY, "--out", self.folder / "whole").returncode, 0)
        files = list((self.folder / "whole").iterdir())
        self.assertGreater(len(files), 8, "tables, JSON and charts")
        for file in files:
            self.assertEqual((self.folder / "joined" / file.name).read_bytes(), file.read_bytes(), file)

        copy = shutil.copy(parts / "cases-1-of-4.jsonl", self.folder / "copy.jsonl")
        self.expect_no_join("part 1 is there twice: in ", parts, copy)
        (parts / "cases-3-of-4.jsonl").unlink()
        self.expect_no_join("missing of 4 parts: 3", parts)


if __name__ == "__main__":
    unittest.main()
