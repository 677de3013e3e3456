"""Scans larger than the importer's memory may be, and the real bone_import: it reads them slab by slab."""

import gzip
import os
import struct
import unittest

import numpy as np

from dicom import JPEG2000, dicom_of_frames
from images import read_bone_file, write_nrrd
from support import FolderTest, run_measured

SIZES = COLUMNS, ROWS, SLICES = 720, 720, 320
VOXEL_BYTES = 2 * COLUMNS * ROWS * SLICES  # 316 MiB; read as a whole, 1.5 GiB
MOST_BYTES = 256 * 1024**2


def nifti_header():
    """Of a file of int16 in voxels of 2 mm, whose 0 is 300 HU."""
    header = bytearray(352)
    for offset, form, *values in ((0, "i", 348), (40, "8h", 3, *SIZES, 1, 1, 1, 1), (70, "2h", 4, 16), (76, "4f", 1, 2, 2, 2),
                                  (108, "3f", 352, 2, 300), (254, "h", 1),  # orientation from the rows below, RAS
                                  (280, "12f", 2, 0, 0, 10, 0, 2, 0, 20, 0, 0, 2, 30), (344, "4s", b"n+1")):
        struct.pack_into("<" + form, header, offset, *values)
    return bytes(header)


def jpeg2000_start(columns, rows):
    """The start of a codestream that says this of its image, of signed numbers of 16 bits: SOC and SIZ."""
    return struct.pack(">HHHHIIIIIIIIHBBB", 0xFF4F, 0xFF51, 41, 0, columns, rows, 0, 0, columns, rows, 0, 0, 1, 0x8F, 1, 1)


class LargeImportTest(FolderTest):
    def put(self, name, start, voxel_bytes=VOXEL_BYTES):
        """A file whose voxels are all 0."""
        file = self.folder / name
        file.write_bytes(start)
        os.truncate(file, len(start) + voxel_bytes)
        return file

    def run_in_bounds(self, status, source, *options):
        """The messages of an import that ends with this exit status."""
        ended, peak_bytes = run_measured("bone_import", source, self.folder / "bone.nrrd", *options)
        self.assertEqual(ended.returncode, status, ended.stderr)
        self.assertLess(peak_bytes, MOST_BYTES)
        return ended.stderr

    def expect_import(self, source, region="-30,-40,30,-10,-20,50", hu=300):
        """A corner of it, mm, of these HU."""
        self.run_in_bounds(0, source, "--spacing-mm", "2", "--region", region)
        self.assertEqual(np.unique(read_bone_file(self.folder / "bone.nrrd").hu).tolist(), [hu])

    def test_reads_a_nifti_in_bounded_memory(self):
        self.expect_import(self.put("large.nii", nifti_header()))

    def test_reads_a_compressed_nifti_in_bounded_memory(self):
        file = self.folder / "large.nii.gz"
        file.write_bytes(gzip.compress(nifti_header()) + SLICES * gzip.compress(bytes(2 * COLUMNS * ROWS)))
        self.expect_import(file)

    def test_reads_the_frames_of_a_dicom_file_in_bounded_memory(self):
        # A multi-frame file, as cone-beam scanners write it.
        start = dicom_of_frames(b"", range(0, 2 * SLICES, 2), COLUMNS, ROWS, pixel_bytes=VOXEL_BYTES)
        self.expect_import(self.put("large.dcm", start), "100,100,100,120,120,120", -1000)

    def test_refuses_compressed_frames_of_more_than_an_import_may_take(self):
        # Frames that are compressed together would be held in memory together.
        fragments = [jpeg2000_start(700, 700) + bytes(1024**2)] + 399 * [b"\xff\xd9"]
        file = self.put("compressed.dcm", dicom_of_frames(fragments, range(400), 700, 700, syntax=JPEG2000), 0)
        said = self.run_in_bounds(1, file, "--spacing-mm", "1")
        self.assertIn("compressed.dcm: has pixels of which 1.8 GiB would be held at once", said)
        self.assertIn("one file a slice", said)

    def test_refuses_a_grid_whose_slices_are_more_than_an_import_may_take(self):
        file = self.put("wide.nii", nifti_header())
        said = self.run_in_bounds(1, file, "--spacing-mm", "0.05", "--region", "-1e9,-1e9,30,1e9,1e9,31")
        self.assertIn("GiB of memory, where an import may take 1.5", said)
        self.assertIn("smaller --region or a larger --spacing-mm", said)


class LargeCaseTest(FolderTest):
    def peak_bytes(self, edge):
        """Of a session that ends as soon as it has begun, whose case is a cube of so many voxels an edge in sixteen layers, each a tissue."""
        scan, segmentation, case = (self.folder / f"{edge}{end}" for end in (".nrrd", ".seg.nrrd", ""))
        z = np.arange(edge)[:, None, None]
        segments = "".join(f"Segment{i}_Name:=tissue {i + 1}\nSegment{i}_LabelValue:={i + 1}\n" for i in range(16))
        write_nrrd(scan, np.broadcast_to(700 + z, 3 * (edge,)).astype(np.int16), 0.2)
        write_nrrd(segmentation, np.broadcast_to(1 + 16 * z // edge, 3 * (edge,)).astype(np.uint8), 0.2, more=segments)
        self.run_to(0, "bone_import", scan, "--case", case, "--segmentation", segmentation, "--spacing-mm", "0.2", "--threshold-hu", "300")
        ended, peak_bytes = run_measured("haptic_server", "--case", case, "--clock", "virtual", "--duration-s", "0.01", "--listen", "127.0.0.1:0")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return peak_bytes

    def test_of_sixteen_tissues_is_loaded_in_few_bytes_a_voxel(self):
        small, large = 32, 224
        more_bytes = self.peak_bytes(large) - self.peak_bytes(small)
        # Fraction and label, and again of the copy that is shown; each tissue's own mask would be 2 more.
        self.assertLess(more_bytes / (large**3 - small**3), 5.0)


if __name__ == "__main__":
    unittest.main()
