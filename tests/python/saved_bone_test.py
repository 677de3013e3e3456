"""The files that --save-bone leaves when it is stopped and when the disk is full: the real server saves, is killed, and loads again."""

import shutil
import signal
import unittest

import numpy as np

from images import write_nrrd
from running import Running
from support import IS_OPTIMISED, FolderTest, disk_of, eventually, run_measured


def write_cube(file, edge_voxels, spacing_mm, bone_edge_voxels):
    """Bone in air, whose HU vary so that files of it do not shrink to nothing."""
    hu = np.full(3 * (edge_voxels,), -1000, np.int16)
    bone = 3 * (slice(bone_edge_voxels),)
    hu[bone] = np.random.default_rng(1).integers(900, 1700, hu[bone].shape, np.int16)
    write_nrrd(file, hu, spacing_mm)


def size(file):
    """0 if it is gone."""
    try:
        return file.stat().st_size
    except FileNotFoundError:
        return 0


class SavedBoneTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.block, self.carved = self.folder / "block.nrrd", self.folder / "carved.nrrd"

    def session(self, duration_s, bone, *words):
        return "haptic_server", "--clock", "virtual", "--duration-s", duration_s, "--bone", bone, "--json", self.folder / "a.json", *words

    def loaded(self, bone):
        """The checksum of a bone as the server loads it."""
        self.run_to(0, *self.session("0.01", bone))
        return self.json("a.json")["bone_checksum"]

    def saved(self, bone, to, duration_s):
        """The checksum of the bone that is left and saved after so long."""
        self.run_to(0, *self.session(duration_s, bone, "--save-bone", to))
        return self.json("a.json")["bone_checksum"]

    def test_killed_at_any_moment_is_the_old_or_the_new_one(self):
        write_cube(self.block, 160, 0.1, 150)
        old = self.saved(self.block, self.carved, "0.5")
        before = self.folder / "old"
        before.mkdir()
        for file in self.folder.glob("carved*"):
            shutil.copy(file, before)
        fresh = self.saved(self.block, self.carved, "2")
        self.assertNotEqual(fresh, old)
        self.assertEqual(self.loaded(self.carved), fresh)
        whole_bytes = self.carved.stat().st_size

        kept = 0
        kills = 6
        for kill in range(kills):
            for file in self.folder.glob("carved*"):
                file.unlink()
            shutil.copytree(before, self.folder, dirs_exist_ok=True)
            has_begun = False

            def is_time():
                """The new files beside the old ones show how far the save has come."""
                nonlocal has_begun
                written = sum(size(file) for file in self.folder.glob("*.part*"))
                was_there, has_begun = has_begun, has_begun or written > 0
                return written > whole_bytes * kill // kills or (was_there and written == 0)
            with Running(*self.session("2", self.block, "--save-bone", self.carved)) as killed:
                eventually(is_time, every_s=0)
                killed.end(signal.SIGKILL)
            now = self.loaded(self.carved)
            self.assertIn(now, (old, fresh), kill)
            kept += now == old
        self.assertGreater(kept, 0, "some were killed before they were done")

    def test_on_a_full_disk_the_old_one_stays(self):
        write_cube(self.block, 64, 0.1, 60)
        old = self.saved(self.block, self.carved, "0.5")
        files = sorted(self.folder.iterdir())
        for kibibytes in (0, 1, 40, 300):
            said = self.run_to(1, "haptic_server", "--clock", "virtual", "--duration-s", "2", "--bone", self.block, "--save-bone", self.carved,
                               preexec_fn=disk_of(kibibytes)).stderr
            self.assertIn("carved.nrrd: cannot be written: File too large", said)
            self.assertEqual(sorted(self.folder.iterdir()), files, kibibytes)
            self.assertEqual(self.loaded(self.carved), old, kibibytes)

    def test_may_be_the_file_that_was_loaded(self):
        write_cube(self.block, 64, 0.1, 60)
        first = self.saved(self.block, self.block, "1")
        self.assertEqual(self.loaded(self.block), first)
        second = self.saved(self.block, self.block, "2")
        self.assertNotEqual(second, first)
        self.assertEqual(self.loaded(self.block), second)

    def test_takes_the_memory_of_its_bone_not_of_its_grid(self):
        scan, bone = self.folder / "scan.nrrd", self.folder / "bone.nrrd"
        write_cube(scan, 46, 1.0, 8)
        # Refined to 451^3 voxels, of which few are bone.
        imported, import_bytes = run_measured("bone_import", scan, bone, "--spacing-mm", "0.1", "--threshold-hu", "300")
        self.assertEqual(imported.returncode, 0, imported.stderr)
        for percent in range(10, 101, 10):
            self.assertRegex(imported.stderr, rf"refining {percent} %(, [^\n]+ left)?\n")
        saved, save_bytes = run_measured(*self.session("0.1", bone, "--save-bone", self.carved))
        self.assertEqual(saved.returncode, 0, saved.stderr)
        checksum = self.json("a.json")["bone_checksum"]
        self.assertEqual(self.loaded(self.carved), checksum)
        if IS_OPTIMISED:
            self.assertLess(max(import_bytes, save_bytes), 2 * 451**3 * 3 / 4)


if __name__ == "__main__":
    unittest.main()
