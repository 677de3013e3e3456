"""osteomill.render: the very images of render_client --dataset, as arrays, in this process."""

import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np
from PIL import Image
from support import program, run_server, tooth

import osteomill as om

SIDE = {"name": "side", "eye_mm": np.array([50.0, -40.0, 35.0]), "target_mm": [0, 0, 3], "width_px": 200, "height_px": 160,
        "intrinsics": [[450, 0, 95], [0, 440, 82.5], [0, 0, 1]], "baseline_mm": 4, "convergence_mm": 70}
CAMERAS = """[[cameras]]
name = "side"
eye_mm = [50, -40, 35]
target_mm = [0, 0, 3]
width_px = 200
height_px = 160
intrinsics = [[450, 0, 95], [0, 440, 82.5], [0, 0, 1]]
baseline_mm = 4
convergence_mm = 70
"""
TRAJECTORY = """t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal,burr
0.0,0.5,0.2,4.5,0,0,1,1,2
0.8,-0.8,0.4,3.0,0.1,0.1,1,1,2
"""
KINDS = ("colour", "depth", "ray-depth", "labels", "normals")


def plain(thing):
    """The thing in types that JSON has."""
    if isinstance(thing, dict):
        return {name: plain(part) for name, part in thing.items()}
    return thing.tolist() if isinstance(thing, np.ndarray) else thing


def same(one, other):
    return all(np.array_equal(one["images"][name][kind], view[kind], equal_nan=True)
               for name, view in other["images"].items() for kind in view if isinstance(view[kind], np.ndarray))


class RenderTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.file = cls.folder / "s.pcap"
        (cls.folder / "hand.csv").write_text(TRAJECTORY)
        (cls.folder / "cameras.toml").write_text(CAMERAS)
        run_server(cls.folder, "--scene", "tooth", "--record", cls.file, "--trajectory", cls.folder / "hand.csv", "--duration-s", "0.8")

    def index_of(self, name, *arguments):
        subprocess.run([program("render_client"), "--replay", self.file, "--dataset", self.folder / name, "--cameras",
                        self.folder / "cameras.toml", "--dataset-fps", "10", "--dataset-images", ",".join(KINDS), *arguments],
                       check=True, capture_output=True)
        return json.loads((self.folder / name / "dataset.json").read_text())

    def expect_the_set(self, frames, name, *arguments):
        index, count = self.index_of(name, *arguments), 0
        for frame, row in itertools.zip_longest(frames, index["frames"]):
            for said in row.pop("images"):
                view = frame["images"][said.pop("camera")]
                for kind in KINDS:
                    file = self.folder / name / said.pop(kind.replace("-", "_"))
                    written = np.load(file) if file.suffix == ".npy" else np.array(Image.open(file))
                    drawn = view.pop(kind.replace("-", "_"))
                    self.assertEqual((drawn.dtype, drawn.shape), (written.dtype, written.shape))
                    self.assertEqual(drawn.tobytes(), written.tobytes(), (kind, row["frame"]))
                    count += 1
                self.assertEqual(plain(view), said)
            frame.pop("images")
            self.assertEqual(plain(frame), row)
        self.assertEqual(count, 9 * 2 * 5)
        self.assertEqual(frames.sessions, index["sessions"])
        self.assertEqual(plain(frames.cameras), {camera["name"]: camera["intrinsics"] for camera in index["cameras"]})

    def test_a_session_is_drawn_as_it_is_now_and_as_its_recording(self):
        file = self.folder / "live.pcap"
        with om.Session(tooth(), record=file) as session:
            session.rollout(tooth().start_mm - np.linspace(0.0, 3.0, 900)[:, None] * tooth().start_axis, pedals=True)
            [now] = om.render(session, [SIDE], images=KINDS)
            session.rollout(np.tile(session.now.hand_mm, (10, 1)), pedals=False)
            [later] = om.render(session, [SIDE], images=KINDS)
        before = next(om.render(tooth(), [SIDE], images=KINDS))
        self.assertFalse(same(now, before))
        last = list(om.render(file, [SIDE], images=KINDS))[-1]
        self.assertTrue(same(later, last))
        self.assertEqual(later["removed_mm3"], last["removed_mm3"])

    def test_a_view_follows_sessions_as_their_recordings_show_them(self):
        """One view, that goes to and fro between sessions, their copies and new ones: each picture is that of its recording."""
        view = om.View(om.Session(tooth()), [SIDE], images=KINDS)
        self.assertEqual(view.cameras.keys(), {"side_left", "side_right"})
        self.assertIn("burr", [label["name"] for label in view.session["labels"]])
        hands = tooth().start_mm - np.linspace(0.0, 3.5, 1000)[:, None] * tooth().start_axis
        sessions = [om.Session(tooth(), record=self.folder / f"v{number}.pcap") for number in range(2)]
        frames = [None, None]
        for part in range(4):
            for number, session in enumerate(sessions):
                session.rollout(hands[250 * part:250 * (part + 1)] + [0.4 * number, 0.0, 0.0] if part else np.tile(session.now.hand_mm, (250, 1)),
                                pedals=True)
                frames[number] = view.draw(session)
        branch = sessions[0].copy()
        branch.rollout(hands[-1] + np.linspace(0.0, 1.0, 300)[:, None] * [0.0, 1.0, 0.0], pedals=True)
        self.assertFalse(same(view.draw(branch), frames[0]))
        start = view.draw(om.Session(tooth()))
        self.assertTrue(same(start, next(om.render(tooth(), [SIDE], images=KINDS))))
        for number, session in enumerate(sessions):
            self.assertTrue(same(view.draw(session), frames[number]))
            session.close()
            last = list(om.render(self.folder / f"v{number}.pcap", [SIDE], images=KINDS))[-1]
            self.assertTrue(same(frames[number], last))
            self.assertEqual(plain(frames[number]["tool"]), plain(last["tool"]))
            self.assertEqual(frames[number]["removed_mm3"], last["removed_mm3"])
        self.assertFalse(same(frames[0], frames[1]))
        with self.assertRaisesRegex(om.BadInput, "of another bone"):
            view.draw(om.Session(om.Case("cube")))
        with self.assertRaisesRegex(om.BadInput, "nobody looks"):
            om.View(om.Session(tooth()), "trainee")

    def test_an_environment_sees_pictures(self):
        camera = {"eye_mm": [20.0, -20.0, 25.0], "target_mm": [0.0, 0.0, 2.0]}
        env = om.Env(tooth(), observation=("rgb", "depth", "labels"), camera=camera, picture_px=(84, 60), start_jitter_mm=0.1)
        for seed in (1, 2):
            observation, _ = env.reset(seed=seed)
            for _ in range(12):
                observation, *_ = env.step([0.0, 0.0, -20.0, 1.0])
            self.assertIn(observation, env.observation_space)
            self.assertEqual(observation["rgb"].shape, (60, 84, 3))
            [drawn] = om.render(env.session, [camera | {"name": "view", "width_px": 84, "height_px": 60}])
            for name, kind in (("rgb", "colour"), ("depth", "depth"), ("labels", "labels")):
                np.testing.assert_array_equal(observation[name], drawn["images"]["view"][kind])
        many = om.VectorEnv(tooth(), 3, observation=("labels",), camera=camera, start_jitter_mm=0.3)
        seen, _ = many.reset(seed=1)
        self.assertEqual(seen["labels"].shape, (3, 84, 84))
        self.assertTrue((seen["labels"] == 1).any(axis=(1, 2)).all(), "the burr is in sight")
        self.assertFalse(np.array_equal(seen["labels"][0], seen["labels"][1]))

    def test_is_to_the_bit_what_render_client_writes(self):
        self.expect_the_set(om.render(self.file, self.folder / "cameras.toml", fps=10, images=KINDS), "set")

    def test_takes_cameras_as_mappings_and_a_seed(self):
        with om.Recording(self.file) as recording:
            self.assertEqual(recording.file, self.file)
            self.expect_the_set(om.render(recording, [SIDE], fps=10, images=KINDS, randomise=7), "seven", "--randomise", "7")

    def test_several_at_once_do_not_disturb_each_other(self):
        alone = list(om.render(self.file, [SIDE], fps=5))
        self.assertEqual(len(alone), 5)
        first, second = om.render(self.file, [SIDE], fps=5), om.render(self.file, [SIDE], fps=5, from_s=0.4)
        for frame in alone[:2]:
            self.assertTrue(same(next(first), frame))
        self.assertTrue(same(next(second), alone[2]))
        del first  # its context goes, and the other's stays
        self.assertTrue(same(next(second), alone[3]))

        drawn = {}
        frames = om.render(self.file, [SIDE], fps=5)
        def take(number):
            drawn[number] = next(frames)
        for number in range(5):  # each on a thread of its own
            thread = threading.Thread(target=take, args=[number])
            thread.start()
            thread.join()
        threads = [threading.Thread(target=lambda name=name: drawn.update({name: list(om.render(self.file, [SIDE], fps=5))})) for name in "ab"]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for together in ([drawn[i] for i in range(5)], drawn["a"], drawn["b"]):
            self.assertTrue(all(same(one, other) for one, other in zip(together, alone, strict=True)))

    def test_draws_a_case_before_anything_is_milled(self):
        case = tooth()
        [frame] = om.render(case)
        self.assertEqual(frame["removed_mm3"], 0.0)
        np.testing.assert_allclose(frame["tool"]["pose"][:3], case.start_mm, atol=1e-9)
        view = frame["images"]["view"]
        self.assertEqual(view["colour"].shape, (480, 640, 3))
        labels = [label["name"] for label in om.render(case).sessions[0]["labels"]]
        seen = {labels[number] for number in np.unique(view["labels"])}
        self.assertLessEqual({"nothing", "burr", "shank", "enamel"}, seen)
        self.assertTrue(np.array_equal(np.isfinite(view["depth"]), view["labels"] > 0))

    def test_the_import_loads_no_opengl(self):
        says = subprocess.run([sys.executable, "-c", "import osteomill, sys; print('osteomill._render' in sys.modules);"
                               "print(any('epoxy' in line or 'EGL' in line for line in open('/proc/self/maps')))"],
                              check=True, capture_output=True, text=True).stdout
        self.assertEqual(says.split(), ["False", "False"])

    def test_says_in_one_line_what_cannot_be(self):
        for error, words, arguments, options in (
                (ValueError, "has no camera", [self.file, []], {}),
                (ValueError, "target_mm", [self.file, [{"name": "a", "eye_mm": [0, 0, 0]}]], {}),
                (ValueError, "'depht'", [self.file], {"images": ["depht"]}),
                (ValueError, "fps", [self.file], {"fps": 0.0}),
                (ValueError, "from_s", [self.file], {"from_s": float("nan")}),
                (ValueError, "none.toml", [self.file, self.folder / "none.toml"], {}),
                (RuntimeError, "none.pcap", [self.folder / "none.pcap"], {}),
                (RuntimeError, "from where the trainee looked", [self.file, "trainee"], {})):
            with self.assertRaises(error, msg=words) as raised:
                om.render(*arguments, **options)
            self.assertIn(words, str(raised.exception))
            self.assertEqual(len(str(raised.exception).splitlines()), 1)

    def test_says_in_one_line_that_there_is_no_opengl(self):
        says = subprocess.run([sys.executable, "-c", "import sys, osteomill as om\n"
                               "try: om.render(sys.argv[1])\nexcept RuntimeError as error: print(error)", self.file],
                              env=os.environ | {"__EGL_VENDOR_LIBRARY_DIRS": str(self.folder)},
                              check=True, capture_output=True, text=True).stdout
        self.assertEqual(len(says.splitlines()), 1, says)
        self.assertIn("no OpenGL 3.3", says)
        self.assertIn("apt-get install", says)


if __name__ == "__main__":
    unittest.main()
