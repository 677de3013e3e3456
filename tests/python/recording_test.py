"""Recordings from Python: the arrays are the session's, and its bone is there at any instant."""

import csv
import json
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
from support import plunge, program, tooth

import osteomill as om


class RecordingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.file = pathlib.Path(cls.folder.name) / "session.pcap"
        with om.Session(tooth(), record=cls.file) as session:
            cls.ticks = session.rollout(plunge(tooth(), 2500, 4.0), pedals=True)
            cls.bone = session.bone.fraction()
            cls.checksum = session.bone.checksum()

    def test_of_a_session_is_what_its_ticks_knew(self):
        alone = om.Session(tooth())
        alone.rollout(plunge(tooth(), 2500, 4.0), pedals=True)
        self.assertEqual(self.checksum, alone.bone.checksum())
        with om.Recording(self.file) as recording:
            at = np.rint(recording.session_time_s * 1000).astype(int)
            self.assertGreaterEqual(len(at), 70)  # thirty a second
            told = at > 0
            for name in ("hand_mm", "burr_mm", "force_n"):
                np.testing.assert_allclose(getattr(recording, name)[told], self.ticks[name][at[told] - 1], atol=1e-4)
            self.assertEqual(recording.time_s.shape, recording.depth_mm.shape)
            self.assertEqual(recording.axis.shape, (len(at), 3))
            np.testing.assert_array_equal(recording.spindle_on[told], self.ticks["spindle_on"][at[told] - 1])
            self.assertGreater(self.ticks["removed_mm3"]["total"][-1], 0.5)

    def test_has_the_bone_at_any_instant(self):
        with om.Recording(self.file) as recording:
            end = recording.bone_at(1e9)
            self.assertEqual(end.checksum(), self.checksum)
            self.assertTrue(np.array_equal(end.fraction(), self.bone))
            self.assertEqual(recording.bone_at(0.0).checksum(), tooth().bone.checksum())
            middle = recording.bone_at(2.0)
            self.assertTrue(end.volume_mm3 < middle.volume_mm3 < tooth().bone.volume_mm3)
            last = np.flatnonzero(recording.time_s <= 2.0)[-1]
            self.assertAlmostEqual(tooth().bone.volume_mm3 - middle.volume_mm3, recording.removed_mm3[last], delta=0.02)
            with self.assertRaisesRegex(ValueError, "no CT numbers"):
                middle.hu()
            with self.assertRaisesRegex(ValueError, "time_s: takes seconds"):
                recording.bone_at(-1.0)

    def test_has_the_metrics_of_the_report(self):
        with om.Recording(self.file) as recording, tempfile.TemporaryDirectory() as folder:
            subprocess.run([program("packet_replay"), self.file, "--report", folder, "--json", f"{folder}/info.json"],
                           check=True, capture_output=True)
            report = json.loads((pathlib.Path(folder) / "metrics.json").read_text())
            self.assertEqual(recording.metrics(), report["metrics"])
            settings = report["session"]["settings"]
            self.assertEqual((settings["coupling"], settings["device"], settings["clock"]), ("implicit", "prescribed", "virtual"))
            self.assertEqual(recording.info(), json.loads((pathlib.Path(folder) / "info.json").read_text()))
            self.assertAlmostEqual(recording.metrics()["peak_force_n"], np.linalg.norm(self.ticks["force_n"], axis=1).max(), delta=1e-4)
            self.assertEqual(recording.info()["bone_checksum"], self.checksum)

    def test_is_the_table_that_packet_replay_writes(self):
        with om.Recording(self.file) as recording, tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder) / "table.csv"
            subprocess.run([program("packet_replay"), self.file, "--states-csv", table], check=True, capture_output=True)
            rows = list(csv.DictReader(table.read_text().splitlines()))
            self.assertEqual([row["time_s"] for row in rows], [f"{t:.4f}" for t in recording.time_s])
            self.assertEqual([row["force_z_n"] for row in rows], [f"{f:.5f}" for f in recording.force_n[:, 2]])

    def test_that_is_none_is_said_in_one_line(self):
        for file in (pathlib.Path(__file__), pathlib.Path("nowhere.pcap")):
            with self.assertRaisesRegex(RuntimeError, file.name) as raised:
                om.Recording(file)
            self.assertNotIn("\n", str(raised.exception))

    def test_that_is_torn_is_read_as_far_as_it_goes(self):
        torn = self.file.with_name("torn.pcap")
        whole = self.file.read_bytes()
        torn.write_bytes(whole[: len(whole) - 500])
        with om.Recording(torn) as recording, om.Recording(self.file) as complete:
            n = len(recording.time_s)
            self.assertTrue(0 < n <= len(complete.time_s))
            np.testing.assert_array_equal(recording.force_n, complete.force_n[:n])

    def test_cannot_go_back(self):
        with om.Session(tooth(), record=self.file.with_name("other.pcap")) as session:
            with self.assertRaisesRegex(ValueError, "is recorded"):
                session.load_state(session.save_state())


if __name__ == "__main__":
    unittest.main()
