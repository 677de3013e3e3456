"""Odd files that are sound, or can be mended, and the real bone_import: its results and its messages. And hostile files for the server."""

import gzip
import io
import os
import signal
import unittest
import zlib

import numpy as np
from PIL import Image

from dicom import JPEG2000, SEGMENTATION, dicom, dicom_of_frames, rescale, series, write_series
from images import nrrd_header, read_bone_file
from running import Running
from support import FolderTest

SIZES = 3, 4, 5
RAMP = np.arange(60, dtype="<i2")


def meta_header(data_file="LOCAL", spacing_mm="1 1 1", byte_order_msb=False, element="MET_SHORT", more=""):
    return (f"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = {byte_order_msb}\n{more}"
            f"Offset = 1 2 3\nElementSpacing = {spacing_mm}\nDimSize = 3 4 5\nElementType = {element}\nElementDataFile = {data_file}\n").encode()


def jpeg2000(pixels):
    """The codestream of signed pixels, which PIL does not write: that of unsigned ones, half their range higher, but for its sign."""
    out = io.BytesIO()
    Image.fromarray((pixels.astype(int) + 32768).astype(np.uint16)).save(out, "JPEG2000", no_jp2=True)
    stream = bytearray(out.getvalue())
    stream[42] |= 0x80  # SIZ: the bits and the sign of the first component
    return bytes(stream)


class ImportTest(FolderTest):
    def put(self, name, *parts):
        file = self.folder / name
        file.write_bytes(b"".join(part.encode() if isinstance(part, str) else bytes(part) for part in parts))
        return file

    def imported(self, source, *options):
        """The HU of an import at the file's own spacing of 1 mm, which changes none of them, and its messages."""
        said = self.run_to(0, "bone_import", source, self.folder / "bone.nrrd", *(options or ("--spacing-mm", "1"))).stderr
        return read_bone_file(self.folder / "bone.nrrd").hu, said

    def expect_ramp(self, name, *parts):
        hu, _ = self.imported(self.put(name, *parts))
        np.testing.assert_allclose(hu.ravel(), RAMP, rtol=0, atol=1, err_msg=name)

    def refusal(self, source):
        return self.run_to(1, "bone_import", source, self.folder / "bone.nrrd").stderr


class OddImportTest(ImportTest):
    def test_reads_a_meta_image_of_one_file_for_each_slice(self):
        names = [f"s{number}.raw" for number in range(10, 20, 2)]
        for name, plane in zip(names, RAMP.reshape(5, 12)):
            self.put(name, plane)
        self.expect_ramp("pattern.mhd", meta_header("s%d.raw 10 18 2"))
        self.expect_ramp("list.mhd", meta_header("\n".join(("LIST", *names))))
        self.expect_ramp("pattern.nhdr", nrrd_header(SIZES, more="data file: s%d.raw 10 18 2\n"))

    def test_reads_what_is_compressed_and_what_is_big_endian(self):
        self.expect_ramp("zlib.mha", meta_header(more="CompressedData = True\n"), zlib.compress(RAMP))
        self.expect_ramp("big.mha", meta_header(byte_order_msb=True), RAMP.byteswap())
        two_members = gzip.compress(bytes(RAMP)[:50]) + gzip.compress(bytes(RAMP)[50:])
        self.expect_ramp("members.nrrd", nrrd_header(SIZES, encoding="gzip"), two_members)

    def test_reads_every_encoding_and_type_of_a_nrrd(self):
        text = "".join(f"{i}\n" if i % 7 == 6 else f"{i} " for i in RAMP)
        wide = RAMP.astype("<i8")
        self.expect_ramp("text.nrrd", nrrd_header(SIZES, encoding="ascii"), text)
        self.expect_ramp("wide.nrrd", nrrd_header(SIZES, type="int64"), wide)
        self.expect_ramp("wide_gzip.nrrd", nrrd_header(SIZES, type="uint64", encoding="gzip"), gzip.compress(bytes(wide)))

    def test_says_of_labels_what_it_had_to_assume(self):
        scan = self.put("scan.nrrd", nrrd_header(SIZES, origin_mm=(1, 2, 3)), RAMP)
        labels = np.zeros(60, np.uint8)
        labels[22] = 1
        nerve = self.put("nerve.mha", meta_header(element="MET_UCHAR"), labels)
        said = self.run_to(0, "bone_import", scan, "--segmentation", nerve, "--case", self.folder / "case", "--threshold-hu", "20",
                           "--spacing-mm", "1").stderr
        self.assertIn("nerve.mha: warning: its header has no TransformMatrix; left and right are a guess", said)

    def test_refuses_text_that_is_no_numbers(self):
        ones = 59 * "10 "
        for text, reason in ((ones, "fewer numbers than voxels"), (ones + "1x", "'1x' is no number"), (ones + 1000 * "1", "is no number")):
            self.assertIn(reason, self.refusal(self.put("x.nrrd", nrrd_header(SIZES, encoding="ascii"), text)))

    def test_makes_no_bone_of_the_edge_of_a_field_of_view(self):
        # Soft tissue of 40 HU, cut by a round field, with a post of bone in its middle.
        def from_the_middle_mm(shape, spacing_mm):
            _, y, x = np.indices(shape)
            return np.hypot(spacing_mm * x - 15.5, spacing_mm * y - 15.5)
        r_mm = from_the_middle_mm((8, 32, 32), 1.0)
        padded = self.put("padded.nrrd", nrrd_header((32, 32, 8)),
                          np.where(r_mm > 14.0, -3024, np.where(r_mm < 4.0, 1500, 40)).astype("<i2"))
        hu, said = self.imported(padded, "--spacing-mm", "0.25", "--threshold-hu", "300")
        self.assertIn("-3024 HU fill what lies outside its field of view", said)
        self.assertFalse((hu[from_the_middle_mm(hu.shape, 0.25) > 6.0] >= 300).any())

    def test_says_that_bytes_follow_the_voxels(self):
        _, said = self.imported(self.put("more.mha", meta_header(spacing_mm="1 1 2"), bytes(2 * 60 + 3)))
        self.assertIn("3 bytes follow its voxels; they are not read", said)

    def test_takes_the_scan_beside_its_segmentation(self):
        folder = write_series(self.folder / "series", series(3))
        for i in range(9):
            (folder / f"seg{i}").write_bytes(dicom(bytes(24), kind=SEGMENTATION, modality="SEG"))
        self.assertGreater(self.imported(folder)[0].size, 0)

    def test_warns_of_a_modality_that_is_not_ct(self):
        _, said = self.imported(write_series(self.folder / "series", [dicom(bytes(24), position_mm=(0, 0, z), modality="MR") for z in range(3)]))
        self.assertIn("its modality is MR, not CT", said)

    def test_refuses_frames_that_are_cut_off(self):
        self.assertIn("cut off", self.refusal(self.put("cut.dcm", dicom_of_frames(bytes(720), range(3))[:-2])))

    @unittest.skipIf(os.geteuid() == 0, "root reads everything")
    def test_refuses_a_file_that_may_not_be_read(self):
        folder = write_series(self.folder / "series", series(3))
        (folder / "02.dcm").chmod(0)
        self.assertIn("02.dcm: cannot be opened", self.refusal(folder))


class StoppedImportTest(ImportTest):
    def test_leaves_nothing_and_says_so(self):
        scan = write_series(self.folder / "series", series(5))
        self.put("bone.part-0123abcd.nrrd", "of one that was killed")
        for output in ([self.folder / "bone.nrrd"], ["--case", self.folder / "case"]):
            with Running("bone_import", scan, *output, "--spacing-mm", "0.012") as stopped:  # takes minutes
                stopped.has_logged("refining")
                self.assertEqual(stopped.end(signal.SIGINT), 1, stopped.err)
                self.assertTrue(stopped.err.endswith("bone_import: stopped; nothing was written\n"), stopped.err)
            self.assertEqual(list(self.folder.iterdir()), [scan], "and not the part of another time")


class CompressedImportTest(ImportTest):
    def test_follows_the_sign_of_a_jpeg_2000_codestream(self):
        pixels = np.arange(-1000, 1400, 20, dtype="<i2").reshape(10, 12)
        places = [(-5, -4, 2 * i) for i in range(3)]
        of = {"columns": 12, "rows": 10, "syntax": JPEG2000, "more": rescale(1, 0)}
        right, said = self.imported(write_series(self.folder / "right", [dicom([jpeg2000(pixels)], position_mm=at, **of) for at in places]))
        self.assertNotIn("codestream", said)
        self.assertEqual(right[0, 0, 0], -1000)
        wrong, said = self.imported(
            write_series(self.folder / "wrong", [dicom([jpeg2000(pixels)], position_mm=at, is_signed=False, **of) for at in places]))
        np.testing.assert_array_equal(wrong, right)
        self.assertIn("warning: 3 file(s) say unsigned pixels (0028,0103) where their JPEG 2000 codestream says signed; the codestream is followed",
                      said)

    def test_reads_the_frames_of_a_file_in_the_order_in_which_they_lie(self):
        frames = (400 + 200 * np.arange(3)[:, None, None] + np.arange(120).reshape(10, 12)).astype("<i2")
        z_mm = (2, 0, 1)
        hu, _ = self.imported(self.put("frames.dcm", dicom_of_frames(frames.tobytes(), z_mm)))
        np.testing.assert_array_equal(hu, 2 * frames[[1, 2, 0]] - 1000)
        compressed = dicom_of_frames([jpeg2000(frame) for frame in frames], z_mm, syntax=JPEG2000)
        np.testing.assert_array_equal(self.imported(self.put("compressed.dcm", compressed))[0], hu)


class HostileServerTest(FolderTest):
    def expect_refused(self, reason, *options):
        self.expect_line(1, reason, "haptic_server", "--duration-s", "0.1", *options)

    def test_refuses_a_key_of_many_dots(self):
        file = self.folder / "x.toml"
        file.write_text("a" + 100_000 * ".a" + " = 1\n")
        self.expect_refused("x.toml:1: a key of more than 32 parts", "--scene", file)
        self.expect_refused("x.toml:1: a key of more than 32 parts", "--device", "hid", "--device-profile", file)

    def test_refuses_pipes_and_devices(self):
        scene, bone = self.folder / "x.toml", self.folder / "x.nrrd"
        os.mkfifo(scene)
        self.expect_refused("cannot be read", "--scene", scene)
        self.expect_refused("cannot be read", "--scene", "/dev/zero")
        os.mkfifo(bone)
        self.expect_refused("is not a file", "--bone", bone)

    def test_refuses_a_bone_whose_gzip_checksum_is_wrong(self):
        voxels = bytearray(gzip.compress(120 * b"\1"))
        voxels[-6] ^= 1
        file = self.folder / "x.nrrd"
        file.write_bytes(nrrd_header(SIZES, encoding="gzip") + voxels)
        self.expect_refused("its compressed voxels are damaged", "--bone", file)


if __name__ == "__main__":
    unittest.main()
