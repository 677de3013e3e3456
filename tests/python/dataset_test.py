"""Image sets of recordings, read by PIL and NumPy: the contents of a frame are of one instant, and the same each time."""

import hashlib
import importlib.util
import json
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
from PIL import Image
from support import program, run_server

EXAMPLES = pathlib.Path(__file__).parents[2] / "python" / "examples"
CAMERAS = """[[cameras]]
name = "side"
eye_mm = [50, -40, 35]
target_mm = [0, 0, 3]
width_px = 320
height_px = 240
intrinsics = [[700, 0, 150], [0, 690, 130], [0, 0, 1]]
baseline_mm = 4
convergence_mm = 70

[[cameras]]
name = "moving"
path = "path.csv"
width_px = 200
height_px = 160
intrinsics = [[400, 0, 99.5], [0, 400, 79.5], [0, 0, 1]]
"""
# Straight down onto the tooth, the patient's front at the picture's lower edge.
PATH = "time_s,x,y,z,qx,qy,qz,qw\n0,0,0,45,1,0,0,0\n3,3,-2,45,1,0,0,0\n"
# The same cameras, so many times as fine.
FINE = 4
FINE_CAMERAS = """
[[cameras]]
name = "fine"
eye_mm = [50, -40, 35]
target_mm = [0, 0, 3]
width_px = 1280
height_px = 960
intrinsics = [[2800, 0, 601.5], [0, 2760, 521.5], [0, 0, 1]]

[[cameras]]
name = "fine_moving"
path = "path.csv"
width_px = 800
height_px = 640
intrinsics = [[1600, 0, 399.5], [0, 1600, 319.5], [0, 0, 1]]
"""
TRAJECTORY = """t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal,burr
0.0,0.5,0.2,5.5,0,0,1,0,2
0.4,0.5,0.2,4.5,0,0,1,1,2
1.6,0.5,0.2,2.6,0,0.1,1,1,2
2.4,-1.8,0.2,2.6,0.2,0.1,1,1,2
"""


def rotation(q):
    """The rotation matrix of a quaternion x, y, z, w."""
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def to_world(pose, points):
    return points @ rotation(pose[3:]).T + pose[:3]


def from_world(pose, points):
    return (points - pose[:3]) @ rotation(pose[3:])


def render(folder, *arguments):
    return subprocess.run([program("render_client"), *arguments], capture_output=True, text=True, check=False, cwd=folder)


def hashes(folder):
    return {str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(folder.rglob("*")) if file.is_file()}


class DatasetTest(unittest.TestCase):
    """A session of the tooth, ten frames a second, a pair of cameras and one that moves."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "hand.csv").write_text(TRAJECTORY)
        (cls.folder / "cameras.toml").write_text(CAMERAS)
        (cls.folder / "path.csv").write_text(PATH)
        cls.measured, cls.log, *_ = run_server(cls.folder, "--scene", "tooth", "--record", cls.folder / "s.pcap",
                                               "--trajectory", cls.folder / "hand.csv", "--duration-s", "2.4")
        cls.make("set", "--dataset-images", "colour,depth,ray-depth,labels,normals")
        (cls.folder / "fine.toml").write_text(FINE_CAMERAS)
        cls.look_at(cls, "set")
        cls.labels = [label["name"] for label in cls.index["sessions"][0]["labels"]]

    def look_at(self, name):
        """Makes the checks that follow use that set."""
        self.set = self.folder / name
        self.index = json.loads((self.set / "dataset.json").read_text())
        self.cameras = {camera["name"]: np.array(camera["intrinsics"]) for camera in self.index["cameras"]}

    @classmethod
    def make(cls, name, *arguments, cameras="cameras.toml"):
        ran = render(cls.folder, "--replay", "s.pcap", "--dataset", name, "--dataset-fps", "10", "--cameras", cameras, *arguments)
        if ran.returncode != 0:
            raise AssertionError(ran.stderr)

    def image(self, frame, camera, kind):
        images = {images["camera"]: images for images in self.index["frames"][frame]["images"]}[camera]
        file = self.set / images[kind]
        return np.load(file) if file.suffix == ".npy" else np.array(Image.open(file))

    def pose(self, frame, camera):
        return np.array({images["camera"]: images for images in self.index["frames"][frame]["images"]}[camera]["pose"])

    def points(self, frame, camera):
        """In the world, of every pixel."""
        depth, k = self.image(frame, camera, "depth").astype(float), self.cameras[camera]
        v, u = np.mgrid[:depth.shape[0], :depth.shape[1]]
        seen = np.stack([(u - k[0, 2]) / k[0, 0], (v - k[1, 2]) / k[1, 1], np.ones_like(depth)], -1)
        with np.errstate(invalid="ignore"):
            return to_world(self.pose(frame, camera), seen * depth[..., None])

    def project(self, frame, camera, points):
        seen, k = from_world(self.pose(frame, camera), points), self.cameras[camera]
        return seen[:, :2] / seen[:, 2:] * [k[0, 0], k[1, 1]] + [k[0, 2], k[1, 2]], seen[:, 2]

    def is_tool(self, labels):
        return (labels == self.labels.index("burr")) | (labels == self.labels.index("shank"))

    def test_files_are_what_the_index_says(self):
        self.assertEqual(len(self.index["frames"]), 25)
        self.assertEqual(list(self.cameras), ["side_left", "side_right", "moving"])
        for camera, (height, width) in {"side_left": (240, 320), "moving": (160, 200)}.items():
            self.assertEqual(self.image(3, camera, "colour").shape, (height, width, 3))
            for kind, dtype, shape in (("depth", "float32", (height, width)), ("ray_depth", "float32", (height, width)),
                                       ("labels", "uint8", (height, width)), ("normals", "float16", (height, width, 3))):
                self.assertEqual(self.image(3, camera, kind).dtype, dtype)
                self.assertEqual(self.image(3, camera, kind).shape, shape)
        with Image.open(self.folder / "set/side_left/000003_labels.png") as labels:
            self.assertEqual(labels.mode, "P")
            palette = np.array(labels.getpalette()).reshape(-1, 3)
        for number, label in enumerate(self.index["sessions"][0]["labels"]):
            self.assertEqual(list(palette[number]), label["rgb"])

    def test_images_agree_with_each_other(self):
        labels, depth = self.image(20, "side_left", "labels"), self.image(20, "side_left", "depth")
        normals = self.image(20, "side_left", "normals").astype(float)
        self.assertTrue(np.array_equal(labels == 0, np.isinf(depth)))
        length = np.linalg.norm(normals, axis=2)
        self.assertTrue(np.all(length[labels == 0] == 0.0))
        np.testing.assert_allclose(length[labels > 0], 1.0, atol=2e-3)
        # The ray's length is the distance from the camera.
        away = np.linalg.norm(self.points(20, "side_left") - self.pose(20, "side_left")[:3], axis=2)
        seen = labels > 0
        np.testing.assert_allclose(self.image(20, "side_left", "ray_depth")[seen], away[seen], rtol=1e-6)
        names = {self.labels[number] for number in np.unique(labels)}
        self.assertLessEqual({"burr", "shank", "nothing"}, names)
        self.assertGreater(len(names), 4, names)

    def test_frames_are_of_one_instant(self):
        for frame in self.index["frames"][1:]:
            row = self.log[np.argmin(np.abs(self.log["t_s"] - frame["session_s"]))]
            self.assertAlmostEqual(frame["recorded_s"] * 10, round(frame["recorded_s"] * 10), delta=0.4)
            self.assertLess(abs(row["t_s"] - frame["session_s"]), 1.5e-3)
            self.assertLess(np.linalg.norm([row["force_x_n"], row["force_y_n"], row["force_z_n"]] - np.array(frame["force_n"])), 0.5)
            self.assertLess(np.linalg.norm([row["burr_x_mm"], row["burr_y_mm"], row["burr_z_mm"]] - np.array(frame["tool"]["pose"][:3])), 0.05)
        self.assertAlmostEqual(self.index["frames"][-1]["removed_mm3"], self.measured["removed_mm3"]["total"], delta=0.05)

    def landings(self, camera, frame, off_px=0.0):
        """Points of the tool that face the camera in the frame behind `frame`, moved there by the poses: whether each is seen, and whether
        the tool is drawn there: whether its picture within half a pixel of the point reaches over the point's depth."""
        labels, normals = self.image(frame, camera, "labels"), self.image(frame, camera, "normals").astype(float)
        tool, next_tool = (np.array(self.index["frames"][i]["tool"]["pose"]) for i in (frame, frame + 1))
        here = np.zeros(labels.shape, bool)
        here[::FINE, ::FINE] = self.is_tool(labels)[::FINE, ::FINE]
        moved = to_world(next_tool, from_world(tool, self.points(frame, camera)[here]))
        outward = normals[here] @ rotation(self.pose(frame, camera)[3:]).T @ rotation(tool[3:]) @ rotation(next_tool[3:]).T
        to_eye = self.pose(frame + 1, camera)[:3] - moved
        cosine = np.sum(outward * to_eye, axis=1) / np.linalg.norm(to_eye, axis=1)
        pixels, depth = self.project(frame + 1, camera, moved)
        pixels[:, 0] += FINE * off_px
        u, v = np.rint(pixels).astype(int).T
        inside = (cosine > 0.05) & (u >= FINE) & (v >= FINE) & (u < labels.shape[1] - FINE) & (v < labels.shape[0] - FINE)
        u, v, depth, cosine = u[inside], v[inside], depth[inside], cosine[inside]
        # Between two of the fine pixels the surface goes so far along the line of sight.
        between = depth / self.cameras[camera][0, 0] * np.sqrt(np.maximum(1 - cosine**2, 0)) / cosine + 0.005
        next_labels, next_depth = (self.image(frame + 1, camera, kind) for kind in ("labels", "depth"))
        near = [(dv, du) for dv in range(-FINE, FINE + 1) for du in range(-FINE, FINE + 1) if np.hypot(dv, du) <= FINE / 2]
        things = np.stack([next_depth[v + dv, u + du] for dv, du in near])
        is_tool = np.stack([self.is_tool(next_labels[v + dv, u + du]) for dv, du in near])
        is_seen = next_depth[v, u] > depth - between
        lowest = np.min(np.where(is_tool, things, np.inf), axis=0)
        highest = np.max(np.where(is_tool, things, -np.inf), axis=0)
        return is_seen, (lowest < depth + between) & (highest > depth - between)

    def test_a_point_of_the_tool_lands_by_the_poses_within_half_a_pixel_in_the_next_frame(self):
        """Measured in pictures four times as fine, for a pixel says no more of an outline than that it is somewhere in it."""
        self.make("fine", "--from-s", "1.4", "--dataset-images", "depth,labels,normals", cameras="fine.toml")
        self.look_at("fine")
        for off_px in (0.0, 1.0):
            seen, landed = (np.concatenate(all_of) for all_of in zip(*(
                self.landings(camera, frame, off_px) for camera in ("fine", "fine_moving") for frame in range(1, 10))))
            self.assertGreater(len(seen), 20_000)
            if off_px == 0.0:
                # The rest is hidden: by bone, and by the burr's edges.
                self.assertGreater(seen.mean(), 0.99)
                self.assertEqual((seen & ~landed).sum(), 0, "points that landed elsewhere")
            else:
                self.assertGreater((seen & ~landed).sum(), 2_000, "what is off by a pixel is not found out")

    def test_a_pair_sees_the_same_surface(self):
        points = self.points(24, "side_left")[self.image(24, "side_left", "labels") > 3]
        pixels, depth = self.project(24, "side_right", points)
        u, v = np.rint(pixels).astype(int).T
        inside = (u >= 0) & (u < 320) & (v >= 0) & (v < 240)
        difference = np.abs(self.image(24, "side_right", "depth")[v[inside], u[inside]] - depth[inside])
        self.assertLess(np.median(difference), 0.1)
        baseline = self.pose(24, "side_right")[:3] - self.pose(24, "side_left")[:3]
        self.assertAlmostEqual(np.linalg.norm(baseline), 4.0, places=9)

    def test_parts_that_are_made_later_have_the_bytes_of_the_whole(self):
        whole = hashes(self.folder / "set")
        for part in ("1/3", "2/3", "3/3"):
            self.make("parts", "--dataset-images", "colour,depth,ray-depth,labels,normals", "--shard", part)
        parts = hashes(self.folder / "parts")
        frames = []
        for part in (1, 2, 3):
            name = f"dataset-{part}-of-3.json"
            del parts[name]
            frames += json.loads((self.folder / "parts" / name).read_text())["frames"]
        del whole["dataset.json"]
        self.assertEqual(parts, whole)
        self.assertEqual(sorted(frames, key=lambda frame: frame["frame"]), self.index["frames"])

    def test_begins_where_it_is_told_and_ends_where_the_recording_does(self):
        plain = ("--dataset-fps", "5", "--dataset-images", "labels")
        ran = render(self.folder, "--replay", "s.pcap", "--dataset", "late", "--from-s", "1.5", *plain)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        late = json.loads((self.folder / "late/dataset.json").read_text())["frames"]
        self.assertEqual([round(5 * frame["recorded_s"]) for frame in late], [8, 8, 9, 10, 11, 12])
        (self.folder / "torn.pcap").write_bytes((self.folder / "s.pcap").read_bytes()[:-40_000])
        ran = render(self.folder, "--replay", "torn.pcap", "--dataset", "torn", *plain)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        torn = json.loads((self.folder / "torn/dataset.json").read_text())["frames"]
        self.assertTrue(0 < len(torn) < 13, len(torn))
        self.assertEqual(len(list((self.folder / "torn/view").iterdir())), len(torn))

    def test_sessions_that_were_joined_follow_each_other(self):
        run_server(self.folder, "--scene", "tooth", "--record", self.folder / "short.pcap", "--duration-s", "0.3")
        one = (self.folder / "short.pcap").read_bytes()
        (self.folder / "joined.pcap").write_bytes(one + one[24:])  # as mergecap -a: without the second's header
        for name in ("short", "joined"):
            ran = render(self.folder, "--replay", f"{name}.pcap", "--dataset", name, "--dataset-images", "depth")
            self.assertEqual(ran.returncode, 0, ran.stderr)
        short, joined = (json.loads((self.folder / name / "dataset.json").read_text()) for name in ("short", "joined"))
        count = len(short["frames"])
        self.assertGreater(count, 3)
        self.assertEqual([frame["session"] for frame in joined["frames"]], [0] * count + [1] * count)
        self.assertEqual(joined["sessions"], 2 * short["sessions"])
        depths = [(self.folder / "joined" / frame["images"][0]["depth"]).read_bytes() for frame in joined["frames"]]
        self.assertEqual(depths[:count], depths[count:])

    def learns(self, training, held_out):
        spec = importlib.util.spec_from_file_location("segment_tool", EXAMPLES / "segment_tool.py")
        segment_tool = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(segment_tool)
        segment_tool.STEPS = 300
        network, threshold = segment_tool.learn(segment_tool.frames_of(self.folder / training))
        frames = segment_tool.frames_of(self.folder / held_out)
        self.assertEqual(len(frames), 15)
        truth = np.concatenate([is_tool.ravel() for _, is_tool in frames])
        found = np.concatenate([network.chance(segment_tool.features_of(colour)) > threshold for colour, _ in frames])
        reached = segment_tool.score(found, truth)["iou"]
        self.assertGreater(reached, 4 * truth.mean(), "no better than to call every pixel a tool's")
        self.assertGreater(reached, 0.3)

    def test_a_seed_repeats_its_looks_and_leaves_the_numbers(self):
        for name, seed in (("seven", "7"), ("seven_again", "7"), ("eight", "8")):
            self.make(name, "--randomise", seed, "--shard", "1/5")
        seven, eight, plain = (hashes(self.folder / name) for name in ("seven", "eight", "set"))
        self.assertEqual(seven, hashes(self.folder / "seven_again"))
        for file in seven:
            if file.endswith("_colour.png"):
                self.assertEqual(len({seven[file], eight[file], plain[file]}), 3, file)
            elif not file.endswith(".json"):
                self.assertEqual(seven[file], plain[file], file)
        self.learns("seven", "eight")
        index = json.loads((self.folder / "seven/dataset-1-of-5.json").read_text())
        left, right, _ = (images["look"] for images in index["frames"][1]["images"])
        self.assertEqual(left["lamps_xyzw"], right["lamps_xyzw"])
        self.assertNotEqual(left["exposure"], right["exposure"])

    def test_what_cannot_be_is_said_in_one_line(self):
        for arguments, words in ((("--dataset", "x"), "--dataset needs --replay"),
                                 (("--replay", "s.pcap", "--shard", "1/2"), "--dataset"),
                                 (("--replay", "s.pcap", "--dataset", "x", "--shard", "3/2"), "'3/2' is no part"),
                                 (("--replay", "s.pcap", "--dataset", "x", "--dataset-images", "depht"), "'depht'"),
                                 (("--replay", "s.pcap", "--dataset", "x", "--cameras", "trainee"), "s.pcap: does not say from where the trainee looked"),
                                 (("--replay", "s.pcap", "--film", "x.mp4", "--camera", "trainee"), "s.pcap: does not say from where"),
                                 (("--replay", "s.pcap", "--film", "x.mp4", "--camera", "cameras.toml"), "one camera, not 3"),
                                 (("--camera", "trainee"), "--camera needs --replay"),
                                 (("--replay", "s.pcap", "--offscreen", "--camera", "trainee"), "s.pcap: does not say from where"),
                                 (("--replay", "s.pcap", "--dataset", "x", "--camera", "trainee"), "are --cameras"),
                                 (("--replay", "s.pcap", "--dataset", "x", "--cameras", "none.toml"), "none.toml"),
                                 (("--replay", "s.pcap", "--dataset", "x", "--from-s", "9"), "no state from 9 s on"),
                                 (("--replay", "hand.csv", "--dataset", "x"), "hand.csv")):
            ran = render(self.folder, *arguments)
            self.assertNotEqual(ran.returncode, 0, arguments)
            self.assertEqual(len(ran.stderr.strip().splitlines()), 1, ran.stderr)
            self.assertIn(words, ran.stderr)


if __name__ == "__main__":
    unittest.main()
