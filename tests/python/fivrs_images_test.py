"""A recording in FIVRS's layout with the images of a set: the rules that its public programs hold such a file to."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from PIL import Image
from support import program, run_server

EXAMPLE = pathlib.Path(__file__).parents[2] / "python" / "examples" / "fivrs_images.py"
CAMERAS = """[[cameras]]
name = "main"
eye_mm = [30, -50, 40]
target_mm = [0, 0, 4]
intrinsics = [[1100, 0, 319.5], [0, 1100, 239.5], [0, 0, 1]]
baseline_mm = 4
"""
TRAJECTORY = """t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal,burr
0.0,0.5,0.2,4.5,0,0,1,1,2
0.3,-0.2,0.3,4.0,0.05,0.05,1,1,2
"""


def matrix(pose):
    """T_world_obj of x, y, z, qx, qy, qz, qw."""
    x, y, z, w = pose[3:]
    to_world = np.eye(4)
    to_world[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    to_world[:3, 3] = pose[:3]
    return to_world


def run(folder, *command):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


class FivrsImagesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "cameras.toml").write_text(CAMERAS)
        (cls.folder / "hand.csv").write_text(TRAJECTORY)
        run_server(cls.folder, "--scene", "tooth", "--record", cls.folder / "s.pcap", "--trajectory", cls.folder / "hand.csv",
                   "--duration-s", "0.3")
        for command in ((program("packet_replay"), "s.pcap", "--hdf5", "20260102_103000.hdf5", "--layout", "fivrs"),
                        (program("render_client"), "--replay", "s.pcap", "--dataset", "set", "--cameras", "cameras.toml"),
                        (program("render_client"), "--replay", "s.pcap", "--dataset", "few", "--dataset-fps", "5"),
                        (sys.executable, EXAMPLE, "20260102_103000.hdf5", "set", "main")):
            ran = run(cls.folder, *command)
            if ran.returncode != 0:
                raise AssertionError(ran.stderr)
        cls.file = h5py.File(cls.folder / "20260102_103000.hdf5")
        cls.addClassCleanup(cls.file.close)

    def test_has_the_names_types_and_shapes(self):
        data, metadata = self.file["data"], self.file["metadata"]
        count = len(data["time"])
        self.assertGreater(count, 7)
        for name, dtype, shape in (("l_img", "u1", (480, 640, 3)), ("r_img", "u1", (480, 640, 3)), ("segm", "u1", (480, 640, 3)),
                                   ("depth", "f8", (480, 640)), ("pose_main_camera", "f8", (7,))):
            self.assertEqual((data[name].dtype, data[name].shape), (dtype, (count, *shape)))
            self.assertEqual(data[name].compression, "gzip")
        self.assertEqual({len(data[name]) for name in data}, {count})
        self.assertEqual(metadata["camera_extrinsic"].dtype, "i8")
        np.testing.assert_array_equal(metadata["camera_extrinsic"], [[0, 1, 0, 0], [0, 0, -1, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
        np.testing.assert_allclose(metadata["camera_intrinsic"], [[1100, 0, 319.5], [0, 1100, 239.5], [0, 0, 1]])
        self.assertAlmostEqual(metadata["baseline"][()], 0.004)
        np.testing.assert_allclose(np.linalg.norm(data["pose_main_camera"][:, 3:], axis=1), 1.0)

    def test_pictures_are_bgr_and_anatomy_is_told_by_its_exact_colour(self):
        index = json.loads((self.folder / "set/dataset.json").read_text())
        rgb = np.array(Image.open(self.folder / "set" / index["frames"][5]["images"][0]["colour"]))
        np.testing.assert_array_equal(self.file["data/l_img"][5], rgb[..., ::-1])
        found = {tuple(int(part) for part in colour) for colour in np.unique(self.file["data/segm"][5].reshape(-1, 3), axis=0)}
        known = {tuple(label["rgb"][::-1]) for label in index["sessions"][0]["labels"] if label["name"] != "shank"}
        self.assertIn((33, 32, 34), found)
        self.assertLessEqual(found, known)
        self.assertGreater(len(found), 3)

    def test_a_point_of_the_tool_moved_by_the_poses_is_the_tools_in_the_next_frame(self):
        data = self.file["data"]
        k, extrinsic = self.file["metadata/camera_intrinsic"][:], self.file["metadata/camera_extrinsic"][:]
        points = landed = 0
        for i in range(len(data["time"]) - 1):
            is_tool = np.all(data["segm"][i] == (33, 32, 34), axis=2)
            # Within the outline by 4 pixels: their recorder has no point on an outline either.
            inner = is_tool.copy()
            for axis in (0, 1):
                for shift in (-4, 4):
                    inner &= np.roll(is_tool, shift, axis)
            v, u = np.nonzero(inner)
            z = data["depth"][i][v, u]
            cv = np.stack([(u - k[0, 2]) / k[0, 0] * z, (v - k[1, 2]) / k[1, 1] * z, z, np.ones_like(z)])
            camera, tool = ([matrix(data[name][j]) for j in (i, i + 1)] for name in ("pose_main_camera", "pose_mastoidectomy_drill"))
            world = camera[0] @ np.linalg.inv(extrinsic) @ cv
            moved = extrinsic @ np.linalg.inv(camera[1]) @ tool[1] @ np.linalg.inv(tool[0]) @ world
            pixel = np.rint((k @ (moved[:3] / moved[2]))[:2]).astype(int)
            inside = (pixel[0] >= 0) & (pixel[0] < 640) & (pixel[1] >= 0) & (pixel[1] < 480)
            at = pixel[1][inside], pixel[0][inside]
            is_there = np.all(data["segm"][i + 1][at] == (33, 32, 34), axis=1)
            is_as_deep = np.abs(data["depth"][i + 1][at] / moved[2][inside] - 1.0) < 0.01
            points += inside.sum()
            landed += (is_there & is_as_deep).sum()
        self.assertGreater(points, 8_000)
        self.assertGreater(landed / points, 0.995)

    def test_the_mastoid_has_the_colours_by_which_their_programs_tell_anatomy(self):
        (self.folder / "plain.toml").write_text('[[cameras]]\nname = "main"\n')
        for command in ((program("haptic_server"), "--clock", "virtual", "--scene", "mastoid", "--record", "m.pcap", "--duration-s", "0.05"),
                        (program("packet_replay"), "m.pcap", "--hdf5", "20260102_104500.hdf5", "--layout", "fivrs"),
                        (program("render_client"), "--replay", "m.pcap", "--dataset", "mastoid", "--cameras", "plain.toml"),
                        (sys.executable, EXAMPLE, "20260102_104500.hdf5", "mastoid", "main")):
            ran = run(self.folder, *command)
            self.assertEqual(ran.returncode, 0, ran.stderr)
        with h5py.File(self.folder / "20260102_104500.hdf5") as file:
            colours = {tuple(int(part) for part in colour) for colour in np.unique(file["data/segm"][0].reshape(-1, 3), axis=0)}
            self.assertNotIn("r_img", file["data"])
            self.assertNotIn("baseline", file["metadata"])
        # BGR of nothing, tool and bone.
        self.assertLessEqual({(0, 0, 0), (33, 32, 34), (219, 249, 255)}, colours)

    def test_a_set_that_does_not_fit_is_refused_in_one_line_and_the_file_stays(self):
        before = (self.folder / "s.pcap").read_bytes()
        run(self.folder, program("packet_replay"), "s.pcap", "--hdf5", "other.hdf5", "--layout", "fivrs")
        stays = (self.folder / "other.hdf5").read_bytes()
        for folder, camera, words in (("set", "side", "has no camera side"), ("few", "view", "are not the")):
            ran = run(self.folder, sys.executable, EXAMPLE, "other.hdf5", folder, camera)
            self.assertEqual((ran.returncode, len(ran.stderr.splitlines())), (1, 1), ran.stderr)
            self.assertIn(words, ran.stderr)
        self.assertEqual((self.folder / "other.hdf5").read_bytes(), stays)
        self.assertEqual((self.folder / "s.pcap").read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
