"""Bones from Python: arrays, boxes and frames."""

import pathlib
import tempfile
import unittest

import numpy as np
from support import plunge, run_server, tooth

import osteomill as om


class BoneTest(unittest.TestCase):
    def test_says_where_its_voxels_lie(self):
        bone = tooth().bone
        self.assertEqual((bone.shape, bone.spacing_mm), ((512, 512, 128), 0.1))
        middle = bone.origin_mm + bone.spacing_mm * (np.array(bone.shape) - 1) / 2
        np.testing.assert_allclose(middle[:2], 0.0, atol=1e-9)

    def test_a_box_is_a_piece_of_the_whole(self):
        bone = tooth().bone
        for channel in (bone.fraction, bone.tissue, bone.stiffness):
            whole = channel()
            self.assertEqual(whole.shape, bone.shape)
            np.testing.assert_array_equal(channel(((200, 215, 40), (299, 301, 77))), whole[200:299, 215:301, 40:77])
        self.assertEqual(bone.fraction(((5, 5, 5), (5, 9, 9))).shape, (0, 4, 4))

    def test_there_is_nothing_beyond_the_grid(self):
        bone = tooth().bone
        crop = bone.fraction(((250, 250, 60), (282, 282, 160)))
        np.testing.assert_array_equal(crop[:, :, :68], bone.fraction(((250, 250, 60), (282, 282, 128))))
        self.assertFalse(crop[:, :, 68:].any())
        self.assertTrue((bone.hu(((0, 0, -2), (2, 2, 0))) == -1000).all())
        with self.assertRaisesRegex(ValueError, "box: takes the first voxel"):
            bone.fraction(((10, 0, 0), (5, 1, 1)))

    def test_slicers_order_is_the_transposed_without_a_copy(self):
        fraction = tooth().bone.fraction(((200, 200, 60), (264, 260, 100)))
        self.assertTrue(fraction.T.flags.c_contiguous)
        self.assertEqual(fraction.T.base is None, False)
        self.assertEqual(fraction.T[7, 30, 11], fraction[11, 30, 7])

    def test_channels_agree_with_the_scan(self):
        box = ((200, 200, 20), (300, 300, 128))
        bone = tooth().bone
        fraction, hu, tissue, stiffness = (channel(box) for channel in (bone.fraction, bone.hu, bone.tissue, bone.stiffness))
        self.assertTrue((hu[fraction == 255] >= 150).all())  # the phantom's threshold
        self.assertTrue((stiffness[fraction > 0] > 0).all())
        enamel, dentine = (stiffness[(tissue == tooth().tissues[name]) & (fraction == 255)].mean() for name in ("enamel", "dentine"))
        self.assertGreater(enamel, dentine)
        self.assertTrue((tissue[(fraction == 255)] > 0).any())

    def test_is_made_of_arrays_and_kept_in_a_file(self):
        rng = np.random.default_rng(5)
        fraction = rng.integers(0, 256, (21, 40, 33), np.uint8)
        stiffness = np.round(rng.uniform(0.02, 5.1, fraction.shape) / 0.02) * 0.02
        tissue = rng.integers(0, 4, fraction.shape, np.uint8)
        bone = om.Bone.from_array(fraction, spacing_mm=0.25, origin_mm=[1.0, -2.0, 3.0], stiffness=stiffness, tissue=tissue)
        self.assertEqual((bone.shape, bone.spacing_mm, bone.origin_mm.tolist()), (fraction.shape, 0.25, [1.0, -2.0, 3.0]))
        np.testing.assert_array_equal(bone.fraction(), fraction)
        is_bone = fraction > 0
        np.testing.assert_array_equal(bone.tissue()[is_bone], tissue[is_bone])
        np.testing.assert_allclose(bone.stiffness()[is_bone], stiffness[is_bone], rtol=1e-6)
        self.assertAlmostEqual(bone.volume_mm3, fraction.sum(dtype=float) / 255 * 0.25**3, delta=1e-6)

    def test_a_bone_of_ones_own_is_milled(self):
        block = np.zeros((64, 64, 64), bool)
        block[8:56, 8:56, 8:40] = True
        bone = om.Bone.from_array(block, spacing_mm=0.1, origin_mm=[-3.15, -3.15, -3.95], stiffness=2.0)  # its top is z = 0
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "own.nrrd"
            bone.save(file)
            case = om.Case("cube", bone=file)
            self.assertEqual(case.bone.checksum(), bone.checksum())
            self.assertEqual(set(np.unique(case.bone.stiffness())), {np.float32(0.0), np.float32(2.0)})
            radius_mm = 0.5 * case.burrs[case.start_burr].diameter_mm
            above = np.array([0.0, 0.0, radius_mm + 0.5])
            session = om.Session(case, start_mm=above)
            session.rollout(above - np.linspace(0.0, 1.5, 1500)[:, None] * [0.0, 0.0, 1.0], pedals=True)
            left = session.bone
            missing_mm3 = (block.sum() * 255.0 - left.fraction().sum(dtype=float)) / 255 * 0.1**3
            self.assertGreater(missing_mm3, 0.5)
            self.assertAlmostEqual(session.now.removed_mm3["total"], missing_mm3, delta=1e-6)
            left.save(file)  # as it is now
            self.assertEqual(om.Case("cube", bone=file).bone.checksum(), left.checksum())

    def test_says_what_is_wrong_with_arrays(self):
        voxels = np.full((4, 4, 4), 255, np.uint8)
        for wrong, line in ((lambda: om.Bone.from_array(voxels[0], spacing_mm=1.0), "fraction: takes an array"),
                            (lambda: om.Bone.from_array(voxels.astype(float), spacing_mm=1.0), "fraction: takes uint8"),
                            (lambda: om.Bone.from_array(voxels * 0, spacing_mm=1.0), "there is no bone"),
                            (lambda: om.Bone.from_array(voxels, spacing_mm=0.0), "spacing"),
                            (lambda: om.Bone.from_array(voxels, spacing_mm=1.0, origin_mm=[0, 1]), "origin_mm"),
                            (lambda: om.Bone.from_array(voxels, spacing_mm=1.0, stiffness=9.0), "stiffness: lies within 0.02 to 5.1"),
                            (lambda: om.Bone.from_array(voxels, spacing_mm=1.0, stiffness=np.full((4, 4, 4), np.nan)), "stiffness"),
                            (lambda: om.Bone.from_array(voxels, spacing_mm=1.0, tissue=np.zeros((4, 4), np.uint8)), "tissue: takes an array"),
                            (lambda: om.Bone.from_array(voxels, spacing_mm=1.0, tissue=voxels.astype(int)), "tissue: takes uint8")):
            with self.assertRaisesRegex(om.BadInput, line):
                wrong()

    def test_arrays_are_copies(self):
        session = om.Session(tooth())
        before = session.bone.fraction(((230, 230, 100), (290, 290, 128)))
        before_again = before.copy()
        session.rollout(plunge(tooth(), 1500, 2.5), pedals=True)
        np.testing.assert_array_equal(before, before_again)
        after = session.bone.fraction(((230, 230, 100), (290, 290, 128)))
        self.assertTrue((after <= before).all() and (after < before).any())
        before[:] = 0
        self.assertEqual(om.Session(tooth()).bone.checksum(), tooth().bone.checksum())

    def test_a_hole_lies_where_the_burr_was(self):
        session = om.Session(tooth())
        out = session.rollout(plunge(tooth(), 2500, 3.5), pedals=True)
        gone = tooth().bone.fraction().astype(int) - session.bone.fraction()
        bone, radius_mm = tooth().bone, tooth().burrs[tooth().start_burr].diameter_mm / 2
        centres = bone.origin_mm + bone.spacing_mm * np.argwhere(gone > 0)
        way = out["burr_mm"][out["spindle_on"]]
        distance = np.linalg.norm(centres[:, None] - way[None, ::20], axis=2).min(axis=1)
        # The burr covers part of a voxel whose centre is up to half a diagonal away; every 20th pose is 0.03 mm from the next.
        self.assertLess(distance.max(), radius_mm + bone.spacing_mm * 3**0.5 / 2 + 0.03)
        self.assertAlmostEqual((gone.sum() / 255) * bone.spacing_mm**3, out["removed_mm3"]["total"][-1], delta=1e-6)

    def test_of_a_session_that_went_on_counts_what_it_removed(self):
        with tempfile.TemporaryDirectory() as folder:
            saved = pathlib.Path(folder) / "left.nrrd"
            measured, *_ = run_server(pathlib.Path(folder), "--duration-s", "3.5", "--save-bone", str(saved))
            case = om.Case("tooth", bone=saved)
            self.assertEqual(case.bone.checksum(), measured["bone_checksum"])
            self.assertLess(case.bone.volume_mm3, tooth().bone.volume_mm3)


if __name__ == "__main__":
    unittest.main()
