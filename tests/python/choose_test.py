"""No more than a scene needs: the choice is that of brute force, and the server accepts the written scene."""

import itertools
import json
import os
import pathlib
import subprocess
import tempfile
import tomllib
import unittest

import osteomill as om
from osteomill.studies import choose_picture
from osteomill.studies.choose_milling import Errors, Measured, Way, cheapest
from osteomill.studies.choose_picture import Drawing, Drawn
from support import program

# Small scenes: other burrs, another law, other wants.
SCENES = (
    ("large_burr", 'diameter_mm = 5.0', Errors(5.0, 10.0)),
    ("small_burr_with_edges", 'diameter_mm = 1.0\nrpm = 40000\nedge_coefficients_n_per_mm = [0.3, 0.3, 0.0]', Errors(5.0, 10.0)),
    ("strict", 'diameter_mm = 2.0', Errors(0.5, 2.5)),
)
WAYS = [Way(*way) for way in itertools.product((0.3, 0.2, 0.1), (100.0, 1000.0), ("milling", "milling-partial", "published"),
                                               ("interpolate", "implicit"))]


def small_scene(folder, name, burr):
    file = pathlib.Path(folder) / f"{name}.toml"
    file.write_text(f"""name = "{name}"
[bone]
phantom = "cube"
[[burrs]]
name = "burr"
{burr}
[start_pose]
position_mm = [0.0, 0.0, 3.0]
[trajectory]
motion = "polishing"
start_mm = [0.0, 0.0, 0.0]
depth_mm = 0.5
width_mm = 5.0
""")
    return file


def voxels_a_second(way):
    """A cost that no clock measures: voxels of the burr's surface, and a coupling's solve."""
    times = {"milling": 1.0, "milling-partial": 0.9, "published": 0.95}[way.force_model]
    return way.milling_rate_hz * times / way.voxel_mm**2 * (3.0 if way.coupling == "implicit" else 1.0)


class BruteForceTest(unittest.TestCase):
    def test_chooses_what_trying_everything_finds(self):
        for name, burr, wanted in SCENES:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                measured = Measured(om.Case(str(small_scene(folder, name, burr))), quick=True)
                chosen = cheapest(WAYS, voxels_a_second, lambda way: measured.errors(way, wanted), wanted)
                held = [way for way in WAYS if measured.errors(way).is_within(wanted)]
                self.assertTrue(chosen.is_held)
                self.assertEqual(chosen.way, min(held, key=voxels_a_second))
                self.assertLess(len(held), len(WAYS))  # there was something to refuse
                for setting, (way, errors) in chosen.lost.items():
                    self.assertEqual(chosen.way.differs_in(way), [setting])
                    self.assertFalse(errors.is_within(wanted))

    def test_edges_that_rub_need_a_model_that_has_them(self):
        with tempfile.TemporaryDirectory() as folder:
            name, burr, wanted = SCENES[1]
            measured = Measured(om.Case(str(small_scene(folder, name, burr))), quick=True)
            self.assertGreater(measured.force_errors(0.1, 1000.0, "published").error_percent, wanted.error_percent)
            self.assertLess(measured.force_errors(0.1, 1000.0, "milling").error_percent, wanted.error_percent)


class CheapestTest(unittest.TestCase):
    def test_asks_for_no_error_that_it_does_not_need(self):
        asked = []

        def errors(way):
            asked.append(way)
            return Errors(100.0 * way.voxel_mm, 0.0)

        chosen = cheapest(WAYS, voxels_a_second, errors, Errors(25.0, 1.0))
        self.assertEqual(chosen.way.voxel_mm, 0.2)
        self.assertLess(len(asked), len(WAYS))
        self.assertEqual(chosen.lost["voxel_mm"][0].voxel_mm, 0.3)

    def test_says_where_nothing_holds_and_takes_the_truest(self):
        chosen = cheapest(WAYS, voxels_a_second, lambda way: Errors(100.0 * way.voxel_mm, 50.0 * way.voxel_mm), Errors(1.0, 1.0))
        self.assertFalse(chosen.is_held)
        self.assertEqual(chosen.way.voxel_mm, 0.1)
        self.assertEqual(chosen.tried, len(WAYS))


class PictureTest(unittest.TestCase):
    FOUND = {Drawing("raycast", "gradient", 1): Drawn(30.0, 60.0), Drawing("raycast", "surface-voxels", 1): Drawn(20.0, 55.0),
             Drawing("raycast", "gradient", 2): Drawn(10.0, 35.0), Drawing("slices", "surface-voxels", 1): Drawn(900.0, 48.0)}

    def test_takes_the_truest_that_is_in_time(self):
        for frame_ms, drawing in ((40.0, Drawing("raycast", "gradient", 1)), (25.0, Drawing("raycast", "surface-voxels", 1)),
                                  (16.0, Drawing("raycast", "gradient", 2))):
            chosen = choose_picture.truest(self.FOUND, frame_ms)
            self.assertEqual((chosen.drawing, chosen.is_held), (drawing, True))

    def test_says_where_none_is_in_time(self):
        chosen = choose_picture.truest(self.FOUND, 1.0)
        self.assertEqual((chosen.drawing.divisor, chosen.is_held, chosen.next_faster), (2, False, None))

    def test_next_faster_is_the_truest_of_those(self):
        drawing, _ = choose_picture.truest(self.FOUND, 40.0).next_faster
        self.assertEqual(drawing.shading, "surface-voxels")


class CommandTest(unittest.TestCase):
    def run_program(self, *command):
        return subprocess.run([program(command[0]), *command[1:]], capture_output=True, text=True)

    def test_writes_a_scene_that_the_server_takes_with_the_options_that_it_names(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "out"
            scene = small_scene(folder, *SCENES[0][:2])
            done = self.run_program("osteomill_study", "choose", "--case", str(scene), "--frame-ms", "1e6", "--quick", "--out", str(out))
            self.assertEqual(done.returncode, 0, done.stderr)
            choice = json.loads((out / "choice.json").read_text())
            text = (out / "scene.toml").read_text()
            self.assertTrue(choice["milling"]["is_held"] and choice["picture"]["is_held"], choice)
            self.assertEqual(tomllib.loads(text)["burrs"][0]["diameter_mm"], 5.0)
            (line,) = [line for line in text.splitlines() if line.startswith("#   haptic_server ")]
            session = pathlib.Path(folder) / "session.json"
            served = self.run_program("haptic_server", "--scene", str(out / "scene.toml"), *line.split()[2:], "--clock", "virtual",
                                      "--duration-s", "0.1", "--json", str(session))
            self.assertEqual(served.returncode, 0, served.stderr)
            settings = json.loads(session.read_text())["settings"]
            for key in ("force_model", "coupling", "milling_rate_hz"):
                self.assertEqual(settings[key], choice["milling"]["way"][key])
            shown = self.run_program("render_client", *choice["picture"]["options"], "--help")
            self.assertEqual(shown.returncode, 0, shown.stderr)

    def test_says_in_one_line_what_is_wrong(self):
        for words, said in ((["--case", "toe"], "toe"), ([], "--case is required"),
                            (["--case", "cube", "--force-error", "0"], "0 is not above 0")):
            with tempfile.TemporaryDirectory() as folder:
                done = self.run_program("osteomill_study", "choose", *words, "--quick", "--out", os.path.join(folder, "out"))
            self.assertIn(done.returncode, (1, 2))
            self.assertIn(said, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
