"""Sessions from Python: equal to haptic_server's to the bit, however they are stepped, in threads, and back to a state."""

import os
import pathlib
import pickle
import signal
import tempfile
import threading
import unittest

import numpy as np
from support import plunge, run_server, tooth

import osteomill as om


class SessionTest(unittest.TestCase):
    def test_is_the_servers_to_the_bit(self):
        for coupling in ("implicit", "hold"):
            with tempfile.TemporaryDirectory() as folder:
                measured, log, lines, _ = run_server(
                    pathlib.Path(folder), "--duration-s", "3.5", "--coupling", coupling, "--grip", "light")
            session = om.Session(tooth(), hand="light", coupling=coupling)
            out = session.run(3500)
            self.assertEqual(session.bone.checksum(), measured["bone_checksum"])
            self.assertEqual(np.linalg.norm(out["force_n"], axis=1).max(), measured["peak_force_n"])
            self.assertEqual(out["removed_mm3"]["carious lesion"][-1], measured["removed_mm3"]["carious lesion"])
            self.assertEqual(session.milling_rate_hz, measured["milling_rate_hz"])
            # Tick by tick, to the digits that the log has. Its first line is the tick that is made with a session.
            self.assertEqual(len(log), 3501)
            self.assertGreater(out["removed_mm3"]["total"][-1], 0.1)
            for column, values in (("force_x_n", out["force_n"][:, 0]), ("burr_z_mm", out["burr_mm"][:, 2]),
                                   ("hand_y_mm", out["hand_mm"][:, 1]), ("depth_mm", out["depth_mm"])):
                at = lines[0].split(",").index(column)
                digits = len(lines[1].split(",")[at].partition(".")[2])
                self.assertEqual([line.split(",")[at] for line in lines[2:]],
                                 [f"{value:.{digits}f}" for value in values], column)

    def test_a_rollout_is_its_steps(self):
        hands = plunge(tooth(), 1000, 3.0)
        whole, stepped = om.Session(tooth()), om.Session(tooth())
        out = whole.rollout(hands, pedals=True)
        for i, hand in enumerate(hands):
            step = stepped.step(hand_mm=hand, pedal=True)
            for name in ("force_n", "burr_mm", "hand_mm", "axis", "milling_force_n", "torque_nmm"):
                np.testing.assert_array_equal(getattr(step, name), out[name][i])
            self.assertEqual(step.time_s, out["time_s"][i])
            for kind in ("removed_mm3", "distance_mm"):
                self.assertEqual(getattr(step, kind), {name: column[i] for name, column in out[kind].items()})
        self.assertEqual(stepped.bone.checksum(), whole.bone.checksum())
        self.assertGreater(out["removed_mm3"]["total"][-1], 0.1)
        self.assertTrue(out["spindle_on"].any() and out["spindle_on"].dtype == bool)
        self.assertEqual(step.fault, "")

    def test_counts_the_bone_that_is_missing(self):
        session = om.Session(tooth())
        out = session.rollout(plunge(tooth(), 2500, 3.0), pedals=np.ones(2500, bool))
        missing = tooth().bone.volume_mm3 - session.bone.volume_mm3
        self.assertAlmostEqual(out["removed_mm3"]["total"][-1], missing, delta=1e-6)
        self.assertAlmostEqual(sum(column[-1] for name, column in out["removed_mm3"].items() if name != "total"), missing,
                               delta=1e-6)

    def test_distances_shrink_by_what_the_burr_moves_towards_a_structure(self):
        session = om.Session(tooth())
        out = session.rollout(plunge(tooth(), 4000, 5.0), pedals=True)
        pulp, burr = out["distance_mm"]["pulp"], out["burr_mm"]
        near = np.isfinite(pulp)
        self.assertTrue(near.any() and not near.all())
        moved = np.linalg.norm(burr[near] - burr[near][0], axis=1)
        self.assertTrue((np.abs(pulp[near] - pulp[near][0]) <= moved + 0.1).all())  # a voxel of its table
        self.assertLess(pulp[near][-1], pulp[near][0])

    def test_sessions_in_threads_are_as_they_are_alone(self):
        hands = plunge(tooth(), 1000, 3.0)
        alone = om.Session(tooth())
        alone.rollout(hands, pedals=True)
        sessions = [om.Session(tooth()) for _ in range(4)]
        threads = [threading.Thread(target=session.rollout, args=(hands, None, True)) for session in sessions]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual({session.bone.checksum() for session in sessions}, {alone.bone.checksum()})
        self.assertNotEqual(alone.bone.checksum(), tooth().bone.checksum())

    def test_leaves_the_interpreter_to_others_and_belongs_to_one_thread(self):
        session = om.Session(tooth())
        refused = False
        while not refused:  # until the two meet, which they do only if a rollout lets go of the interpreter
            thread = threading.Thread(target=session.rollout, args=(np.tile(tooth().start_mm, (2000, 1)),))
            thread.start()
            while thread.is_alive() and not refused:
                try:
                    session.save_state()
                except RuntimeError as error:
                    self.assertIn("another thread", str(error))
                    refused = True
            thread.join()
        self.assertEqual(session.save_state().ticks % 2000, 0)

    def test_goes_back_to_a_state(self):
        hands = plunge(tooth(), 1000, 4.0)
        session = om.Session(tooth())
        session.rollout(hands[:800], pedals=True)
        state = pickle.loads(pickle.dumps(session.save_state()))
        self.assertEqual(state.ticks, 800)
        checksum = session.bone.checksum()
        self.assertNotEqual(checksum, tooth().bone.checksum())
        first = session.rollout(hands[800:], pedals=True)
        for other in (session, om.Session(tooth())):
            other.load_state(state)
            self.assertEqual(other.bone.checksum(), checksum)
            again = other.rollout(hands[800:], pedals=True)
            np.testing.assert_array_equal(again["force_n"], first["force_n"])
            np.testing.assert_array_equal(again["removed_mm3"]["total"], first["removed_mm3"]["total"])
        with self.assertRaisesRegex(ValueError, "of other settings; .*coupling"):
            om.Session(tooth(), coupling="hold").load_state(state)

    def test_changes_the_burr_away_from_bone(self):
        session = om.Session(tooth(), start_mm=tooth().start_mm + [0.0, 0.0, 5.0])
        step = session.step(burr="3 mm", ms=50)
        self.assertEqual(tooth().burrs[step.burr].diameter_mm, 3.0)
        with self.assertRaisesRegex(ValueError, "none of Case.burrs"):
            session.step(burr="9 mm")

    def test_says_what_is_wrong_in_one_line(self):
        session = om.Session(tooth())
        simulated = om.Session(tooth(), hand="firm")
        for wrong, line in (
                (lambda: session.step(hand_mm=[0, 1]), r"hand_mm: takes three finite numbers, not \[0, 1\]"),
                (lambda: session.step(hand_mm=[0, 1, float("nan")]), "hand_mm: takes three finite"),
                (lambda: session.step(axis=[0, 0, 0]), "axis: an axis of length 0"),
                (lambda: session.step(ms=0), "ms: takes whole milliseconds"),
                (lambda: session.run(10**18), "ms: takes whole milliseconds"),
                (lambda: session.step(hand_mm=[1e7, 0, 0]), "hand_mm: lies more than 10000 mm"),
                (lambda: session.rollout(np.full((4, 3), 1e7)), "hands: row 0 lies more than 10000 mm"),
                (lambda: om.Session(tooth(), record=""), "record: is empty"),
                (lambda: session.rollout(np.zeros((4, 2))), r"hands: takes an array \(4, 3\), not \(4, 2\)"),
                (lambda: session.rollout(np.full((4, 3), np.inf)), "hands: row 0 is not finite"),
                (lambda: session.rollout(np.zeros((4, 3)), axes=np.zeros((3, 3))), r"axes: takes an array \(4, 3\)"),
                (lambda: session.rollout(np.zeros((4, 3)), pedals=[True]), "pedals: takes one flag"),
                (lambda: simulated.rollout(np.zeros((4, 3))), "the simulated hand goes its own way"),
                (lambda: om.Session(tooth(), hand="heavy"), 'hand: "heavy" is none'),
                (lambda: om.Session(tooth(), coupling="glue"), "glue"),
                (lambda: om.Session(tooth(), milling_rate_hz=1.0), "milling rate"),
                (lambda: om.Case("teeth"), "tooth"),
                (lambda: om.Case("tooth", set=["wall_frction=0.3"]), "wall_friction")):
            with self.assertRaisesRegex((ValueError, RuntimeError), line) as raised:
                wrong()
            self.assertNotIn("\n", str(raised.exception))

    def test_a_recording_is_none_of_the_files_of_the_case(self):
        with tempfile.TemporaryDirectory() as folder:
            bone = os.path.join(folder, "bone.nrrd")
            run_server(pathlib.Path(folder), "--save-bone", bone, "--duration-s", "0.01")
            scene = os.path.join(folder, "case.toml")
            pathlib.Path(scene).write_text('name = "x"\n[bone]\nfile = "bone.nrrd"\n')
            kept = [pathlib.Path(file).read_bytes() for file in (bone, scene)]
            os.symlink(folder, os.path.join(folder, "link"))
            os.symlink("nowhere.pcap", os.path.join(folder, "dangling.pcap"))
            os.symlink("bone.nrrd", os.path.join(folder, "bone.pcap"))
            os.link(scene, os.path.join(folder, "scene.pcap"))
            case = om.Case(folder)
            for record in ("bone.pcap", "scene.pcap", os.path.join("link", "bone.pcap")):
                with self.assertRaisesRegex(ValueError, "the recording are the same file"):
                    om.Session(case, record=os.path.join(folder, record))
            with self.assertRaisesRegex(om.BadInput, "takes the name of a pcap file"):
                om.Session(case, record=bone)
            with self.assertRaisesRegex(ValueError, "is a link to .*nowhere.pcap"):
                om.Session(case, record=os.path.join(folder, "dangling.pcap"))
            self.assertEqual(kept, [pathlib.Path(file).read_bytes() for file in (bone, scene)])

    def test_a_signal_ends_a_long_step(self):
        session = om.Session(tooth())
        for work in (lambda: session.step(ms=10**8), lambda: session.run(10**8),
                     lambda: session.rollout(np.tile(session.now.hand_mm, (10**6, 1)))):
            threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
            with self.assertRaises(KeyboardInterrupt):
                work()
        self.assertGreater(session.step().time_s, 0.0)

    def test_belongs_to_the_process_that_made_it(self):
        with tempfile.TemporaryDirectory() as folder:
            session = om.Session(tooth(), record=os.path.join(folder, "a.pcap"))
            session.step(ms=10)
            child = os.fork()
            if child == 0:
                try:
                    session.step()
                except RuntimeError:
                    del session
                    os._exit(7)
                os._exit(1)
            self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 7)
            session.step(ms=10)
            session.close()
            self.assertTrue(os.path.exists(os.path.join(folder, "a.pcap")))

    def test_says_where_a_recording_lies_that_cannot_have_its_name(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.pcap")
            session = om.Session(tooth(), record=file)
            session.step(ms=10)
            os.mkdir(file)
            with self.assertRaisesRegex(om.Fault, "Is a directory; what there is lies in .*a.part.pcap, which packet_replay reads"):
                session.close()

    def test_ends_once_it_is_closed(self):
        with om.Session(tooth()) as session:
            session.step()
        with self.assertRaisesRegex(RuntimeError, "has ended"):
            session.step()

    def test_takes_changes_of_the_scene(self):
        case = om.Case("tooth", set=["wall_friction=0.0"], burr="3 mm", rpm=10000)
        self.assertEqual(case.burrs[case.start_burr].diameter_mm, 3.0)
        self.assertEqual({burr.rpm for burr in case.burrs}, {10000.0})


if __name__ == "__main__":
    unittest.main()
