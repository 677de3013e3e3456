"""Ordinary motions of a hand at the end of bone, at which the default coupling once failed. Each is a scene and a motion in
tests/data/haptics, played by the server on its virtual clock."""

import json
import pathlib
import unittest

import numpy as np

from support import FolderTest, run_server, run_study

MOTIONS = pathlib.Path(__file__).parents[1] / "data" / "haptics"


class HandAtBoneEndsTest(FolderTest):
    def play(self, scene, motion):
        """Takes in what the hand felt."""
        self.measured, self.log, _, self.said = run_server(self.folder, "--scene", MOTIONS / f"{scene}.toml",
                                                           "--trajectory", MOTIONS / f"{motion}.csv")
        self.assertLess(self.measured["solve"]["max_residual_n"], 1e-3, "every tick ends in balance")
        self.assertEqual(self.measured["faults"]["energy_to_hand"], 0)
        force_n = np.stack([self.log[f"force_{axis}_n"] for axis in "xyz"], axis=1)
        self.force_n = np.linalg.norm(force_n, axis=1)
        self.peak_n = self.force_n[1:].max()
        self.largest_jump_n = np.linalg.norm(np.diff(force_n, axis=0), axis=1).max()
        removed_mm3 = self.log["removed_mm3"]
        self.removed_mm3 = removed_mm3[-1]
        # Longest time with more than 0.3 N and no bone removed. At 1 kHz a shallow cut may leave every voxel's level alone for a tick or two.
        before = np.maximum(np.arange(len(removed_mm3)) - 4, 0)
        is_stuck = (self.force_n > 0.3) & (removed_mm3 <= removed_mm3[before])
        ends = np.flatnonzero(np.diff(np.concatenate([[False], is_stuck[1:], [False]]).astype(int)))
        self.stuck_ms = int((ends[1::2] - ends[::2]).max(initial=0))

    def test_a_burr_that_breaks_through_the_braincase_does_not_jam(self):
        # It was held with 2.6 N for 4 s, cutting nothing. A rigid burr meets 0.6 N.
        self.play("jam", "jam")
        self.assertLessEqual(self.stuck_ms, 50)
        self.assertLess(self.peak_n, 1.0)
        self.assertLess(self.largest_jump_n, 0.3)
        self.assertLess(self.measured["energy_to_hand_mj"]["most"], 5.0)
        self.assertGreater(self.removed_mm3, 40.0, "and is through")

    def test_a_pass_along_an_edge_does_not_drive_the_hand(self):
        # It gave the hand 185 mJ, with 3.3 N and jumps of 0.71 N. A rigid burr gives 54 mJ, 5 more would be a fault.
        self.play("edge", "edge")
        self.assertLess(self.measured["energy_to_hand_mj"]["most"], 15.0)
        self.assertLess(self.peak_n, 1.2)
        self.assertLess(self.largest_jump_n, 0.3)
        self.assertLessEqual(self.stuck_ms, 50)
        self.assertGreater(self.removed_mm3, 20.0)

    def test_a_larger_burr_is_not_put_into_the_hole_of_a_smaller_one(self):
        # 5 mm came to be in the hole of 1.5 mm: 3.3 N, and the hand was thrown 8 mm.
        self.play("change", "change")
        self.assertLess(self.peak_n, 1.0)
        self.assertLess(self.largest_jump_n, 0.3)
        after = self.log["t_s"] >= 4.9  # it is requested at 4.81 s
        self.assertTrue(after.any())
        burr_mm = np.stack([self.log[f"burr_{axis}_mm"] for axis in "xyz"], axis=1)
        self.assertLess(np.linalg.norm(burr_mm[after] - burr_mm[-1], axis=1).max(), 0.2)
        self.assertLess(self.force_n[after].max(), 0.1)
        self.assertIn("changed in the air", self.said)

    def test_a_burr_that_turns_is_not_changed(self):
        # 60 mm^3 vanished in one step.
        self.play("change", "change_on")
        self.assertLess(self.removed_mm3, 6.0, "the hole of 1.5 mm")
        self.assertLess(self.peak_n, 1.0)
        self.assertIn("let go of the pedal", self.said)

    def test_a_shank_tilted_in_a_hole_throws_no_hand_out_of_it(self):
        # 25 holes and tilts that the study makes.
        for method in ("implicit", "virtual-coupling"):
            out = self.folder / method
            outcome = run_study("stability", "--sites", "--quick", "--only", "in a hole of 2.", "--methods", method, "--out", out)
            self.assertEqual(outcome.returncode, 0, outcome.stderr)
            holes = json.loads((out / "sites.json").read_text())["kinds"]["tilted in a hole"]
            self.assertEqual(holes["cases"], 25)
            self.assertLess(holes["most_energy_mj"], 5.0, method)
            self.assertEqual(holes["faults"], 0, method)


if __name__ == "__main__":
    unittest.main()
