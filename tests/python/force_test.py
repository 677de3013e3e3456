"""The reference force from Python, against an independent quadrature; and the milling force against it."""

import json
import pathlib
import unittest

import numpy as np

import osteomill as om

CASES = json.loads((pathlib.Path(__file__).parent.parent / "data" / "milling_forces.json").read_text())


class ReferenceForceTest(unittest.TestCase):
    def test_is_the_independent_quadratures(self):
        for case in CASES:
            burr = om.Burr(diameter_mm=2 * case["radius_mm"], edges=int(case["edges"]), rpm=case["rpm"],
                           cutting_coefficients_n_per_mm2=case["K_N_mm2"], clockwise=case["spin"] < 0)
            position = np.array([0.0, 0.0, case["radius_mm"] - case["depth_mm"]])
            velocity = np.array(case["velocity_mm_s"], float)
            motion = om.Motion(position, velocity, case["spindle_axis"])
            higher = case["previous_groove_mm_higher"]

            def bone(x, y, z):
                if z > 0.0:
                    return 0.0
                if higher is None:
                    return 1.0
                way = velocity / np.linalg.norm(velocity)
                across = np.array([x, y, z]) - position - [0.0, 0.0, higher]
                return float(np.linalg.norm(across - across @ way * way) > case["radius_mm"])

            with self.subTest(case["name"]):
                force = om.reference_force(burr, motion, "flat" if higher is None else bone)
                expected = np.array(case["mean_force_N"])
                self.assertLess(np.linalg.norm(force - expected), 0.003 * np.linalg.norm(expected) + 1e-5)

    def test_of_a_slot_at_half_depth_is_the_closed_form(self):
        # A ball fed along x, its lower half in bone of stiffness 1, K = (0, K_r, 0). An edge at psi cuts chips of f_t max(0, n.x),
        # n.x = sin(kappa) cos(psi), and pushes along the normal. N_phi edges of f_t = (feed a turn) / N_phi, each an equal share of
        # a revolution at every psi:
        #     F_x = -K_r (feed a turn) R  mean over psi of max(0, cos psi) cos psi  x  integral of sin^2 kappa over 0 to pi/2
        #         = -K_r (feed a turn) R  1/4  pi/4
        burr = om.Burr(diameter_mm=3.0, edges=4, rpm=12000, cutting_coefficients_n_per_mm2=(0.0, 50.0, 0.0))
        feed_per_turn_mm = 6.0 / 200.0
        expected = -50.0 * feed_per_turn_mm * 1.5 * 0.25 * np.pi / 4
        force = om.reference_force(burr, om.Motion((0, 0, 0), (6.0, 0, 0)))
        self.assertAlmostEqual(force[0], expected, delta=1e-3 * abs(expected))

    def test_of_voxels_is_near_that_of_the_plane(self):
        cube = om.Case("cube")
        burr, motion = om.Burr(diameter_mm=5.0), om.Motion((0.03, 0.02, 1.5), (6.0, 0.0, 0.0))
        flat = om.reference_force(burr, motion)
        voxels = om.reference_force(burr, motion, cube.bone)
        self.assertLess(np.linalg.norm(voxels - flat), 0.05 * np.linalg.norm(flat))

    def test_says_what_is_wrong(self):
        burr, motion = om.Burr(diameter_mm=2.0), om.Motion((0, 0, 0), (1, 0, 0))
        with self.assertRaisesRegex(ValueError, "bone: takes a Bone"):
            om.reference_force(burr, motion, 3)
        with self.assertRaisesRegex(ZeroDivisionError, "division"):
            om.reference_force(burr, motion, lambda x, y, z: 1 / 0)
        with self.assertRaisesRegex(ValueError, "a burr has a diameter_mm above 0"):
            om.Burr(diameter_mm=0.0)
        with self.assertRaisesRegex(ValueError, "velocity_mm_per_s"):
            om.Motion((0, 0, 0), (1, 0))


class MillingForceTest(unittest.TestCase):
    def test_of_a_steady_slide_is_the_reference(self):
        """Along the cube's surface, 0.5 mm deep: the voxel model's documented accuracy is a few per cent."""
        cube = om.Case("cube", burr="5 mm")
        burr = cube.burrs[cube.start_burr]
        depth_mm, speed = 0.5, 6.0
        start = np.array([-12.0, 0.0, burr.diameter_mm / 2 + 1.0])
        session = om.Session(cube, start_mm=start, start_axis=(0, 0, 1), coupling="hold")
        down = np.linspace(start[2], burr.diameter_mm / 2 - depth_mm, 1500)
        session.rollout(np.column_stack([np.full(1500, -12.0), np.zeros(1500), down]), pedals=True)
        x = -12.0 + speed * np.arange(1, 3001) * 1e-3
        out = session.rollout(np.column_stack([x, np.zeros(3000), np.full(3000, down[-1])]), pedals=True)
        felt = out["milling_force_n"][1500:].mean(axis=0)
        z = out["burr_mm"][1500:, 2].mean()
        steady = om.reference_force(burr, om.Motion((0.0, 0.0, z), (speed, 0, 0)))
        self.assertLess(np.linalg.norm(felt - steady), 0.05 * np.linalg.norm(steady))


if __name__ == "__main__":
    unittest.main()
