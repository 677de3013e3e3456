"""The environment keeps to Gymnasium's published API: the checks of Gymnasium's tools, made without it."""

import copy
import inspect
import multiprocessing
import pickle
import unittest
import warnings

import numpy as np
from support import tooth

import osteomill as om

ALL = ("pose", "hand", "force", "removed", "distance", "crop16")


def plain(value):
    """Whether a vector environment can stack or send it: numbers, texts, arrays, dicts of them, and a Step."""
    if isinstance(value, dict):
        return all(isinstance(name, str) and plain(one) for name, one in value.items())
    return isinstance(value, (int, float, bool, str, np.ndarray, om.Step))


def work(pipe):
    env = om.Env(om.Case("cube"), actions="normalised")
    pipe.send(env.reset(seed=1))
    pipe.send(env.step(np.array([0.0, 0.0, -0.2, 1.0], np.float32)))


class GymnasiumTest(unittest.TestCase):
    def test_is_an_env(self):
        env = om.Env(tooth(), observation=ALL)
        for name in ("metadata", "render_mode", "spec", "action_space", "observation_space", "np_random", "unwrapped", "reset", "step",
                     "render", "close", "__enter__", "__exit__"):
            self.assertTrue(hasattr(env, name), name)
        self.assertIs(env.unwrapped, env)
        self.assertIsInstance(env.np_random, np.random.Generator)
        self.assertIsInstance(env.metadata["render_modes"], list)
        self.assertIsNone(env.render_mode)
        signature = inspect.signature(env.reset)
        self.assertEqual({name: parameter.kind for name, parameter in signature.parameters.items()},
                         {"seed": inspect.Parameter.KEYWORD_ONLY, "options": inspect.Parameter.KEYWORD_ONLY})

    def test_spaces_sample_what_they_contain(self):
        for actions in ("raw", "normalised"):
            env = om.Env(tooth(), observation=ALL, actions=actions)
            for space in (env.action_space, env.observation_space):
                space.seed(3)
                first = [space.sample() for _ in range(20)]
                self.assertTrue(all(space.contains(one) and one in space for one in first))
                space.seed(3)
                np.testing.assert_equal([space.sample() for _ in range(20)], first)
                self.assertEqual(copy.deepcopy(space), space)
                self.assertEqual(pickle.loads(pickle.dumps(space)), space)
        normal = om.Env(tooth(), actions="normalised").action_space
        self.assertTrue((normal.low == -1).all() and (normal.high == 1).all() and normal.dtype == np.float32)
        bounds = om.Env(tooth()).observation_space
        self.assertTrue(all(np.isfinite(space.low).all() and np.isfinite(space.high).all() for space in bounds.values()))

    def test_resets_and_steps_as_the_api_says(self):
        env = om.Env(tooth(), observation=ALL, duration_s=0.1, start_jitter_mm=0.3)
        result = env.reset(seed=123, options={})
        self.assertTrue(isinstance(result, tuple) and len(result) == 2)
        again = env.reset(seed=123)
        np.testing.assert_equal(again[0], result[0])
        self.assertEqual(again[1], result[1])
        self.assertEqual(env.np_random_seed, 123)
        other = env.reset(seed=456)
        self.assertFalse(np.array_equal(other[0]["pose"], result[0]["pose"]))
        for count in range(5):
            observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
            self.assertIn(observation, env.observation_space)
            self.assertIs(type(reward), float)
            self.assertIs(type(terminated), bool)
            self.assertIs(type(truncated), bool)
            self.assertTrue(plain(info), info)
            self.assertEqual(truncated, count == 4)
        with self.assertWarnsRegex(UserWarning, "reset"):
            env.step(env.action_space.sample())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            env.reset()
            env.step(env.action_space.sample())
        env.close()
        env.close()

    def test_refuses_what_it_does_not_know(self):
        env = om.Env(tooth())
        env.reset(seed=1)
        for wrong, line in ((lambda: env.reset(options={"start": 1}), "options: .*start"), (lambda: env.reset(seed=-1), "seed"),
                            (lambda: om.Env(tooth(), render_mode="human"), "render_mode"), (lambda: om.Env(tooth(), control_hz=0), "control_hz"),
                            (lambda: om.Env(tooth(), actions="fast"), "actions")):
            with self.assertRaisesRegex(om.BadInput, line):
                wrong()
        for action in (5.0, [1.0], [0, 0, 0, np.nan], [0, 0, np.inf, 0], np.zeros((1, 4)), np.zeros(3), "up", None, [[0], [0, 1]], {}):
            with self.assertRaisesRegex(om.BadInput, "action"):
                env.step(action)

    def test_normalised_actions_are_shares_of_the_fastest(self):
        raw, normal = om.Env(tooth(), observation=("hand",)), om.Env(tooth(), observation=("hand",), actions="normalised")
        raw.reset(seed=0)
        normal.reset(seed=0)
        np.testing.assert_array_equal(raw.step([5.0, -10.0, -20.0, 1.0])[0]["hand"],
                                      normal.step(np.array([0.25, -0.5, -1.0, 0.5], np.float32))[0]["hand"])
        self.assertFalse(normal.step(np.zeros(4, np.float32))[4]["step"].spindle_on)

    def test_goes_to_other_processes(self):
        env = om.Env(tooth(), observation=ALL)
        first, info = env.reset(seed=5)
        for thing in (first, info, env.step([0, 0, -5, 1]), env.case, env):
            copied = pickle.loads(pickle.dumps(thing))
            self.assertIs(type(copied), type(thing))
        other = pickle.loads(pickle.dumps(env))
        np.testing.assert_equal(other.reset(seed=5)[0], first)
        self.assertEqual(pickle.loads(pickle.dumps(info["step"])), info["step"])
        for method in ("fork", "spawn", "forkserver"):
            context = multiprocessing.get_context(method)
            mine, its = context.Pipe()
            process = context.Process(target=work, args=(its,))
            process.start()
            self.assertTrue(mine.poll(120), method)
            self.assertEqual(mine.recv()[0].keys(), {"pose", "force"})
            self.assertEqual(len(mine.recv()), 5)
            process.join(60)
            self.assertEqual(process.exitcode, 0, method)


if __name__ == "__main__":
    unittest.main()
