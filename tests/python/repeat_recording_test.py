"""Recordings of any session repeat to the bit: they hold the values that were used."""

import functools
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np
from support import FolderTest, program, tooth

import osteomill as om

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]


def wandering_hand(case, ms, seed):
    """A hand that trembles and tilts: no coordinate of it has few digits."""
    rng = np.random.default_rng(seed)
    hands = case.start_mm - np.linspace(0.0, 4.0, ms)[:, None] * case.start_axis + np.cumsum(rng.normal(0, 0.002, (ms, 3)), 0)
    axes = case.start_axis + np.cumsum(rng.normal(0, 0.0005, (ms, 3)), 0)
    return hands, axes, rng.random(ms) > 0.05


def serve(*arguments):
    subprocess.run([program("haptic_server"), *map(str, arguments)], check=True, capture_output=True, timeout=300)


@functools.cache
def plain_session():
    """A recording of the tooth that nobody controls, and its bone in the end."""
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    file, bone = pathlib.Path(folder.name) / "plain.pcap", pathlib.Path(folder.name) / "carved.nrrd"
    serve("--clock", "virtual", "--duration-s", "4", "--record", file, "--save-bone", bone)
    return file, bone


class RepeatRecordingTest(FolderTest):
    def record(self, name, ms=1500, seed=0, **session):
        hands, axes, pedals = wandering_hand(tooth(), ms, seed)
        file = self.folder / name
        with om.Session(tooth(), record=file, **session) as made:
            ticks = made.rollout(hands, axes, pedals)
            self.assertGreater(ticks["removed_mm3"]["total"][-1], 0.1)
            return file, ticks, made.bone.checksum()

    def assert_repeats(self, file, least_ticks):
        result = om.repeat(file)
        self.assertTrue(result.is_equal, result.line)
        self.assertTrue(str(result).startswith("equal to the bit: "), result.line)
        self.assertGreaterEqual(result.ticks, least_ticks)

    def test_a_session_of_python(self):
        for coupling, model in (("implicit", "milling"), ("hold+damper", "milling"), ("interpolate", "petersik")):
            file, _, _ = self.record(f"{model}-{coupling}.pcap", coupling=coupling, force_model=model, vibration=model == "milling")
            self.assert_repeats(file, 1501)

    def test_what_ticks_say_fed_again_gives_the_same(self):
        file, ticks, checksum = self.record("a.pcap")
        told = om.Recording(file).ticks
        self.assertEqual(len(told["time_s"]), 1501)
        session = om.Session(tooth())
        again = session.rollout(told["hand_mm"][1:], told["axis"][1:], told["pedal"][1:])
        self.assertEqual(session.bone.checksum(), checksum)
        for name in ("hand_mm", "burr_mm", "axis", "force_n", "milling_force_n"):
            np.testing.assert_array_equal(again[name], ticks[name], name)
        np.testing.assert_allclose(told["removed_mm3"][1:], ticks["removed_mm3"]["total"], atol=5.1e-6)

    def test_a_recorded_motion_on_rails(self):
        file, _, _ = self.record("a.pcap")
        subprocess.run([program("packet_replay"), file, "--trajectory", self.folder / "a.csv"], check=True, capture_output=True)
        serve("--clock", "virtual", "--trajectory", self.folder / "a.csv", "--grip", "rails", "--record", self.folder / "b.pcap",
                   "--duration-s", "1.5")
        first, second = om.Recording(file).ticks, om.Recording(self.folder / "b.pcap").ticks
        for name in ("hand_mm", "burr_mm", "axis", "force_n", "removed_mm3"):
            # A trajectory ends with the pedal up.
            np.testing.assert_array_equal(second[name][:-1], first[name][:-1], name)
        self.assert_repeats(self.folder / "b.pcap", 1501)

    def test_a_simulated_hand_with_settings_of_its_own(self):
        file = self.folder / "s.pcap"
        serve("--clock", "virtual", "--scene", "tooth", "--set", "wall_friction=0.35", "--set", "device.scale=0.5",
                   "--grip", "light", "--rpm", "20000", "--duration-s", "3", "--record", file)
        self.assert_repeats(file, 3001)

    def test_a_bone_that_was_carved_before(self):
        _, carved = plain_session()
        serve("--clock", "virtual", "--scene", "tooth", "--bone", carved, "--duration-s", "4",
                   "--record", self.folder / "c.pcap")
        self.assert_repeats(self.folder / "c.pcap", 4001)

    def controlled(self, lines):
        """Arguments for a session with a slow zone, and a guide that is off, under these controls."""
        (self.folder / "case.toml").write_text(
            (REPOSITORY / "scenes/tooth.toml").read_text() + '\n[[fixture]]\nname = "Slowly"\nkind = "slow"\ntissue = "pulp"\ndistance_mm = 9\n'
            '[[fixture]]\nname = "Aside"\nkind = "guide"\non = false\nradius_mm = 0\n'
            "plane = { at_mm = [0.4, 0, 0], normal = [1, 0, 0] }\n")
        (self.folder / "controls.csv").write_text("t_s,action,text\n" + lines)
        return "--scene", self.folder / "case.toml", "--controls", self.folder / "controls.csv"

    def events(self, file):
        folder = self.folder / f"{file.stem}-report"
        subprocess.run([program("packet_replay"), file, "--report", folder], check=True, capture_output=True)
        events = json.loads((folder / "metrics.json").read_text())["events"]
        return [(event["action"], event["text"], event["is_refused"]) for event in events]

    SWITCHED = "1.5,pause,\n1.6,fixture,Slowly=off\n1.6,fixture,Aside=on\n1.6,resume,\n2.5,pause,\n2.7,resume,\n"

    def test_a_session_that_was_paused_and_whose_fixtures_were_switched(self):
        file = self.folder / "switched.pcap"
        serve(*self.controlled(self.SWITCHED), "--clock", "virtual", "--duration-s", "4", "--record", file)
        self.assertEqual([event for event in self.events(file) if event[0] == "fixture"],
                         [("fixture", "Slowly: off", False), ("fixture", "Aside: on", False)])
        self.assert_repeats(file, 4001)
        plain = self.folder / "plain.pcap"
        serve(*self.controlled("1.5,pause,\n1.6,resume,\n2.5,pause,\n2.7,resume,\n"), "--clock", "virtual",
                   "--duration-s", "4", "--record", plain)
        self.assert_repeats(plain, 4001)
        felt, unfelt = (om.Recording(one).ticks["force_n"] for one in (file, plain))
        np.testing.assert_array_equal(felt[:1600], unfelt[:1600])
        self.assertGreater(np.abs(felt[1700:] - unfelt[1700:]).max(), 0.01)

    def controls_of(self, file):
        """Columns of its ticks that say how it was controlled."""
        om.Recording(file).to_hdf5(file.with_suffix(".h5"))
        with h5py.File(file.with_suffix(".h5")) as made:
            return {name: made[f"ticks/{name}"][()] for name in ("chosen_rpm", "is_placed", "restored_bricks", "holds_still")}

    def test_a_session_at_another_speed_of_the_spindle(self):
        file, (plain, _) = self.folder / "fast.pcap", plain_session()
        serve(*self.controlled("1.5,speed,23456.7\n3,speed,0\n"), "--clock", "virtual", "--duration-s", "4", "--record", file)
        self.assertEqual(set(self.controls_of(file)["chosen_rpm"]), {0, 23457})
        self.assert_repeats(file, 4001)
        self.assertGreater(np.abs(om.Recording(file).ticks["force_n"] - om.Recording(plain).ticks["force_n"]).max(), 0.01)

    def test_a_session_that_was_undone(self):
        for name, lasts_s, lines in (("paused", 4, "2.9,pause,\n3.1,undo,\n3.2,resume,\n"),
                                     ("at-once", 6, "3.3,undo,\n4.5,undo,\n5,redo,\n"),
                                     ("all-of-it", 8, "4,reset,\n5.5,undo,\n6.2,reset,\n6.9,redo,\n")):
            with self.subTest(name):
                file = self.folder / f"{name}.pcap"
                serve(*self.controlled(lines), "--clock", "virtual", "--duration-s", lasts_s, "--record", file)
                controls = self.controls_of(file)
                self.assertGreater(controls["restored_bricks"].sum(), 0, self.events(file))
                self.assert_repeats(file, 1000 * lasts_s + 1)

    def test_an_arm_lifted_out_of_the_bone_that_came_back(self):
        socket = self.folder / "arm.socket"
        self.start_arm(socket)
        scene = (REPOSITORY / "scenes/cube.toml").read_text()
        (self.folder / "cube.toml").write_text(scene.replace("position_mm = [-20.0, 0.0, 4.0]", "position_mm = [0.0, 0.0, 4.0]"))
        (self.folder / "undo.csv").write_text("t_s,action,text\n6,pause,\n6.2,undo,\n6.8,resume,\n")
        for _ in range(3):
            file = self.serve_until_it_repeats("--scene", self.folder / "cube.toml", "--device", "bridge", "--bridge", f"unix:{socket}",
                                               "--controls", self.folder / "undo.csv", seconds=8)
            controls = self.controls_of(file)
            if controls["is_placed"].sum() == 1 and controls["restored_bricks"].sum() > 0:
                return
        self.skipTest("the arm is late on so busy a machine: nothing to undo, or it had left the bone by then")

    def test_a_fixture_is_switched_only_while_the_session_is_paused(self):
        file = self.folder / "refused.pcap"
        serve(*self.controlled("0.5,fixture,Slowly=off\n0.6,pause,\n0.7,fixture,Slow=off\n0.8,resume,\n"),
                   "--clock", "virtual", "--duration-s", "1", "--record", file)
        refused = [event[1] for event in self.events(file) if event[2]]
        self.assertEqual(refused, ["pause the session first",
                                   'the session has no fixture "Slow"; it has "Slowly", "Aside"'])
        self.assert_repeats(file, 1001)

    def test_a_paused_session_of_the_real_clock(self):
        self.serve_until_it_repeats(*self.controlled(self.SWITCHED))

    def serve_until_it_repeats(self, *arguments, seconds=4):
        """On a busy machine a loop may stand still for longer than a tick can tell of: again, then."""
        for attempt in range(10):
            file = self.folder / f"r{attempt}.pcap"
            scene = () if "--scene" in arguments else ("--scene", "tooth")
            serve(*scene, "--listen", "none", "--duration-s", seconds, "--record", file, *arguments)
            if "which milling steps" not in om.repeat(file).line:
                self.assert_repeats(file, 100)
                return file
        return self.skipTest("the machine is too busy for a session of the real clock")

    def test_a_session_of_the_real_clock(self):
        self.serve_until_it_repeats()

    def start_arm(self, socket):
        self.started(sys.executable, REPOSITORY / "bridge/examples/simulated_arm.py", f"unix:{socket}",
                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def test_an_arm_behind_the_bridge(self):
        socket = self.folder / "arm.socket"
        self.start_arm(socket)
        self.serve_until_it_repeats("--device", "bridge", "--bridge", f"unix:{socket}")

    def test_a_trainee_at_the_window(self):
        for needed in ("Xvfb", "xdotool"):
            if shutil.which(needed) is None:
                self.skipTest(f"{needed} is not installed")
        for attempt in range(5):  # a busy machine: see serve_until_it_repeats
            file = self.folder / f"w{attempt}.pcap"
            self.drill_by_keys(file)
            if "which milling steps" not in om.repeat(file).line:
                self.assertGreater(om.Recording(file).ticks["removed_mm3"][-1], 0.0)
                return self.assert_repeats(file, 1000)
        return self.skipTest("the machine is too busy for a session of the real clock")

    def started(self, *command, **more):
        process = subprocess.Popen([*map(str, command)], text=True, **more)
        if process.stdout is not None:
            self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def drill_by_keys(self, file):
        """A session in a real window, drilled with held keys until bone is gone."""
        display = self.started("Xvfb", "-displayfd", "1", "-screen", "0", "480x360x24", "-nolisten", "tcp",
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        shown = dict(os.environ, DISPLAY=":" + display.stdout.readline().strip(), HOME=str(self.folder))
        shown.pop("WAYLAND_DISPLAY", None)
        log = self.folder / f"{file.stem}.log"
        with log.open("w") as errors:
            server = self.started(program("haptic_server"), "--scene", "tooth", "--device", "client", "--listen", "127.0.0.1:0",
                                  "--record", file, stdout=subprocess.PIPE, stderr=errors)
        address = next(line.split()[-1] for line in server.stdout if line.startswith("listening on "))
        window = self.started(program("render_client"), "--connect", address, "--window-size", "480x360", "--home", self.folder,
                              env=shown, stderr=subprocess.DEVNULL)

        def keys(*arguments):
            subprocess.run(["xdotool", *arguments], env=shown, check=True, capture_output=True, timeout=300)

        keys("search", "--sync", "--onlyvisible", "--name", "^Osteomill$", "windowfocus")
        late = time.monotonic() + 300.0
        while not re.search(r"removed +(?!0\.0+ )\d", log.read_text()) and time.monotonic() < late:
            keys("keydown", "space", "keydown", "w")
            time.sleep(6.0)  # its log has a line every five seconds
            keys("keyup", "w", "keyup", "space")
            time.sleep(1.0)  # a pedal that was held before there was a bone turns nothing until it was seen up
        server.send_signal(signal.SIGINT)
        server.stdout.read()
        self.assertEqual(server.wait(), 0, log.read_text())
        window.terminate()

    def test_says_what_cannot_be_repeated(self):
        old = om.repeat(REPOSITORY / "tests/golden/0.3/recording.pcap")
        self.assertFalse(old.is_equal)
        self.assertIn("repeats to 0.1 um only", old.line)
        serve("--clock", "virtual", "--coupling", "hold+damper", "--duration-s", "1", "--record", self.folder / "damped.pcap")
        self.assertIn("takes the arm's own velocity", om.repeat(self.folder / "damped.pcap").line)
        with self.assertRaisesRegex(om.Fault, "nowhere.pcap"):
            om.repeat("nowhere.pcap")

    def test_a_command_says_it(self):
        file, _, _ = self.record("a.pcap", ms=200)
        done = subprocess.run([program("osteomill_study"), "repeat", file], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("equal to the bit: 201 ticks", done.stdout)


if __name__ == "__main__":
    unittest.main()
