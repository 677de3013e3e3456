"""User-defined arms: force, stiffness and delay are theirs; torque and power of the spindle are those of the cut."""

import pathlib
import pickle
import tempfile
import unittest

import numpy as np
from support import plunge, tooth

import osteomill as om

ROBOT = {"mass_kg": 3.0, "stiffness_n_per_mm": 20.0, "max_force_n": 60.0, "friction_n": 0.0, "resolution_mm": 0.0}


def press(arm, depth_mm=8.0):
    """The hand pushes a burr that stands still against the tooth."""
    session = om.Session(tooth(), arm=arm)
    return session.rollout(plunge(tooth(), 1500, depth_mm), pedals=False)


class ArmTest(unittest.TestCase):
    def test_the_force_is_within_the_arms_limit(self):
        usual, robot = press(None), press(om.Arm(**ROBOT))
        self.assertAlmostEqual(np.linalg.norm(usual["force_n"], axis=1).max(), 3.3, delta=0.01)
        strongest = np.linalg.norm(robot["force_n"], axis=1).max()
        self.assertGreater(strongest, 5.0)
        self.assertLessEqual(strongest, 60.0 + 1e-9)
        weak = press(om.Arm(max_force_n=1.0))
        self.assertAlmostEqual(np.linalg.norm(weak["force_n"], axis=1).max(), 1.0, delta=0.01)

    def test_a_stiffer_arm_yields_less(self):
        def yields_mm(arm):
            out = press(arm, 4.0)
            pressed = np.linalg.norm(out["force_n"], axis=1) > 0.5
            return (np.linalg.norm(out["hand_mm"] - out["burr_mm"], axis=1)[pressed] / np.linalg.norm(out["force_n"], axis=1)[pressed])[-1]

        soft, stiff = om.Arm(max_force_n=30.0, stiffness_n_per_mm=1.0, resolution_mm=0.0), om.Arm(**ROBOT)
        self.assertAlmostEqual(yields_mm(soft) * soft.rendered_stiffness_n_per_mm, 1.0, delta=0.1)
        self.assertGreater(stiff.rendered_stiffness_n_per_mm, 2.0)
        self.assertAlmostEqual(yields_mm(stiff) * stiff.rendered_stiffness_n_per_mm, 1.0, delta=0.1)

    def test_a_late_force_moves_the_hand_later(self):
        """The two arms go alike until the first has felt the first force, which the second feels ten milliseconds later."""
        def way(delay_ms):
            return om.Session(tooth(), hand="firm", arm=om.Arm(delay_ms=delay_ms, resolution_mm=0.0)).run(2500)

        prompt, late = way(0), way(10)
        felt = np.flatnonzero(np.linalg.norm(prompt["force_n"], axis=1) > 0.0)[0]
        differs = np.flatnonzero((prompt["hand_mm"] != late["hand_mm"]).any(axis=1))[0]
        self.assertTrue(felt < differs <= felt + 6, (felt, differs))
        unmoved = way(11)
        parts = np.flatnonzero((late["hand_mm"] != unmoved["hand_mm"]).any(axis=1))[0]
        self.assertTrue(felt + 10 < parts <= felt + 16, (felt, parts))
        self.assertLess(om.Arm(delay_ms=3).rendered_stiffness_n_per_mm, om.Arm(delay_ms=0).rendered_stiffness_n_per_mm)

    def test_a_session_of_another_arm_refuses_a_state(self):
        session = om.Session(tooth(), arm=om.Arm(max_force_n=10.0))
        session.rollout(plunge(tooth(), 300, 1.0), pedals=True)
        with self.assertRaisesRegex(om.BadInput, "arm"):
            om.Session(tooth()).load_state(session.save_state())
        om.Session(tooth(), arm=om.Arm(max_force_n=10.0)).load_state(session.save_state())

    def test_a_recording_of_it_is_repeated(self):
        with tempfile.TemporaryDirectory() as folder:
            for number, (hand, arm) in enumerate((("prescribed", om.Arm(**ROBOT)), ("firm", om.Arm(mass_kg=0.2, max_force_n=20.0, delay_ms=3)))):
                file = pathlib.Path(folder) / f"{number}.pcap"
                with om.Session(tooth(), hand=hand, arm=arm, record=file) as session:
                    session.rollout(plunge(tooth(), 1200, 4.0), pedals=True) if hand == "prescribed" else session.run(2500)
                    self.assertGreater(session.now.removed_mm3["total"], 0.01)
                self.assertTrue(om.repeat(file).is_equal, om.repeat(file).line)

    def test_says_what_is_wrong_and_goes_to_other_processes(self):
        for wrong, line in ((lambda: om.Arm(mass_kg=0.0), "mass_kg: takes 0.001 to 100 kg, not 0"), (lambda: om.Arm(delay_ms=21), "delay_ms"),
                            (lambda: om.Arm(max_force_n=float("nan")), "max_force_n"), (lambda: om.Arm(stiffness_n_per_mm=-1.0), "stiffness")):
            with self.assertRaisesRegex(om.BadInput, line):
                wrong()
        arm = pickle.loads(pickle.dumps(om.Arm(**ROBOT)))
        self.assertEqual({name: getattr(arm, name) for name in ROBOT}, ROBOT)


class SpindleTest(unittest.TestCase):
    def test_the_spindles_work_is_what_the_chips_take(self):
        """By a law without edges: K_t s for each mm^3, whatever the path."""
        case = om.Case("cube", set=[f"force_scale={scale}" for scale in (1.0,)])
        burr = case.burrs[case.start_burr]
        session = om.Session(case, force_model="published", arm=om.Arm(**ROBOT))
        down = case.start_mm - np.linspace(0.0, 3.0, 1500)[:, None] * case.start_axis
        along = down[-1] + np.linspace(0.0, 6.0, 1500)[:, None] * [1.0, 0.0, 0.0]
        out = session.rollout(np.concatenate([down, along]), pedals=True)
        per_s = 2 * np.pi * burr.rpm / 60.0
        work_mj = np.cumsum(out["spindle_torque_nmm"] * per_s * 0.001)
        steady = slice(1800, 2900)
        gained_mj = work_mj[steady][-1] - work_mj[steady][0]
        gained_mm3 = out["removed_mm3"]["total"][steady][-1] - out["removed_mm3"]["total"][steady][0]
        self.assertGreater(gained_mm3, 1.0)
        stiffness = case.bone.stiffness().max()
        self.assertAlmostEqual(gained_mj / (burr.cutting_coefficients_n_per_mm2[0] * stiffness * gained_mm3), 1.0, delta=0.1)
        step = session.step(hand_mm=out["hand_mm"][-1] + [0.004, 0.0, 0.0], pedal=True)
        self.assertGreater(step.spindle_torque_nmm, 0.0)
        self.assertAlmostEqual(step.spindle_power_w, 1e-3 * step.spindle_torque_nmm * per_s, delta=1e-12)
        self.assertEqual(pickle.loads(pickle.dumps(step)), step)

    def test_a_spindle_that_stands_takes_none(self):
        self.assertFalse(press(None)["spindle_torque_nmm"].any())


if __name__ == "__main__":
    unittest.main()
