"""Copies of sessions: each goes on as the other would, to the bit, and costs the bone that was touched."""

import concurrent.futures
import copy
import os
import pathlib
import tempfile
import unittest

import numpy as np
from support import plunge, tooth

import osteomill as om


def resident_bytes():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def circle(start_mm, ms, pace=1.0):
    angle = pace * 2 * np.pi * np.arange(1, ms + 1) / 1000.0
    return start_mm + np.column_stack([0.6 * np.sin(angle), 0.6 * (1.0 - np.cos(angle)), -0.0004 * np.arange(1, ms + 1)])


class CopyTest(unittest.TestCase):
    def expect_same(self, one, other):
        self.assertEqual(one.keys(), other.keys())
        for name, column in one.items():
            if isinstance(column, dict):
                self.expect_same(column, other[name])
            else:
                np.testing.assert_array_equal(column, other[name], name)

    def expect_goes_on_alike(self, session, move):
        checksum, step = session.bone.checksum(), session.now
        other = session.copy()
        self.assertIsInstance(other, om.Session)
        self.assertEqual(other.now, step)
        self.assertEqual(other.bone.checksum(), checksum)
        first = move(other)
        self.assertEqual((session.now, session.bone.checksum()), (step, checksum), "the copy disturbed it")
        self.assertNotEqual(other.bone.checksum(), checksum, "nothing was milled")
        self.expect_same(move(session), first)
        self.assertEqual(session.bone.checksum(), other.bone.checksum())
        self.assertEqual(session.now, other.now)
        self.assertEqual(session.save_state().ticks, other.save_state().ticks)

    def test_goes_on_alike_with_every_coupling(self):
        hands = plunge(tooth(), 900, 4.0)
        for coupling in ("implicit", "hold", "interpolate+damper", "corrected-sample-estimate-hold", "sample-estimate-interpolate+passivity",
                         "virtual-coupling", "passivity", "damper"):
            with self.subTest(coupling=coupling):
                session = om.Session(tooth(), coupling=coupling, vibration=True)
                session.rollout(hands, pedals=True)
                self.expect_goes_on_alike(session, lambda one: one.rollout(circle(hands[-1], 300), pedals=True))

    def test_goes_on_alike_with_every_force_model(self):
        hands = plunge(tooth(), 900, 4.0)
        for model in ("published", "milling-partial", "milling-bins", "milling-instants", "milling-scan", "point-spring", "petersik", "morris",
                      "agus"):
            with self.subTest(model=model):
                session = om.Session(tooth(), force_model=model)
                session.rollout(hands, pedals=True)
                self.expect_goes_on_alike(session, lambda one: one.rollout(circle(hands[-1], 300), pedals=True))

    def test_goes_on_alike_in_the_middle_of_a_milling_period(self):
        session = om.Session(tooth(), milling_rate_hz=300.0, coupling="interpolate")
        hands = plunge(tooth(), 901, 4.0)
        session.rollout(hands, pedals=True)
        self.expect_goes_on_alike(session, lambda one: one.rollout(circle(hands[-1], 301), pedals=True))

    def test_goes_on_alike_with_a_simulated_hand_and_another_arm(self):
        for arm in (None, om.Arm(mass_kg=2.0, max_force_n=30.0, stiffness_n_per_mm=5.0, delay_ms=2)):
            session = om.Session(tooth(), hand="firm", arm=arm)
            session.run(2500)
            self.expect_goes_on_alike(session, lambda one: one.run(400))

    def test_goes_on_alike_while_a_burr_is_changed(self):
        session = om.Session(tooth(), start_mm=tooth().start_mm + [0.0, 0.0, 1.0])
        session.rollout(plunge(tooth(), 50, 0.2) + [0.0, 0.0, 1.0], pedals=True, burr="3 mm")  # waits for the spindle
        other = session.copy()
        at = session.now.hand_mm
        for one in (session, other):
            one.rollout(np.tile(at, (100, 1)), pedals=False)
            one.rollout(at + np.linspace(0.0, 4.0, 900)[:, None] * [0.0, 0.0, -1.0], pedals=True)
        self.assertEqual(tooth().burrs[session.now.burr].diameter_mm, 3.0)
        self.assertEqual(session.now, other.now)
        self.assertEqual(session.bone.checksum(), other.bone.checksum())
        self.assertGreater(session.now.removed_mm3["total"], 0.0)

    def test_a_copy_of_a_recorded_session_is_not_recorded_and_the_recording_stays_whole(self):
        hands = plunge(tooth(), 900, 4.0)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.pcap"
            with om.Session(tooth(), record=file) as session:
                session.rollout(hands, pedals=True)
                self.expect_goes_on_alike(session, lambda one: one.rollout(circle(hands[-1], 300), pedals=True))
                state = session.save_state()
                session.copy().load_state(state)  # a recorded one would refuse
            self.assertEqual(om.Recording(file).ticks["time_s"].shape, (1201,))
            self.assertTrue(om.repeat(file).is_equal)
            with self.assertRaisesRegex(om.Fault, "has ended"):
                session.copy()

    def test_pythons_own_copies_are_copies(self):
        session = om.Session(tooth())
        session.rollout(plunge(tooth(), 900, 4.0), pedals=True)
        for other in (copy.copy(session), copy.deepcopy(session)):
            self.assertEqual(other.now, session.now)
            other.step(ms=5)
            self.assertNotEqual(other.now, session.now)

    def test_a_hundred_branches_cost_the_bone_that_they_touched(self):
        session = om.Session(tooth())
        hands = np.concatenate([plunge(tooth(), 1000, 3.0), circle(plunge(tooth(), 1000, 3.0)[-1], 3000)])
        session.rollout(hands, pedals=True)
        whole = session.bone.shape
        before = resident_bytes()
        branches = [session.copy() for _ in range(100)]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            list(pool.map(lambda item: item[1].rollout(circle(hands[-1], 100, 0.5 + 0.01 * item[0]), pedals=True), enumerate(branches)))
        self.assertEqual(len({branch.bone.checksum() for branch in branches}), 100, "each went its own way")
        self.assertLess(resident_bytes() - before, 200_000_000, whole)


if __name__ == "__main__":
    unittest.main()
