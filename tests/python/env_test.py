"""The environment: Gymnasium's form, episodes that a seed repeats, observations that are the session's."""

import unittest

import numpy as np
from support import tooth

import osteomill as om

DOWN = np.array([0.0, 0.0, -20.0, 1.0])


def episode(env, seed, steps=12):
    observation, info = env.reset(seed=seed)
    seen, rewards = [observation], []
    for _ in range(steps):
        observation, reward, terminated, truncated, info = env.step(DOWN)
        seen.append(observation)
        rewards.append(reward)
    return seen, rewards


class EnvTest(unittest.TestCase):
    def test_has_gymnasiums_form(self):
        env = om.Env(tooth(), observation=("pose", "hand", "force", "removed", "distance", "crop32"), duration_s=0.1)
        observation, info = env.reset(seed=1)
        self.assertEqual(list(observation), list(env.observation_space))
        self.assertEqual(observation["crop32"].dtype, np.uint8)
        for step in range(1, 6):
            observation, reward, terminated, truncated, info = env.step(env.action_space.sample(np.random.default_rng(step)))
            for name, space in env.observation_space.items():
                self.assertTrue(space.contains(observation[name]), name)
            self.assertIs(type(reward), float)
            self.assertFalse(terminated)
            self.assertEqual(truncated, step == 5)  # 20 ms each
            self.assertAlmostEqual(info["step"].time_s, 0.02 * step)
            self.assertEqual(info["ticks"]["time_s"].shape, (20,))
        env.close()

    def test_a_seed_repeats_an_episode(self):
        env = om.Env(tooth(), observation=("pose", "force", "crop8"), start_jitter_mm=0.5)
        np.random.seed(7)
        first = episode(env, seed=3)
        np.random.seed(8)  # nobody's
        again, other = episode(om.Env(tooth(), observation=("pose", "force", "crop8"), start_jitter_mm=0.5), 3), episode(env, seed=4)
        for a, b in zip(first[0], again[0]):
            for name in a:
                np.testing.assert_array_equal(a[name], b[name])
        self.assertEqual(first[1], again[1])
        self.assertFalse(np.array_equal(first[0][0]["pose"], other[0][0]["pose"]))
        unseeded, _ = env.reset()
        self.assertFalse(np.array_equal(unseeded["pose"], other[0][0]["pose"]))

    def test_rewards_what_it_is_told_to(self):
        env = om.Env(tooth(), reward=lambda before, after: after.time_s - before.time_s,
                     is_done=lambda before, after: after.removed_mm3["total"] > 0.05)
        env.reset(seed=0)
        rewards = []
        for _ in range(100):
            _, reward, terminated, _, info = env.step(DOWN / [1, 1, 4, 1])
            rewards.append(reward)
            if terminated:
                break
        self.assertTrue(terminated)
        np.testing.assert_allclose(rewards, 0.02)
        self.assertGreater(info["step"].removed_mm3["total"], 0.05)
        total, earned = om.Env(tooth()), 0.0
        total.reset(seed=0)
        for _ in rewards:
            _, reward, _, _, last = total.step(DOWN / [1, 1, 4, 1])
            earned += reward
        self.assertAlmostEqual(earned, last["step"].removed_mm3["total"], delta=1e-9)

    def test_a_crop_is_what_is_left_about_the_burr(self):
        env = om.Env(tooth(), observation=("pose", "crop16"))
        seen, _ = episode(env, seed=0, steps=8)
        bone = env.session.bone
        middle = np.rint((seen[-1]["pose"][:3] - bone.origin_mm) / bone.spacing_mm).astype(int)
        i, j, k = middle - 8
        np.testing.assert_array_equal(seen[-1]["crop16"], bone.fraction(((i, j, k), (i + 16, j + 16, k + 16))))

    def test_clips_what_is_too_fast(self):
        env = om.Env(tooth(), observation=("hand",), fastest_mm_per_s=10.0)
        before, _ = env.reset(seed=0)
        after, *_ = env.step([1e9, 0.0, 0.0, 0.0])
        np.testing.assert_allclose(after["hand"] - before["hand"], [0.2, 0.0, 0.0], atol=1e-9)

    def test_draws_within_ranges_and_a_seed_repeats_it(self):
        ranges = {"registration_mm": (0.5, 1.0), "delay_ms": (3, 40), "force_noise_n": (0.01, 0.1), "pose_noise_mm": (0.0, 0.01),
                  "force_scale": (0.5, 2.0), "wall_friction": (0.1, 0.3)}
        env = om.Env(tooth(), observation=("pose", "hand", "force"), ranges=ranges)
        first, again, other = episode(env, 3), episode(om.Env(tooth(), observation=("pose", "hand", "force"), ranges=ranges), 3), episode(env, 4)
        np.testing.assert_equal(again, first)
        self.assertFalse(np.array_equal(first[0][0]["pose"], other[0][0]["pose"]))
        drawn = []
        for seed in range(40):
            env.reset(seed=seed)
            drawn.append(env.drawn)
            self.assertEqual(env.drawn.keys(), ranges.keys())
        for name, (low, high) in ranges.items():
            values = np.array([one[name] for one in drawn])
            self.assertTrue((low <= values).all() and (values <= high).all(), name)
            self.assertGreater(np.ptp(values), 0.5 * (high - low), name)
        self.assertTrue(all(one["delay_ms"] == int(one["delay_ms"]) for one in drawn))

    def test_what_is_drawn_has_its_effect(self):
        def episode_of(ranges, **arguments):
            env = om.Env(tooth(), observation=("hand", "force"), ranges=ranges, **arguments)
            seen, rewards = episode(env, 1, 10)
            return env, np.array([one["hand"] for one in seen]), np.array([one["force"] for one in seen]), np.array(rewards)

        _, hands, forces, removed = episode_of(None)
        late, late_hands, _, _ = episode_of({"delay_ms": (40, 40)})
        self.assertEqual(late.drawn, {"delay_ms": 40.0})
        np.testing.assert_allclose(late_hands[2:], hands[:-2], atol=1e-9)  # two actions of 20 ms
        np.testing.assert_array_equal(late_hands[0], late_hands[1])
        off, off_hands, off_forces, _ = episode_of({"registration_mm": (0.7, 0.7)})
        np.testing.assert_allclose(np.linalg.norm(off_hands - hands, axis=1), 0.7, atol=1e-9)
        np.testing.assert_array_equal(off_forces, forces)
        self.assertEqual(off.session.now.hand_mm.tolist(), hands[-1].tolist())
        _, _, noisy, same = episode_of({"force_noise_n": (0.2, 0.2)})
        np.testing.assert_array_equal(same, removed)
        self.assertTrue(0.05 < (noisy - forces).std() < 0.5)
        _, _, stronger, _ = episode_of({"force_scale": (2.0, 2.0)})
        self.assertGreater(np.linalg.norm(stronger, axis=1).max(), 1.2 * np.linalg.norm(forces, axis=1).max())

    def test_draws_one_of_several_cases(self):
        cases = [tooth(), tooth().with_(rpm=9000.0)]
        env = om.Env(cases)
        speeds = set()
        for seed in range(12):
            env.reset(seed=seed)
            speeds.add(env.session.case.burrs[0].rpm)
        self.assertEqual(speeds, {case.burrs[0].rpm for case in cases})

    def test_tilts_the_spindle(self):
        for actions, action in (("raw", [0.0, 0.0, 5.0, 0.5, 0.0, 0.0, 0.0]), ("normalised", [0.0, 0.0, 0.25, 0.5, 0.0, 0.0, -1.0])):
            env = om.Env(tooth(), actions=actions, fastest_rad_per_s=1.0)
            self.assertEqual(env.action_space.shape, (7,))
            env.reset(seed=0)
            for _ in range(50):
                observation, *_ = env.step(action)
            axis = observation["pose"][3:]
            # Half a radian about x, right-handed.
            np.testing.assert_allclose(axis, [0.0, -np.sin(0.5), np.cos(0.5)], atol=1e-6)

    def test_ends_at_a_fault_and_at_protected_tissue(self):
        env = om.Env(tooth(), fastest_mm_per_s=2000.0, control_hz=500.0, ends=("fault",))
        env.reset(seed=0)
        self.assertFalse(env.step([0.0, 0.0, 0.0, 0.0])[2])
        _, _, terminated, _, info = env.step([2000.0, 2000.0, 2000.0, 0.0])  # 3.5 mm a ms: no hand
        self.assertTrue(terminated)
        self.assertNotEqual(info["fault"], "")
        deep = om.Env(tooth(), ends=("protected",), duration_s=60.0)
        deep.reset(seed=0)
        for _ in range(600):
            _, _, terminated, truncated, info = deep.step([0.0, 0.0, -3.0, 1.0])
            if terminated or truncated:
                break
        self.assertTrue(terminated and info["step"].touches_protected)

    def test_sees_the_plan_and_the_spindle(self):
        case = tooth().with_(set=["plan.tissue=carious lesion"])
        env = om.Env(case, observation=("pose", "plan", "spindle", "torque"))
        observation, _ = env.reset(seed=0)
        bone = case.bone
        where = np.argwhere((bone.tissue() == case.tissues["carious lesion"]) & (bone.fraction() > 0)) * bone.spacing_mm + bone.origin_mm
        nearest = np.linalg.norm(where - observation["pose"][:3], axis=1).min()
        self.assertAlmostEqual(observation["plan"][0], nearest, delta=1e-6)
        self.assertLess(case.plan_distance_mm(where.mean(axis=0)), 0.0)
        self.assertEqual(observation["spindle"].tolist(), [0.0, 0.0])
        for _ in range(60):
            observation, *_ = env.step([0.0, 0.0, -4.0, 1.0])
        self.assertGreater(observation["spindle"][0], 0.0)
        self.assertIsNone(om.Case("cube").plan_distance_mm([0, 0, 0]))

    def test_says_what_is_wrong(self):
        for wrong, line in ((lambda: om.Env(tooth(), control_hz=300), "control_hz"),
                            (lambda: om.Env(tooth(), observation=("smell",)), '"smell" is none of'),
                            (lambda: om.Env(tooth(), fastest_mm_per_s=1e4), "fastest_mm_per_s"),
                            (lambda: om.Env(tooth(), fastest_rad_per_s=-1.0), "fastest_rad_per_s"),
                            (lambda: om.Env(tooth(), ends=("blood",)), "ends: takes"), (lambda: om.Env([]), "case"),
                            (lambda: om.Env(om.Case("cube"), observation=("plan",)), '"plan": the case has none'),
                            (lambda: om.Env(tooth(), ranges={"smell": (0, 1)}), "ranges: takes registration_mm, .*smell"),
                            (lambda: om.Env(tooth(), ranges={"delay_ms": (0.2, 0.8)}), "whole milliseconds"),
                            (lambda: om.Env(tooth(), ranges={"force_scale": (2, 1)}), "the least first"),
                            (lambda: om.Env(tooth(), ranges={"force_scale": 2}), "two numbers")):
            with self.assertRaisesRegex(ValueError, line):
                wrong()
        with self.assertRaisesRegex(RuntimeError, "reset"):
            om.Env(tooth()).step(DOWN)


if __name__ == "__main__":
    unittest.main()
