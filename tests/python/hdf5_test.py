"""Recordings as HDF5: nothing is lost in our own layout, and that of FIVRS keeps each rule its programs rely on."""

import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

import h5py
import numpy as np
from support import program, run_server

import osteomill as om

TRAJECTORY = """t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal,burr
0.0,0.5,0.2,5.5,0,0,1,0,2
0.4,0.5,0.2,4.5,0,0,1,1,2
1.6,0.5,0.2,2.6,0,0.1,1,1,2
2.4,-1.8,0.2,2.6,0,0.1,1,1,2
2.7,0.0,0.2,6.0,0.1,0,1,0,2
3.3,0.5,0.2,6.0,0.1,0,1,0,3
3.5,0.5,0.2,5.0,0.1,0,1,1,3
4.5,0.6,0.3,2.4,-0.1,0,1,1,3
4.8,0.5,0.2,6.0,0,0,1,0,3
5.9,0.5,0.2,6.0,0,0,1,0,3
"""
CONTROLS = "t_s,action,text\n1.0,mark,deep\n5.3,undo,\n"


def convert(recording, file, *options):
    return subprocess.run([program("packet_replay"), recording, "--hdf5", file, *options], capture_output=True,
                          text=True, check=False)


class Converted(unittest.TestCase):
    """A session of the tooth with two burrs, whose second stroke was undone; run once for all."""

    @classmethod
    def setUpClass(cls):
        if hasattr(Converted, "recording"):
            return
        cls = Converted
        folder = tempfile.TemporaryDirectory()
        unittest.addModuleCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "hand.csv").write_text(TRAJECTORY)
        (cls.folder / "controls.csv").write_text(CONTROLS)
        cls.pcap = cls.folder / "session.pcap"
        cls.measured, cls.log, *_ = run_server(
            cls.folder, "--record", cls.pcap, "--trajectory", cls.folder / "hand.csv", "--controls",
            cls.folder / "controls.csv", "--trainee", "Anna", "--duration-s", "5.9")
        cls.recording = om.Recording(cls.pcap)
        cls.at_start = cls.recording.bone_at(0.0).fraction()
        cls.at_end = cls.recording.bone_at(1e9).fraction()

    def open(self, *options):
        """Converted once."""
        file = self.folder / ("_".join(("session", *options)) + ".hdf5")
        if not file.exists():
            ran = convert(self.pcap, file, *options)
            self.assertEqual(ran.returncode, 0, ran.stderr)
        opened = h5py.File(file)
        self.addCleanup(opened.close)
        return opened


class AllOfRecordingTest(Converted):
    def test_is_never_the_recording_itself(self):
        before = self.pcap.read_bytes()
        os.symlink(self.folder, self.folder / "link")
        for file in (self.pcap, self.folder / "link" / self.pcap.name):
            for layout in ("osteomill", "fivrs"):
                with self.assertRaisesRegex(ValueError, "the recording and the HDF5 file are the same"):
                    self.recording.to_hdf5(file, layout)
        self.assertEqual(self.pcap.read_bytes(), before)

    def test_every_tick_is_that_of_the_log(self):
        file = self.open()
        for name in self.log.dtype.names:
            np.testing.assert_array_equal(file["ticks"][name], self.log[name], err_msg=name)
        self.assertEqual(file["ticks/hand_x_mm"].attrs["units"], "mm")
        self.assertEqual(file["ticks/force_z_n"].attrs["units"], "N")
        self.assertEqual(file["ticks/removed_mm3"].attrs["units"], "mm^3")
        self.assertEqual(file["ticks/force_z_n"].compression, "gzip")
        axis = np.stack([file[f"ticks/axis_{x}"] for x in "xyz"], axis=1)
        np.testing.assert_allclose(np.linalg.norm(axis, axis=1), 1.0, atol=2e-6)
        self.assertEqual(set(file["ticks/burr"]), {2, 3})

    def test_every_state_is_that_of_the_recording_to_the_bit(self):
        states = self.open()["states"]
        for name in ("time_s", "session_time_s", "hand_mm", "burr_mm", "axis", "force_n", "depth_mm", "removed_mm3",
                     "burr"):
            np.testing.assert_array_equal(states[name], getattr(self.recording, name), err_msg=name)
        self.assertEqual({len(states[name]) for name in states}, {len(self.recording.time_s)})
        self.assertGreater(np.nanmax(states["cut_force_n"]), 0.1)
        self.assertEqual(states["redo_steps"][-1], 1)

    def test_the_changes_lead_to_the_bone_at_the_end(self):
        bone = self.open()["bone"]
        fraction = bone["fraction"][:]
        # np.testing would take 5 s for each of these.
        self.assertTrue(np.array_equal(fraction, self.at_start))
        changes = bone["changes"]
        self.assertTrue(np.all(np.diff(changes["state"]) >= 0))
        fraction[tuple(changes["ijk"][:].T)] = changes["fraction"][:]  # the last one, if a voxel changed twice
        self.assertTrue(np.array_equal(fraction, self.at_end))
        self.assertTrue(np.any(changes["is_restored"]))
        self.assertEqual(bone.attrs["checksum_at_end"], self.measured["bone_checksum"])
        whole = self.recording.bone_at(0.0)
        self.assertTrue(np.array_equal(bone["tissue"][:], whole.tissue()))
        self.assertEqual(bone.attrs["spacing_mm"], whole.spacing_mm)
        np.testing.assert_array_equal(bone.attrs["origin_mm"], whole.origin_mm)

    def test_says_what_was_done_by_whom_with_what(self):
        file = self.open()
        self.assertEqual(file.attrs["trainee"], "Anna")
        self.assertEqual(file.attrs["is_complete"], 1.0)
        self.assertEqual(file["settings"].attrs["coupling"], "implicit")
        self.assertEqual([text.decode() for text in file["events/action"]], ["mark", "undo"])
        self.assertEqual(file["events/text"][0].decode(), "deep")
        self.assertAlmostEqual(file["events/time_s"][0], 1.0, delta=0.05)
        self.assertIn("enamel", [name.decode() for name in file["tissues/name"]])
        self.assertEqual(file["burrs/diameter_mm"][2], 2.0)
        self.assertGreater(len(file["distances/state"]), 0)
        self.assertLess(file["distances/state"][-1], len(file["states/time_s"]))

    def test_from_python_is_the_same(self):
        self.recording.to_hdf5(self.folder / "python.h5")
        self.assertEqual((self.folder / "python.h5").read_bytes(),
                         pathlib.Path(self.open().filename).read_bytes())
        with self.assertRaisesRegex(ValueError, "layout: takes osteomill, fivrs, fivrs-v3, not 'nrrd'"):
            self.recording.to_hdf5(self.folder / "python.h5", layout="nrrd")
        with self.assertRaisesRegex(RuntimeError, "nowhere"):
            self.recording.to_hdf5("/nowhere/python.h5")

    def test_of_a_torn_recording_has_what_can_be_read(self):
        whole = self.pcap.read_bytes()
        torn = self.folder / "torn.pcap"
        torn.write_bytes(whole[:-len(whole) // 5])
        self.assertEqual(convert(torn, self.folder / "torn.h5").returncode, 0)
        with h5py.File(self.folder / "torn.h5") as file:
            self.assertEqual(file.attrs["is_complete"], 0.0)
            rows = len(file["ticks/t_s"])
            self.assertTrue(1000 < rows < len(self.log))
            np.testing.assert_array_equal(file["ticks/force_x_n"], self.log["force_x_n"][:rows])

    def test_on_a_full_disk_is_one_line_and_the_old_file_stays(self):
        old = self.folder / "old.h5"
        for kilobytes in (1, 40, 400):  # at the beginning, among the bone, at the end
            old.write_text("old")
            ran = subprocess.run(
                ["/bin/bash", "-c", f"ulimit -f {kilobytes}; exec {program('packet_replay')} {self.pcap} --hdf5 {old}"],
                capture_output=True, text=True, check=False)
            self.assertEqual(ran.returncode, 1, kilobytes)
            self.assertEqual(ran.stderr, f"packet_replay: {old}: cannot be written: File too large\n")
            self.assertEqual(old.read_text(), "old")
            self.assertEqual(list(self.folder.glob("old.part*")), [])

    def test_is_refused_where_it_makes_no_sense(self):
        for arguments, what in (((self.pcap, self.folder / "a.csv"), ".h5 or .hdf5"),
                                ((self.pcap, self.folder / "a.h5", "--layout", "fivrs"), ".hdf5"),
                                ((self.pcap, self.folder / "a.h5", "--layout", "old"), "not one of osteomill")):
            ran = convert(*arguments)
            self.assertEqual(ran.returncode, 2)
            self.assertIn(what, ran.stderr)
            self.assertEqual(ran.stderr.count("\n"), 1)
        both = self.folder / "both.pcap"
        both.write_bytes(self.pcap.read_bytes() + self.pcap.read_bytes()[24:])
        ran = convert(both, self.folder / "both.h5")
        self.assertEqual(ran.returncode, 1)
        self.assertIn("several sessions were joined", ran.stderr)


class FivrsTest(Converted):
    """The rules of the layout that FIVRS's public analysis programs read, of 2022 to 2025."""

    def test_has_the_names_types_and_units(self):
        file = self.open("--layout", "fivrs")
        self.assertEqual(set(file), {"metadata", "data", "voxels_removed", "burr_change", "drill_force_feedback",
                                     "osteomill"})
        self.assertEqual(file["metadata/voxel_volume"].shape, ())
        self.assertEqual(file["metadata/voxel_volume"].dtype, np.float64)
        self.assertAlmostEqual(file["metadata/voxel_volume"][()], 0.1**3)
        self.assertEqual(file["metadata/voxel_volume"].attrs["units"], "mm^3, millimeters cubed")
        self.assertIn("metres", file["metadata/README"][()].decode())
        for path, width, kind in (("data/time", None, "f8"), ("data/pose_mastoidectomy_drill", 7, "f8"),
                                  ("data/pose_mastoidectomy_volume", 7, "f8"),
                                  ("voxels_removed/voxel_time_stamp", None, "f8"),
                                  ("voxels_removed/voxel_removed", 4, "f8"), ("voxels_removed/voxel_color", 5, "f8"),
                                  ("burr_change/time_stamp", None, "f8"), ("burr_change/burr_size", None, "i8"),
                                  ("drill_force_feedback/time_stamp", None, "f8"),
                                  ("drill_force_feedback/wrench", 6, "f8")):
            dataset = file[path]
            self.assertEqual(dataset.dtype, np.dtype(kind), path)
            self.assertEqual(dataset.shape[1:], () if width is None else (width,), path)
            self.assertEqual((dataset.compression, dataset.compression_opts), ("gzip", 4), path)

    def test_has_nothing_that_breaks_their_merger(self):
        # It takes len() of every member of every group but metadata, and adds row numbers of files.
        file = self.open("--layout", "fivrs")
        for group in set(file) - {"metadata"}:
            for name in file[group]:
                self.assertIsInstance(file[group][name], h5py.Dataset, name)
                self.assertGreaterEqual(len(file[group][name].shape), 1, name)
        self.assertNotIn("README", file["voxels_removed"])
        self.assertNotIn("high_frequency_poses", file)

    def test_has_poses_in_metres_whose_shank_is_x(self):
        file = self.open("--layout", "fivrs")
        data = file["data"]
        self.assertEqual(len({len(data[name]) for name in data}), 1)
        self.assertTrue(np.all(np.diff(data["time"]) > 0))
        rows = np.searchsorted(self.recording.time_s, data["time"] - file["data/time"][0])
        pose = data["pose_mastoidectomy_drill"][:]
        qx, qy, qz, qw = pose[:, 3:].T
        np.testing.assert_allclose(qx**2 + qy**2 + qz**2 + qw**2, 1.0, atol=1e-12)
        turned_x = np.stack([1 - 2 * (qy**2 + qz**2), 2 * (qx * qy + qz * qw), 2 * (qx * qz - qy * qw)], axis=1)
        ours = np.unique(self.recording.time_s, return_index=True)[1]
        self.assertEqual(len(rows), len(ours))
        np.testing.assert_allclose(1e3 * pose[:, :3], self.recording.burr_mm[ours], atol=1e-9)
        axis = self.recording.axis[ours]
        np.testing.assert_allclose(turned_x, axis / np.linalg.norm(axis, axis=1)[:, None], atol=1e-9)
        volume = data["pose_mastoidectomy_volume"][:]
        self.assertTrue(np.all(volume == volume[0]))
        bone = self.recording.bone_at(0.0)
        centre = np.asarray(bone.origin_mm) + 0.5 * bone.spacing_mm * (np.asarray(self.at_start.shape) - 1)
        np.testing.assert_allclose(1e3 * volume[0, :3], centre, atol=1e-9)
        np.testing.assert_array_equal(volume[0, 3:], [0, 0, 0, 1])

    def test_times_are_seconds_since_1970(self):
        file = self.open("--layout", "fivrs")
        recorded = os.path.getmtime(self.pcap)
        for path in ("data/time", "voxels_removed/voxel_time_stamp", "burr_change/time_stamp",
                     "drill_force_feedback/time_stamp"):
            self.assertTrue(np.all(np.abs(file[path][:] - recorded) < 3600), path)

    def test_has_the_voxels_that_were_removed_and_not_given_back(self):
        file = self.open("--layout", "fivrs")
        removed = file["voxels_removed/voxel_removed"][:]
        times = file["voxels_removed/voxel_time_stamp"][:]
        expected = np.argwhere((self.at_start >= 128) & (self.at_end < 128))
        self.assertGreater(len(expected), 500)
        ijk = removed[:, 1:].astype(int)
        self.assertEqual(set(map(tuple, ijk)), set(map(tuple, expected)))
        self.assertEqual(len(ijk), len(expected), "each once")
        rows = removed[:, 0]
        np.testing.assert_array_equal(np.unique(rows), np.arange(len(times)))
        self.assertTrue(np.all(np.diff(rows) >= 0))
        self.assertTrue(np.all(np.diff(times) > 0))
        # The undone stroke, the second, is not there.
        self.assertLess(times[-1] - file["data/time"][0], 3.0)
        # A voxel is removed in the first frame after which less than half of it is left.
        began = file["data/time"][0]
        for row in (0, len(times) // 2, len(times) - 1):
            now = self.recording.bone_at(times[row] - began + 1e-5).fraction()
            before = self.recording.bone_at(times[row] - began - 1e-3).fraction()
            of_row = ijk[rows == row]
            self.assertTrue(np.all(now[tuple(of_row.T)] < 128))
            self.assertTrue(np.all(before[tuple(of_row.T)] >= 128))

    def test_tells_anatomy_by_the_colour_of_its_tissue(self):
        file = self.open("--layout", "fivrs")
        colours = file["voxels_removed/voxel_color"][:]
        removed = file["voxels_removed/voxel_removed"][:]
        np.testing.assert_array_equal(colours[:, 0], removed[:, 0])
        tissue = self.recording.bone_at(0.0).tissue()[tuple(removed[:, 1:].astype(int).T)]
        with self.open() as ours:
            rgb = {0: (255, 249, 219)}
            rgb.update(zip(ours["tissues/label"][:], map(tuple, ours["tissues/colour_rgb"][:])))
        self.assertEqual(set(tissue), {7}, "all of it is carious lesion")
        self.assertEqual(len(set(rgb.values())), len(rgb), "each tissue has a colour of its own")
        np.testing.assert_array_equal(colours[:, 1:4], [rgb[label] for label in tissue])
        self.assertTrue(np.all(colours[:, 4] == 255))

    def test_has_the_burr_from_the_start_and_every_change(self):
        file = self.open("--layout", "fivrs")
        np.testing.assert_array_equal(file["burr_change/burr_size"], [2, 3])
        self.assertEqual(file["burr_change/time_stamp"][0], file["data/time"][0])
        self.assertTrue(2.4 < file["burr_change/time_stamp"][1] - file["data/time"][0] < 3.6)

    def test_has_the_force_of_every_tick(self):
        file = self.open("--layout", "fivrs")
        force = file["drill_force_feedback"]
        self.assertEqual(len(force["time_stamp"]), len(force["wrench"]))
        self.assertTrue(np.all(np.diff(force["time_stamp"]) > 0))
        for column, name in enumerate(("force_x_n", "force_y_n", "force_z_n")):
            np.testing.assert_array_equal(force["wrench"][:, column], self.log[name])
        self.assertTrue(np.all(force["wrench"][:, 3:] == 0), "no burr of the tooth has a shank")
        np.testing.assert_allclose(np.diff(force["time_stamp"]), 1e-3, atol=1e-6)

    def test_has_exact_volumes_in_a_group_of_its_own(self):
        file = self.open("--layout", "fivrs")
        group = file["osteomill"]
        self.assertEqual({len(group[name]) for name in group}, {len(file["data/time"])})
        self.assertAlmostEqual(group["removed_mm3"][-1], self.measured["removed_mm3"]["total"], places=6)
        self.assertEqual(set(group["burr_diameter_mm"]), {2.0, 3.0})
        self.assertEqual(group["removed_mm3"].attrs["units"], "mm^3")

    def test_v3_links_into_it_from_a_folder_of_its_own(self):
        old = self.open("--layout", "fivrs-v3")
        self.assertNotIn("high_frequency_poses", old)
        with h5py.File(self.folder / "v3" / pathlib.Path(old.filename).name) as new:
            self.assertIsInstance(new.get("vision_data/continuous_data/time", getlink=True), h5py.ExternalLink)
            for ours, theirs in (("metadata_v3/voxel_volume", "metadata/voxel_volume"),
                                 ("vision_data/continuous_data/pose_mastoidectomy_drill",
                                  "data/pose_mastoidectomy_drill"),
                                 ("physics_data/intermittent_data/voxels_removed/voxel_removed",
                                  "voxels_removed/voxel_removed"),
                                 ("physics_data/intermittent_data/burr_change/burr_size", "burr_change/burr_size"),
                                 ("physics_data/intermittent_data/drill_force_feedback/wrench",
                                  "drill_force_feedback/wrench")):
                np.testing.assert_array_equal(new[ours][()], old[theirs][()])
            self.assertEqual(set(new), {"metadata_v3", "vision_data", "physics_data"})
            self.assertEqual(len(new["vision_data/intermittent_data"]), 0)
            self.assertEqual(new["physics_data/intermittent_data/voxels_removed/README"].shape, ())
            poses = new["physics_data/continuous_data/high_frequency_poses"]
            self.assertEqual(set(poses), {"mastoidectomy_drill_pose", "mastoidectomy_volume_pose"})
            drill = poses["mastoidectomy_drill_pose"]
            self.assertEqual(drill["pose"].shape, (len(self.log), 7))
            self.assertEqual(len(drill["time_stamp"]), len(self.log), "no pose twice")
            np.testing.assert_allclose(1e3 * drill["pose"][:, 0], self.log["burr_x_mm"], atol=1e-9)


class FoldersTest(unittest.TestCase):
    def test_a_recording_without_ticks_is_converted_of_its_states(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            run_server(folder, "--record", folder / "a.pcap", "--record-rate-hz", "30", "--duration-s", "0.5")
            self.assertEqual(convert(folder / "a.pcap", folder / "a.hdf5", "--layout", "fivrs").returncode, 0)
            subprocess.run([program("packet_replay"), folder / "a.pcap", "--states-csv", folder / "a.csv"], check=True)
            with h5py.File(folder / "a.hdf5") as file, open(folder / "a.csv", newline="") as states:
                times = {row["time_s"] for row in csv.DictReader(states)}
                self.assertEqual(len(file["drill_force_feedback/wrench"]), len(times))
                self.assertEqual(len(file["voxels_removed/voxel_time_stamp"]), 0)


if __name__ == "__main__":
    unittest.main()
