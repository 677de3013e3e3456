"""The examples work as they say."""

import importlib.util
import os
import pathlib
import subprocess
import sys
import unittest

import numpy as np
from support import FolderTest, plunge, tooth

import osteomill as om

EXAMPLES = pathlib.Path(__file__).parents[2] / "python" / "examples"


class ExamplesTest(FolderTest):
    def run_example(self, name, *arguments):
        done = subprocess.run([sys.executable, EXAMPLES / name, *arguments], cwd=self.folder, capture_output=True, text=True,
                              env=os.environ | {"MPLCONFIGDIR": str(self.folder)})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def recorded(self):
        file = self.folder / "session.pcap"
        with om.Session(tooth(), record=file) as session:
            ticks = session.rollout(plunge(tooth(), 3000, 4.0), pedals=True)
        return str(file), ticks

    def test_force_against_depth_is_a_picture_with_a_curve(self):
        self.run_example("force_against_depth.py", "force.svg")
        picture = (self.folder / "force.svg").read_text()
        self.assertIn("<svg", picture)
        self.assertGreater(max(len(line) for line in picture.split("<path")), 2000)

    def test_a_recording_is_a_table_of_pandas(self):
        file, ticks = self.recorded()
        rows = self.run_example("recording_to_pandas.py", file).splitlines()
        self.assertEqual(rows[0].split(), ["force_n", "depth_mm", "removed_mm3", "spindle_on"])
        last = [float(cell) for cell in rows[-1].split()]
        self.assertAlmostEqual(last[3], ticks["removed_mm3"]["total"][-1], delta=0.02)
        self.assertLessEqual(last[1], np.linalg.norm(ticks["force_n"], axis=1).max() + 1e-3)

    def test_couplings_are_compared_on_one_motion(self):
        file, ticks = self.recorded()
        lines = self.run_example("compare_couplings.py", file, "implicit", "virtual-coupling").splitlines()
        self.assertEqual([line.split(":")[0] for line in lines], ["implicit", "virtual-coupling"])
        removed = [float(line.rsplit(" ", 2)[1]) for line in lines]
        # The recorded motion had straight lines between its poses, and so has the motion made from it.
        self.assertAlmostEqual(removed[0], ticks["removed_mm3"]["total"][-1], delta=0.05)
        self.assertNotEqual(lines[0].split(":")[1], lines[1].split(":")[1])

    def test_slicer_gets_the_bone_without_a_mirror(self):
        self.run_example("bone_for_slicer.py", "bone.npz")
        with np.load(self.folder / "bone.npz") as file:
            fraction, to_ras = file["fraction"], file["ijk_to_ras"]
        before = tooth().bone.fraction()
        self.assertEqual(fraction.shape, before.shape[::-1])
        self.assertTrue((fraction <= before.T).all() and (fraction < before.T).any())
        voxel = np.array([300, 200, 90])
        lps = tooth().bone.origin_mm + 0.1 * voxel
        np.testing.assert_allclose(to_ras @ np.append(voxel, 1), np.append(lps * [-1, -1, 1], 1))
        self.assertGreater(np.linalg.det(to_ras), 0)

    def test_a_path_is_learnt(self):
        spec = importlib.util.spec_from_file_location("learn_path", EXAMPLES / "learn_path.py")
        learn_path = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(learn_path)
        best, best_score, means = learn_path.search(tooth(), generations=4, population=12, seed=1)
        self.assertGreater(means[-1], means[0] + 0.05)  # seeded, and sessions are exact: the same on every machine
        self.assertGreater(best_score, means[-1])
        self.assertTrue(((best >= learn_path.LEAST) & (best <= learn_path.MOST)).all())


if __name__ == "__main__":
    unittest.main()
