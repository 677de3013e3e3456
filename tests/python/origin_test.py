"""A recording and a state name all that their session computes from."""

import pathlib
import tempfile
import unittest

import h5py
import numpy as np
from support import plunge, tooth

import osteomill as om


class OriginTest(unittest.TestCase):
    def settings(self, case, name, **session):
        """A recording's settings, from info() and from HDF5."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / f"{name}.pcap"
            with om.Session(case, record=file, **session) as made:
                made.rollout(plunge(case, 300, 1.0), pedals=True)
            recording = om.Recording(file)
            recording.to_hdf5(file.with_suffix(".h5"))
            with h5py.File(file.with_suffix(".h5")) as made:
                stored = dict(made["settings"].attrs)
            info = recording.info()
            self.assertEqual(stored, info["settings"] | {"scene_toml": info["scene_toml"]})
            return stored

    def test_a_recording_names_its_origin(self):
        one = self.settings(tooth(), "a")
        for name in ("commit", "bone_digest", "is_built_in", "wall_friction", "start_position_mm", "start_spindle_axis", "arm", "seeds",
                     "instruction_set", "force_model", "coupling", "milling_rate_hz", "grip", "version"):
            self.assertTrue(one[name], name)
        self.assertEqual(one["grip"], "firm")
        for key in ("wall_friction = ", "force_scale = ", "[stiffness]", "material = ", "relative_stiffness = ", "relative_edge = ",
                    "cutting_coefficients_n_per_mm2 = ", "edge_coefficients_n_per_mm = ", "[start_pose]", "[device]"):
            self.assertIn(key, one["scene_toml"])

    def test_whatever_is_set_is_in_it(self):
        of_the_tooth = self.settings(tooth(), "a")
        for changed in (dict(set=["wall_friction=0.9"]), dict(set=["burrs.2 mm.cutting_coefficients_n_per_mm2=[900,40,20]"]),
                        dict(set=["tissues.carious lesion.material=enamel"]), dict(set=["force_scale=2"]), dict(rpm=20000),
                        dict(set=["start_pose.position_mm=[0.5, 0.2, 6.0]"]), dict(burr="4 mm")):
            self.assertNotEqual(self.settings(tooth().with_(**changed), "b"), of_the_tooth, changed)
        self.assertNotEqual(self.settings(tooth(), "c", start_mm=tooth().start_mm + [0.1, 0, 0]), of_the_tooth)

    def test_a_state_of_other_settings_is_refused(self):
        session = om.Session(tooth())
        session.rollout(plunge(tooth(), 500, 2.0), pedals=True)
        state = session.save_state()
        for changed, line in ((dict(rpm=20000), "rpm"), (dict(burr="4 mm"), "burr"), (dict(set=["force_scale=4"]), "force_scale"),
                              (dict(set=["tissues.carious lesion.cuttable=false"]), "cuttable"),
                              (dict(set=["wall_friction=0.3"]), "wall_friction"), (dict(set=["device.scale=0.5"]), "scale"),
                              (dict(set=["tissues.enamel.relative_stiffness=2.5"]), "bone_digest|relative_stiffness")):
            with self.assertRaisesRegex(om.BadInput, line):
                om.Session(tooth().with_(**changed)).load_state(state)
        for other, line in ((dict(coupling="hold"), "coupling"), (dict(vibration=True), "vibration"), (dict(hand="firm"), "arm|simulated")):
            with self.assertRaisesRegex(om.BadInput, line):
                om.Session(tooth(), **other).load_state(state)
        same = om.Session(om.Case("tooth"))
        same.load_state(state)
        self.assertEqual(same.bone.checksum(), session.bone.checksum())

    def test_a_case_with_other_settings_shares_its_bone_and_is_as_if_it_were_loaded(self):
        for changed in (dict(set=["wall_friction=0.9", "force_scale=1.5"], rpm=20000, burr="3 mm"),
                        dict(set=["tissues.enamel.relative_stiffness=1.5"])):
            bones = []
            for case in (tooth().with_(**changed), om.Case("tooth", **changed)):
                session = om.Session(case)
                session.rollout(plunge(case, 1000, 3.0), pedals=True)
                bones.append((session.bone.checksum(), session.now.peak_force_n))
            self.assertEqual(*bones)
        again = tooth().with_(set=["wall_friction=0.9"]).with_(rpm=20000)
        self.assertEqual([burr.rpm for burr in again.burrs], [20000.0] * len(again.burrs))
        with self.assertRaisesRegex(om.BadInput, "did you mean 'wall_friction'"):
            tooth().with_(set=["wall_frictoin=0.9"])

    def test_sums_agree_in_every_view(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.pcap"
            with om.Session(tooth(), record=file) as session:
                ticks = session.rollout(plunge(tooth(), 1234, 3.0), pedals=True)
                removed_mm3 = session.now.removed_mm3["total"]
            self.assertGreater(removed_mm3, 0.1)
            recording = om.Recording(file)
            self.assertAlmostEqual(recording.removed_mm3[-1], removed_mm3, delta=1e-9)
            row = np.rint(recording.session_time_s * 1000).astype(int)
            told = row > 0
            np.testing.assert_allclose(recording.removed_mm3[told], ticks["removed_mm3"]["total"][row[told] - 1], atol=1e-9)
            self.assertTrue((np.diff(recording.time_s) > 0).all())
            self.assertLess(np.diff(recording.time_s).max(), 0.04)
            self.assertAlmostEqual(recording.info()["removed_mm3"]["total"], removed_mm3, delta=1e-6)
            self.assertAlmostEqual(recording.metrics()["removed_mm3"], removed_mm3, delta=1e-6)
            self.assertAlmostEqual(recording.ticks["removed_mm3"][-1], removed_mm3, delta=5.1e-6)
            start, end = recording.bone_at(0.0), recording.bone_at(1e9)
            self.assertAlmostEqual(start.volume_mm3 - end.volume_mm3, removed_mm3, delta=1e-6)
            recording.to_hdf5(file.with_suffix(".h5"))
            with h5py.File(file.with_suffix(".h5")) as made:
                self.assertEqual(made.attrs["is_complete"], 1)
                self.assertAlmostEqual(made["states/removed_mm3"][-1], removed_mm3, delta=1e-9)
                self.assertAlmostEqual(made["ticks/removed_mm3"][-1], removed_mm3, delta=5.1e-6)
                changes, bone = made["bone/changes"], made["bone/fraction"][:].astype(int)
                before = bone.sum()
                for ijk, left in zip(changes["ijk"][:], changes["fraction"][:]):
                    bone[tuple(ijk)] = left
                gone_mm3 = (before - bone.sum()) / 255 * made["bone"].attrs["spacing_mm"] ** 3
                self.assertAlmostEqual(float(gone_mm3), removed_mm3, delta=1e-6)
                self.assertGreater(made["states/taken_unix_ns"][:].min(), 1.6e18)
            recording.to_hdf5(file.with_suffix(".hdf5"), "fivrs")
            with h5py.File(file.with_suffix(".hdf5")) as made:
                self.assertAlmostEqual(made["osteomill/removed_mm3"][-1], removed_mm3, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
