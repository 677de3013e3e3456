"""The real bone_import, as a user calls it: its files, its messages, its exit status."""

import os
import pathlib
import subprocess
import unittest

import numpy as np

from dicom import series, write_series
from images import nrrd_header, read_bone_file
from support import FolderTest, run


class ImportTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "bone.nrrd"

    def ended(self, source, *options):
        """The exit status, and the lines from standard output and error together."""
        ended = run("bone_import", source, self.output, *options, stderr=subprocess.STDOUT)
        return ended.returncode, ended.stdout.splitlines()

    def imported(self, source, *options):
        """The bone file of an import that ends well, and its lines."""
        status, lines = self.ended(source, *options)
        self.assertEqual(status, 0, lines)
        return read_bone_file(self.output), lines

    def expect_refused(self, reason, source, *options):
        """Exit 1 and no output but one line that names the input."""
        status, lines = self.ended(source, *options)
        self.assertEqual((status, len(lines)), (1, 1), lines)
        self.assertIn(f"bone_import: {source}", lines[0])
        self.assertIn(reason, lines[0])
        self.assertFalse(self.output.exists(), source)


class BoneImportTest(ImportTest):
    def setUp(self):
        super().setUp()
        self.series = write_series(self.folder / "series", series(5))

    def test_makes_a_bone_file_of_a_dicom_series(self):
        bone, lines = self.imported(self.series, "--spacing-mm", "0.5", "--threshold-hu", "250")
        self.assertIn("GiB of memory", lines[0], "the estimate comes first")
        self.assertIn("refining 100 %", lines)
        self.assertEqual(lines[-1], f"bone: {self.output}; next: haptic_server --device client --bone '{self.output}'")
        self.assertEqual(bone.threshold_hu, 250.0)
        self.assertEqual((bone.hu.shape, bone.spacing_mm, bone.origin_mm), ((17, 19, 23), 0.5, (-5.0, -4.0, 0.0)))
        self.assertEqual(bone.hu[0, 0, 0], -1000, "far from bone")
        self.assertEqual(bone.hu[-1, -1, -1], 400)

    def test_says_that_a_threshold_leaves_nothing_or_everything(self):
        status, lines = self.ended(self.series, "--threshold-hu", "3000")
        self.assertEqual(status, 1)
        self.assertIn("no voxel reaches --threshold-hu 3000; the highest has ", lines[-1])
        self.assertNotIn("refining", "\n".join(lines), "said early")
        _, lines = self.imported(self.series, "--spacing-mm", "0.5", "--threshold-hu", "-1024")
        self.assertIn("every voxel reaches --threshold-hu -1024", "\n".join(lines))

    def test_keeps_soft_tissue_where_told_to(self):
        def milled():
            """The checksum of the bone that a session makes of the file."""
            self.run_to(0, "haptic_server", "--clock", "virtual", "--duration-s", "0.001", "--bone", self.output, "--json", self.folder / "a.json")
            return self.json("a.json")["bone_checksum"]
        every, _ = self.imported(self.series, "--spacing-mm", "0.5")
        near_bone, _ = self.imported(self.series, "--spacing-mm", "0.5", "--threshold-hu", "250")
        milled_near_bone = milled()
        kept, _ = self.imported(self.series, "--spacing-mm", "0.5", "--threshold-hu", "250", "--keep-soft-tissue")
        np.testing.assert_array_equal(kept.hu, every.hu)
        self.assertFalse(np.array_equal(near_bone.hu, every.hu))
        self.assertEqual(kept.threshold_hu, 250.0)
        self.assertEqual(milled(), milled_near_bone, "the bone is the same")

    def test_previews_every_voxel_as_a_byte_of_grey(self):
        bone, _ = self.imported(self.series, "--spacing-mm", "0.5")
        raw = self.folder / "new/look.raw"
        self.run_to(0, "bone_import", self.series, "--preview", raw)
        greys = np.frombuffer(raw.read_bytes(), np.uint8)
        # -200 HU is black, 1800 white.
        np.testing.assert_allclose(greys, 255.0 * np.clip((bone.hu.ravel() + 200.0) / 2000.0, 0.0, 1.0), rtol=0.0, atol=0.5)

    def test_clips_a_region_and_says_so(self):
        bone, lines = self.imported(self.series, "--spacing-mm", "0.5", "--region", "-3,-2,1,50,0,4")
        self.assertIn("clipped to -3.0,-2.0,1.0,6.0,0.0,4.0", lines[0])
        self.assertEqual(bone.origin_mm, (-3.0, -2.0, 1.0))

    def test_refuses_in_one_line(self):
        self.expect_refused("does not exist", self.folder / "nowhere")
        self.expect_refused("which covers -5.0,-4.0,0.0,6.0,5.0,8.0", self.series, "--region", "20,0,0,30,5,5")
        (self.series / "02.dcm").unlink()
        self.expect_refused("1 missing slice", self.series)

    def test_refuses_an_import_of_more_voxels_than_a_bone_may_have(self):
        status, lines = self.ended(write_series(self.folder / "huge", series(3, spacing_mm=50, apart_mm=100)), "--spacing-mm", "0.02")
        self.assertEqual(status, 1)
        self.assertIn("--spacing-mm", lines[-1])

    def test_exits_with_two_on_wrong_usage(self):
        for options in ("--region 1,2,3", "--spacing-mm 0", "--spacing-mm nan", "--threshold-hu nan", "--rescale 1", "--intensity-window 5,1",
                        "--rescale 1,2 --intensity-window 1,2", "--keep-soft-tissue", "--nonsense"):
            status, lines = self.ended(self.folder, *options.split())
            self.assertEqual((status, len(lines)), (2, 1), options)


class DomeTest(ImportTest):
    """Of slices 2 mm apart whose pixels are 0.5 mm apart."""

    def setUp(self):
        super().setUp()
        z, y, x = np.mgrid[:13, :121, :121]
        depth_mm = 40.0 - np.sqrt((0.5 * x - 30.0) ** 2 + (0.5 * y - 30.0) ** 2 + (2.0 * z + 20.0) ** 2)
        self.dome = self.folder / "dome.nrrd"
        self.dome.write_bytes(nrrd_header((121, 121, 13), (0.5, 0.5, 2), (-30, -30, 0)) +
                              np.clip(600.0 + 2000.0 * depth_mm, 0.0, 1200.0).astype("<i2").tobytes())

    def bone(self, *options):
        return self.imported(self.dome, "--spacing-mm", "0.5", "--threshold-hu", "600", "--keep-soft-tissue", *options)[0].hu

    def test_has_no_stairs(self):
        hu = self.bone()
        # The places at which the surface leans by 25 to 45 degrees, halfway between slices.
        for z in (14, 18, 22, 26):
            above = hu[z, 60].astype(float) - 600.0
            for x in range(61, 120):
                if above[x] >= 0.0 > above[x + 1]:
                    at_mm = 0.5 * (x + above[x] / (above[x] - above[x + 1])) - 30.0
                    self.assertAlmostEqual(np.hypot(at_mm, 0.5 * z + 20.0), 40.0, delta=0.1, msg=z)

    def test_of_a_region_is_that_part_of_the_whole(self):
        whole, part = self.bone(), self.bone("--region", "10,-5,6,20,5,14")
        depth, height, width = part.shape
        np.testing.assert_allclose(part, whole[12:12 + depth, 50:50 + height, 80:80 + width], rtol=0, atol=1)


@unittest.skipUnless("OSTEOMILL_SCANS" in os.environ, "OSTEOMILL_SCANS does not name the folder of trial scans")
class RealScansTest(ImportTest):
    def setUp(self):
        super().setUp()
        self.scans = pathlib.Path(os.environ["OSTEOMILL_SCANS"])

    def test_refuses_a_tilted_gantry(self):
        self.expect_refused("gantry tilt of 18.5", self.scans / "gantry_tilt_ct")

    def test_refines_a_region_of_the_head(self):
        bone, _ = self.imported(self.scans / "head_ct", "--spacing-mm", "0.4", "--region", "-60,10,730,-20,50,770")
        self.assertGreater(bone.hu.max(), 700)
        self.assertLess(bone.hu.min(), -900)

    def test_imports_or_refuses_every_bad_dicom_series(self):
        bad = self.scans / "bad_dicom"
        folders = {file.parent for file in bad.rglob("*/*.dcm") if "cornerstone" not in str(file.parent)}
        files = [file for file in bad.rglob("cornerstone/*") if file.is_file()]
        refused = imported = 0
        for source in sorted((*folders, *files)):
            self.output.unlink(missing_ok=True)
            status, lines = self.ended(source, "--spacing-mm", "2")
            if status == 0:
                imported += 1
                self.assertGreater(read_bone_file(self.output).hu.size, 0, source)
            else:
                refused += 1
                self.assertEqual((status, len(lines)), (1, 1), source)
                self.assertIn(str(source), lines[0])
        self.assertGreaterEqual(refused, 20)
        self.assertGreaterEqual(imported, 7, "the compressed, the multi-frame and the anisotropic series are sound")


if __name__ == "__main__":
    unittest.main()
