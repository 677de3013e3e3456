"""Exports: a session's bone as a surface that another program opens, and the removed part of it."""

import re
import shutil
import signal
import subprocess
import time
import unittest

from images import write_block, write_milling_motion
from running import Running
from support import FolderTest


class BoneExportTest(FolderTest):
    def drill(self, duration_s, *words):
        """A block, drilled for a while."""
        write_block(self.folder / "block.nrrd")
        write_milling_motion(self.folder / "motion.csv")
        self.run_to(0, "haptic_server", "--bone", self.folder / "block.nrrd", "--trajectory", self.folder / "motion.csv",
                    "--clock", "virtual", "--duration-s", duration_s, *words)

    def test_gives_the_same_surface_of_the_saved_bone_and_of_the_recording(self):
        carved, whole, recording = (self.folder / name for name in ("carved.nrrd", "whole.nrrd", "a.pcap"))
        self.drill("2", "--record", recording, "--save-bone", carved, "--json", self.folder / "a.json")
        self.assertIn("triangles", self.run_to(0, "bone_export", carved, self.folder / "a.stl").stderr)
        self.run_to(0, "packet_replay", recording, "--surface", self.folder / "b.stl", "--difference", self.folder / "gone.nrrd",
                    "--json", self.folder / "b.json")
        self.assertEqual((self.folder / "a.stl").read_bytes(), (self.folder / "b.stl").read_bytes())
        self.assertTrue((self.folder / "b.json").exists())

        self.drill("0.001", "--save-bone", whole)  # a bone saved at once is the one that was drilled
        gone = self.run_to(0, "bone_export", carved, self.folder / "gone2.nrrd", "--removed", whole)
        self.assertEqual((self.folder / "gone.nrrd").read_bytes(), (self.folder / "gone2.nrrd").read_bytes())
        removed_mm3 = self.json("a.json")["removed_mm3"]["total"]
        self.assertRegex(gone.stderr, r"[0-9.]+ mm\^3 removed")
        self.assertAlmostEqual(float(re.search(r"([0-9.]+) mm\^3 removed", gone.stderr)[1]), removed_mm3, delta=1e-3)
        self.assertGreater(removed_mm3, 0.01)

        if not shutil.which("admesh"):
            self.skipTest("there is no admesh, by which another program would find it closed")
        found = subprocess.run(["admesh", self.folder / "a.stl"], check=True, capture_output=True, text=True).stdout
        for line in ("Total disconnected facets *: *0 ", "Degenerate facets *: *0\n", "Backwards edges *: *0\n", "Normals fixed *: *0\n",
                     "Volume *: *[-0-9.]+"):
            self.assertRegex(found, line)
        self.assertGreater(float(re.search("Volume *: *([-0-9.]+)", found)[1]), 0.0, "else normals point inwards")

    def test_that_is_stopped_leaves_nothing_and_says_so(self):
        cube, out = self.folder / "cube.nrrd", self.folder / "out"
        self.run_to(0, "haptic_server", "--scene", "cube", "--clock", "virtual", "--duration-s", "0.001", "--save-bone", cube)
        out.mkdir()
        # The signal may come before the program listens, or after it is done; then once more.
        for attempt in range(20):
            with Running("bone_export", cube, out / "a.stl") as export:
                time.sleep(0.1 * (attempt + 1))
                if export.end(signal.SIGTERM if attempt % 2 else signal.SIGINT) == 1:
                    self.assertEqual(export.err, "bone_export: stopped; nothing was written\n")
                    self.assertEqual(list(out.iterdir()), [])
                    return
            (out / "a.stl").unlink(missing_ok=True)
        self.fail("it was never stopped in time")

    def test_says_in_one_line_what_is_wrong(self):
        none = self.folder / "none.nrrd"
        self.expect_line(1, "none.nrrd", "bone_export", none, self.folder / "a.stl")
        self.assertIn(".stl, .ply or .obj", self.run_to(2, "bone_export", none, self.folder / "a.step").stderr)
        self.run_to(0, "bone_export", "--help")


if __name__ == "__main__":
    unittest.main()
