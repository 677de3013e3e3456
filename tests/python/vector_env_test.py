"""Many environments in one call: each is to the bit as it is alone."""

import pickle
import unittest

import numpy as np
from support import tooth

import osteomill as om

ARGUMENTS = {"observation": ("pose", "force", "removed", "crop8"), "duration_s": 0.3, "start_jitter_mm": 0.3, "fastest_mm_per_s": 30.0,
             "ranges": {"force_scale": (0.5, 2.0), "delay_ms": (0, 15), "force_noise_n": (0.0, 0.1)}}


def actions_of(rng, count):
    actions = rng.uniform(-30.0, 30.0, (count, 4))
    actions[:, 2] = -rng.uniform(10.0, 30.0, count)
    actions[:, 3] = 1.0
    return actions


class VectorEnvTest(unittest.TestCase):
    def test_each_is_to_the_bit_what_it_is_alone(self):
        for threads in (1, 5):
            together = om.VectorEnv(tooth(), 5, threads=threads, **ARGUMENTS)
            alone = [om.Env(tooth(), **ARGUMENTS) for _ in range(5)]
            seen, infos = together.reset(seed=20)
            for i, env in enumerate(alone):
                observation, info = env.reset(seed=20 + i)
                np.testing.assert_equal({name: seen[name][i] for name in seen}, observation)
                self.assertEqual(infos["step"][i], info["step"])
            rng, is_over, milled, begun = np.random.default_rng(1), [False] * 5, 0.0, 0
            for _ in range(40):
                actions = actions_of(rng, 5)
                seen, rewards, terminations, truncations, infos = together.step(actions)
                for i, env in enumerate(alone):
                    if is_over[i]:
                        observation, info = env.reset()
                        expected = (observation, 0.0, False, False, info)
                        begun += 1
                    else:
                        expected = env.step(actions[i])
                    np.testing.assert_equal({name: seen[name][i] for name in seen}, expected[0])
                    self.assertEqual((rewards[i], terminations[i], truncations[i]), expected[1:4])
                    self.assertEqual(infos["step"][i], expected[4]["step"])
                    self.assertEqual(infos["force_n"][i], expected[4]["force_n"])
                    is_over[i] = expected[2] or expected[3]
                    milled += rewards[i]
            self.assertGreater(begun, 5)
            self.assertGreater(milled, 0.1)

    def test_has_gymnasiums_form(self):
        env = om.VectorEnv(tooth(), 3, observation=("pose", "removed", "crop8"), actions="normalised")
        self.assertEqual(env.num_envs, 3)
        for batched, single in ((env.action_space, env.single_action_space),
                                *((env.observation_space[name], env.single_observation_space[name]) for name in env.observation_space)):
            self.assertEqual(batched.shape, (3, *single.shape))
            self.assertEqual(batched.dtype, single.dtype)
        self.assertIn("autoreset_mode", env.metadata)
        seen, infos = env.reset(seed=[4, 5, 6])
        self.assertIn(seen, env.observation_space)
        seen, rewards, terminations, truncations, infos = env.step(env.action_space.sample(np.random.default_rng(0)))
        self.assertIn(seen, env.observation_space)
        self.assertEqual([(one.shape, one.dtype) for one in (rewards, terminations, truncations)],
                         [((3,), np.float64), ((3,), bool), ((3,), bool)])
        for name, values in infos.items():
            self.assertEqual(len(values), 3, name)
        self.assertTrue(infos["_time_s"].all())
        np.testing.assert_allclose(infos["time_s"], 0.02)
        env.close()
        env.close()
        self.assertTrue(env.closed)

    def test_goes_to_other_processes(self):
        env = om.VectorEnv(tooth(), 2, observation=("pose",))
        first, _ = env.reset(seed=3)
        other = pickle.loads(pickle.dumps(env))
        np.testing.assert_equal(other.reset(seed=3)[0], first)

    def test_says_what_is_wrong(self):
        env = om.VectorEnv(tooth(), 2)
        with self.assertRaisesRegex(om.Fault, "reset"):
            env.step(np.zeros((2, 4)))
        env.reset(seed=0)
        for wrong, line in ((lambda: om.VectorEnv(tooth(), 0), "num_envs"), (lambda: om.VectorEnv(tooth(), 1, threads=0), "threads"),
                            (lambda: env.reset(seed=[1]), "seed: takes one for each of the 2"), (lambda: env.step(np.zeros(4)), "actions"),
                            (lambda: env.step([[0, 0, 0, np.nan]] * 2), "action"), (lambda: env.step("up"), "actions")):
            with self.assertRaisesRegex(om.BadInput, line):
                wrong()

    def test_a_session_is_stepped_by_one_thread(self):
        session = om.Session(tooth())
        way = np.tile(tooth().start_mm, (3, 1))
        with self.assertRaisesRegex(om.BadInput, "twice"):
            om._core._step_together([session, session], [way, way], [None, None], [False, False], 2)
        with self.assertRaisesRegex(om.BadInput, "hands"):
            om._core._step_together([session, session.copy()], [way, way[:, :2]], [None, None], [False, False], 2)
        self.assertEqual(session.now.time_s, 0.0, "none has moved")


if __name__ == "__main__":
    unittest.main()
