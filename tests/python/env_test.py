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

    def test_says_what_is_wrong(self):
        for wrong, line in ((lambda: om.Env(tooth(), control_hz=300), "control_hz"),
                            (lambda: om.Env(tooth(), observation=("smell",)), '"smell" is none of'),
                            (lambda: om.Env(tooth(), fastest_mm_per_s=1e4), "fastest_mm_per_s")):
            with self.assertRaisesRegex(ValueError, line):
                wrong()
        with self.assertRaisesRegex(RuntimeError, "reset"):
            om.Env(tooth()).step(DOWN)


if __name__ == "__main__":
    unittest.main()
