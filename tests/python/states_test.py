"""The states of milling as data: forces against the published law, truths against the geometry of plates, files, splits. No time is asserted."""

import hashlib
import pathlib
import subprocess
import tempfile
import unittest

import h5py
import numpy as np
import pandas as pd

import osteomill as om
from osteomill import _studies
from osteomill.studies import states, states_motions, states_samples, states_sensor, states_truth
from study_files import run_of
from support import program, tooth

RADIUS_MM, FEED_MM_PER_S = 2.0, 0.5


def plate(thickness_mm, layer_mm=0.0):
    """16 x 8 mm, its top at z = 0, 3 mm of air below it; above z = -layer_mm cancellous bone. With a 4 mm burr and chips alone."""
    air, bone = 30, round(10.0 * thickness_mm)
    block = np.zeros((160, 80, bone + 2 * air), bool)
    block[:, :, air : air + bone] = True
    stiffness = np.ones(block.shape, np.float32)
    stiffness[:, :, air + bone - round(10.0 * layer_mm) : air + bone] = 0.12
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "plate.nrrd")
        om.Bone.from_array(block, spacing_mm=0.1, origin_mm=[-7.95, -3.95, -0.1 * (bone + air) + 0.05], stiffness=stiffness).save(file)
        return om.Case("cube", bone=file, burr="4 mm")


def upright(positions_mm):
    count = len(positions_mm)
    return states_motions.Path(np.asarray(positions_mm), np.tile([0.0, 0.0, 1.0], (count, 1)), np.ones(count, bool), 4)


def down(from_z_mm, to_z_mm, feed=FEED_MM_PER_S):
    """Height of the burr's centre over (0, 0)."""
    return upright(states_motions.polyline(np.array([[0.0, 0.0, from_z_mm], [0.0, 0.0, to_z_mm]]), [feed]))


def columns_of(case, path):
    exact = states_sensor.ForceSensor(noise_n=0.0, step_n=0.0)
    found = states_samples.labelled(case, path, False)
    return states_samples.columns_of(found, path, case.burrs[path.burr], exact, np.random.default_rng(1))


class SlotTest(unittest.TestCase):
    """A slot 1 mm deep at 0.5 mm/s, upright: docs/milling-model.md has its mean in closed form, and the chips of edges that stand at
    psi + 2 pi i / N in front of the burr have (N / pi) (1 + 2 / (N^2 - 1) cos N psi + ...) for the sum of their cosines."""

    @classmethod
    def setUpClass(cls):
        cls.case = plate(4.0)
        cls.burr = cls.case.burrs[4]
        in_mm = np.linspace(-10.5, -5.0, 1500)
        x_mm = np.concatenate([in_mm, -5.0 + 1e-3 * FEED_MM_PER_S * np.arange(1, 1001)])
        cls.path = upright(np.stack([x_mm, np.zeros_like(x_mm), np.full_like(x_mm, RADIUS_MM - 1.0)], axis=1))
        cls.milled = _studies.mill_path(cls.case, 4, cls.path.positions_mm, cls.path.axes, cls.path.spindle_on)
        cls.force_n = states_sensor.force_within_tooth_n(cls.milled, cls.burr)[-6000:]  # whole turns
        kd, feed_of_a_turn = np.arccos(0.5), FEED_MM_PER_S / (cls.burr.rpm / 60.0)
        i_s, i_c = RADIUS_MM * (kd / 2 - np.sin(2 * kd) / 4), RADIUS_MM * np.sin(kd) ** 2 / 2
        cls.mean_n = feed_of_a_turn * np.array([-(40 * i_s + 20 * i_c) / 4, 230 / 4, (40 * i_c - 20 * i_s) / np.pi])

    def test_mean_over_tooth_periods_is_the_published(self):
        found = self.force_n.mean(axis=0)
        self.assertLess(np.linalg.norm(found - self.mean_n) / np.linalg.norm(self.mean_n), 0.04)
        for tooth in self.force_n.reshape(-1, 10, 3).mean(axis=1)[::50]:
            np.testing.assert_allclose(tooth, found, atol=1e-4)

    def test_mean_is_that_of_a_session_s_model(self):
        model_n = self.milled["model_force_n"][-600:].mean(axis=0)
        self.assertLess(np.linalg.norm(model_n - self.mean_n) / np.linalg.norm(self.mean_n), 0.02)
        self.assertLess(np.linalg.norm(self.force_n.mean(axis=0) - model_n) / np.linalg.norm(model_n), 0.05)

    def test_strongest_line_is_the_teeth_s(self):
        lines_n = 2.0 * np.abs(np.fft.rfft(self.force_n - self.force_n.mean(axis=0), axis=0)) / len(self.force_n)
        hz = np.fft.rfftfreq(len(self.force_n), 1.0 / states_sensor.RATE_HZ)
        teeth_hz = self.burr.edges * self.burr.rpm / 60.0
        self.assertAlmostEqual(hz[np.linalg.norm(lines_n, axis=1).argmax()], teeth_hz, delta=2.0)
        for k, tolerance in ((1, 0.03), (2, 0.06)):
            line_n = lines_n[np.abs(hz - k * teeth_hz).argmin(), 2]
            self.assertAlmostEqual(line_n / self.force_n[:, 2].mean() / (2.0 / ((k * 6) ** 2 - 1)), 1.0, delta=tolerance)

    def test_touching_surface_is_that_of_a_slot(self):
        """Half of the ball's cap of 1 mm in front, and a patch's width of what lies abeam."""
        cap_mm2 = 2.0 * np.pi * RADIUS_MM * 1.0
        self.assertGreater(self.milled["engaged_mm2"][-1], 0.5 * cap_mm2)
        self.assertLess(self.milled["engaged_mm2"][-1], 0.62 * cap_mm2)

    def test_a_spindle_that_stands_cuts_nothing(self):
        milled = _studies.mill_path(self.case, 4, self.path.positions_mm[:200], self.path.axes[:200], np.zeros(200, bool))
        for name in ("force_n", "removed_mm3", "sound", "vibration_n", "normal"):
            self.assertFalse(milled[name].any(), name)


class PlungeTest(unittest.TestCase):
    """Through a plate of 2 mm, the upper 0.8 of it cancellous, from 0.2 mm above it at 1 mm/s."""

    THICK_MM, LAYER_MM, BEGIN_MM, FEED = 2.0, 0.8, 0.2, 1.0

    @classmethod
    def setUpClass(cls):
        cls.case = plate(cls.THICK_MM, cls.LAYER_MM)
        cls.columns = columns_of(cls.case, down(RADIUS_MM + cls.BEGIN_MM, RADIUS_MM - cls.THICK_MM - 0.4, cls.FEED))
        cls.depth_mm = -cls.BEGIN_MM + cls.FEED * cls.columns["time_s"]  # of the tip

    def begins(self, state):
        return float(self.columns["time_s"][np.argmax(self.columns["state"] == states_truth.STATES.index(state))])

    def test_wall_and_thickness_are_the_plate_less_the_depth(self):
        left_mm = self.THICK_MM - self.depth_mm
        np.testing.assert_allclose(self.columns["wall_mm"], left_mm, atol=0.03)
        np.testing.assert_allclose(self.columns["thickness_mm"], np.maximum(left_mm, 0.0), atol=0.06)

    def test_states_follow_the_layers(self):
        half_a_voxel_s = 0.05 / self.FEED
        self.assertAlmostEqual(self.begins("cancellous"), self.BEGIN_MM / self.FEED, delta=2 * half_a_voxel_s)
        self.assertAlmostEqual(self.begins("cortical"), (self.BEGIN_MM + self.LAYER_MM) / self.FEED, delta=2 * half_a_voxel_s)
        self.assertAlmostEqual(self.begins("breakthrough"), (self.BEGIN_MM + self.THICK_MM) / self.FEED, delta=half_a_voxel_s)
        self.assertEqual(self.columns["state"][0], states_truth.AIR)
        self.assertTrue((np.diff(self.columns["state"].astype(int)) >= 0).all())

    def test_time_to_breakthrough_is_the_way_over_the_feed(self):
        expected_s = np.maximum(0.0, self.THICK_MM - self.depth_mm) / self.FEED
        np.testing.assert_allclose(self.columns["time_to_breakthrough_s"], expected_s, atol=0.05)

    def test_cap_touches(self):
        at = np.argmax(self.depth_mm > 1.0)
        self.assertAlmostEqual(self.columns["engaged_mm2"][at] / (2.0 * np.pi * RADIUS_MM * 1.0), 1.0, delta=0.1)
        self.assertAlmostEqual(self.columns["engaged_share"][at], 0.25, delta=0.025)

    def test_removal_is_the_cap_s_section_times_the_feed(self):
        at = (self.depth_mm > 0.9) & (self.depth_mm < 1.1)
        self.assertAlmostEqual(self.columns["removed_mm3_per_s"][at].mean() / (np.pi * (2 * RADIUS_MM - 1.0) * self.FEED), 1.0, delta=0.02)

    def test_ct_numbers_are_those_of_the_stiffness(self):
        """Yield strength 114 rho^1.72 MPa, rho = HU / 1000 (Keyak): 1600 HU at 1, and 0.12 at 1600 * 0.12^(1/1.72)."""
        hu = self.columns["ct_hu"]
        soft, hard = (hu[self.columns["state"] == state] for state in (states_truth.CANCELLOUS, states_truth.CORTICAL))
        self.assertAlmostEqual(float(np.median(soft)), 1600.0 * 0.12 ** (1.0 / 1.72), delta=1.0)
        self.assertAlmostEqual(float(np.median(hard)), 1600.0, delta=1.0)
        self.assertTrue(np.isnan(hu[0]))


class FarSideTest(unittest.TestCase):
    def test_a_slot_beside_the_surface_is_no_breakthrough_and_its_floor_is_the_wall(self):
        case = plate(3.0)
        path = upright(states_motions.polyline(np.array([[-3.0, 0.0, 1.5], [-2.0, 0.0, 1.5]]), [2.0]))
        columns = columns_of(case, path)
        np.testing.assert_allclose(columns["wall_mm"], 3.0 - 0.5, atol=0.03)
        self.assertTrue(np.isnan(columns["thickness_mm"]).all())
        self.assertTrue(np.isnan(columns["time_to_breakthrough_s"]).all())

    def test_a_protected_structure_is_an_end(self):
        case = tooth()
        self.assertTrue(case.structures)
        tissue = case.bone.tissue()
        label = case.tissues[case.structures[0]]
        inside = np.argwhere((tissue == label) & (case.bone.fraction() >= 128))
        there_mm = case.bone.origin_mm + case.bone.spacing_mm * inside[len(inside) // 2]
        positions_mm = there_mm + np.linspace(3.0, 0.0, 20)[:, None] * case.start_axis
        way = states_truth.FarSide(case, case.start_axis, positions_mm, 0.5)
        self.assertLessEqual(way.distance_mm(positions_mm)[-1], 0.0)

    def test_state_is_what_the_page_says(self):
        state = states_truth.state_of(np.array([False, True, True, True]), np.array([np.nan, np.nan, 1.0, -0.1]), np.array([0.0, 0.1, 1.0, 1.0]))
        self.assertEqual([states_truth.STATES[one] for one in state], ["air", "cancellous", "cortical", "breakthrough"])


class SensorTest(unittest.TestCase):
    def test_error_is_within_its_statistics(self):
        rng = np.random.default_rng(3)
        sensor = states_sensor.ForceSensor(noise_n=0.045)
        force_n = np.stack([np.sin(2 * np.pi * hz * np.arange(40_000) / states_sensor.RATE_HZ) for hz in (3, 20, 300)], axis=1)
        error_n = sensor.read(force_n, rng) - sensor.low_passed(force_n)
        expected_n = np.hypot(0.045, 0.001 / np.sqrt(12.0))
        spread = 1.0 / np.sqrt(2.0 * len(force_n))  # of a root mean square of so many
        for axis in range(3):
            self.assertAlmostEqual(np.sqrt((error_n[:, axis] ** 2).mean()) / expected_n, 1.0, delta=4.0 * spread)
        drawn = [states_sensor.ForceSensor.drawn(rng).noise_n for _ in range(100)]
        self.assertGreaterEqual(min(drawn), 0.042)
        self.assertLessEqual(max(drawn), 0.048)

    def test_low_pass_halves_the_power_at_its_frequency(self):
        time_s = np.arange(20_000) / states_sensor.RATE_HZ
        for hz, gain in ((20.0, 1.0), (2000.0, np.sqrt(0.5))):
            passed = states_sensor.ForceSensor().low_passed(np.sin(2 * np.pi * hz * time_s)[:, None])[10_000:]
            self.assertAlmostEqual(passed.std() * np.sqrt(2.0), gain, delta=0.01)

    def test_steps_are_whole(self):
        read_n = states_sensor.ForceSensor(step_n=0.01).read(np.ones((100, 3)), np.random.default_rng(1))
        np.testing.assert_allclose(read_n / 0.01, np.round(read_n / 0.01), atol=1e-9)

    def test_bands_hold_what_lies_in_them(self):
        time_s = np.arange(1000) / states_sensor.RATE_HZ
        bands = states_samples.band_rms((0.3 * np.sin(2 * np.pi * 1000.0 * time_s))[:, None])
        self.assertAlmostEqual(bands[2], 0.3 / np.sqrt(2.0))
        self.assertAlmostEqual(sum(bands) - bands[2], 0.0)


class SplitTest(unittest.TestCase):
    def test_no_bone_and_no_motion_is_in_two(self):
        motions = states_motions.motions_of([{"plate": number} for number in range(7)], 5, 2)
        states_motions.split_of(motions, 5)
        table = pd.DataFrame(motions)
        self.assertEqual(set(table.groupby("plate")["split_by_case"].nunique()), {1})
        for split in ("split_by_case", "split_by_motion"):
            self.assertEqual(set(table[split]), {"train", "validation", "test"})
        self.assertEqual(len(set(table["number"])), len(table))


class StudyTest(unittest.TestCase):
    WORDS = ("--plates", "1", "--randoms", "0", "--seed", "4", "--every", "4")

    def test_files_hold_what_they_say_and_the_same_seed_gives_the_same_bytes(self):
        short = {"SLOT_MM": 0.3, "FEED_MM_PER_S": 3.0}
        kept = {name: getattr(states_motions, name) for name in short}
        try:
            for name, value in short.items():
                setattr(states_motions, name, value)
            digests = []
            for _ in range(2):
                with run_of("states", states, *self.WORDS, jobs=1) as (out, said):
                    files = sorted(out.glob("motion-*.h5"))
                    digests.append([hashlib.sha256(file.read_bytes()).hexdigest() for file in [*files, out / "windows.csv"]])
                    self.expect_files(out, files)
            self.assertEqual(digests[0], digests[1])
            self.assertEqual(len(set(digests[0])), 5)
        finally:
            for name, value in kept.items():
                setattr(states_motions, name, value)

    def expect_files(self, out, files):
        self.assertEqual(len(files), 4)
        windows, motions = pd.read_csv(out / "windows.csv"), pd.read_csv(out / "motions.csv")
        self.assertEqual(set(windows["motion"]), set(motions["motion"]))
        with h5py.File(files[3]) as file:
            samples = file["samples"]
            self.assertEqual(set(samples), set(states_samples.COLUMNS))
            rows = len(samples["time_s"])
            for name, (unit, _) in states_samples.COLUMNS.items():
                self.assertEqual(samples[name].attrs["unit"], unit)
                self.assertEqual(len(samples[name]), rows)
            self.assertEqual(file.attrs["rate_hz"], 2500.0)
            self.assertAlmostEqual(float(np.diff(samples["time_s"]).mean()), 4e-4)
            self.assertAlmostEqual(len(file["sound"]) / file["sound"].attrs["rate_hz"], rows / 2500.0, delta=1e-3)
            self.assertEqual((file.attrs["version"], file.attrs["seed"]), (_studies.VERSION, 4))
            self.assertEqual(list(file.attrs["states"]), list(states_truth.STATES))
            self.assertIn('name = "4 mm"', file.attrs["scene"])
            layers_mm = sum(states_motions.plate_layers_mm(4, 0))
            self.assertAlmostEqual(float(samples["wall_mm"][0]), layers_mm + states_motions.STAND_OFF_MM, delta=0.06)
            self.assertIn(states_truth.BREAKTHROUGH, samples["state"][:])
            self.assertTrue(0.042 <= file.attrs["sensor_noise_n"] <= 0.048)

    def test_a_recording_gives_its_own_path(self):
        case = tooth().with_(burr="2 mm")
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "session.pcap")
            with om.Session(case, record=file) as session:
                session.rollout(case.start_mm - np.linspace(0.0, 2.0, 300)[:, None] * case.start_axis, pedals=True)
            path = states_motions.recorded_path(file, case)
            np.testing.assert_array_equal(path.positions_mm, om.Recording(file).ticks["burr_mm"])
            with self.assertRaisesRegex(ValueError, "session.pcap: is of another bone than this case has"):
                states_motions.recorded_path(file, om.Case("cube"))

    def test_a_trajectory_gives_its_own_path(self):
        lines = ["t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal", "1.0,0,0,9,0,0,1,0", "1.01,0,0,7,0,0,2,1", "1.02,1,0,7,1,0,1,1"]
        case = tooth().with_(burr="2 mm")
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "path.csv")
            file.write_text("\n".join(lines))
            path = states_motions.trajectory_path(file, case)
            self.assertEqual((len(path.positions_mm), path.burr), (21, case.start_burr))
            np.testing.assert_allclose(path.positions_mm[[0, 5, 10, 15, 20]], [[0, 0, 9], [0, 0, 8], [0, 0, 7], [0.5, 0, 7], [1, 0, 7]])
            np.testing.assert_allclose(path.axes[[0, 10, 20]], [[0, 0, 1], [0, 0, 1], [np.sqrt(0.5), 0, np.sqrt(0.5)]])
            np.testing.assert_array_equal(path.spindle_on, np.arange(21) >= 10)
            for wrong, line in ((lines[:2], "a path lasts at least a millisecond"), ([lines[0], "1,2"], "path.csv"),
                                ([lines[0] + ",burr", lines[1] + ",0", lines[2] + ",1"], "has 2 burrs in use: a motion is of one")):
                file.write_text("\n".join(wrong))
                with self.assertRaisesRegex((ValueError, RuntimeError), line) as raised:
                    states_motions.trajectory_path(file, case)
                self.assertNotIn("\n", str(raised.exception))

    def test_bad_input_is_one_line(self):
        for words, line in (
            (("--trajectory", __file__), "--trajectory requires --case, the case that it is of"),
            (("--recording", __file__), "--recording requires --case, the case that was recorded"),
            (("--case", "cube", "--plates", "3"), "--plates excludes --case"),
            (("--every", "0"), "--every: Value 0 not in range 1 to 1000"),
            (("--case", "nowhere", "--no-samples"), "nowhere"),
        ):
            with self.subTest(line), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([program("osteomill_study"), "states", *words, "--out", folder], capture_output=True, text=True)
                self.assertIn(done.returncode, (1, 2))
                self.assertIn(line, done.stderr)
                self.assertEqual(len([said for said in done.stderr.splitlines() if not said.startswith("cases")]), 1, done.stderr)
        with self.assertRaisesRegex(ValueError, "a path has at least two poses"):
            _studies.mill_path(om.Case("cube"), 4, np.zeros((1, 3)), np.ones((1, 3)), np.ones(1, bool))
        with self.assertRaisesRegex(ValueError, "the scene has no such burr"):
            _studies.mill_path(om.Case("cube"), 40, np.zeros((2, 3)), np.ones((2, 3)), np.ones(2, bool))
        with self.assertRaisesRegex(ValueError, "a path has a position"):
            _studies.mill_path(om.Case("cube"), 4, np.zeros((2, 3)), np.ones((3, 3)), np.ones(2, bool))


class BaselineTest(unittest.TestCase):
    def test_tells_states_apart_that_the_force_shows_and_warns_in_time(self):
        try:
            from osteomill.studies import states_baseline
        except ModuleNotFoundError:
            self.skipTest("needs python3-sklearn")
        rng = np.random.default_rng(2)
        rows = []
        for motion in range(12):
            for window in range(60):
                state = "air" if window < 10 else "cancellous" if window < 30 else "cortical" if window < 50 else "breakthrough"
                force = {"air": 0.0, "cancellous": 0.5, "cortical": 2.0, "breakthrough": 1.2}[state] + 0.01 * rng.standard_normal()
                rows.append({"motion": motion, "bone": f"plate {motion // 3}", "state": state, "force_n": force,
                             "force_rms_n": 0.05, "time_to_breakthrough_s": max(0.0, 0.1 * (50 - window))})
        found = states_baseline.fit(pd.DataFrame(rows), 1)
        self.assertGreater(found["accuracy"], 0.95)
        self.assertEqual(int(found["confusion"].sum()), 12 * 60)
        self.assertEqual(len(found["warned_s"]), 12)
        for warned_s in found["warned_s"]:
            self.assertAlmostEqual(warned_s, states_baseline.WARNS_S, delta=0.35)
        self.assertEqual(found["false_alarms"], 0)
        with self.assertRaisesRegex(ValueError, "two bones or more"):
            states_baseline.fit(pd.DataFrame(rows).assign(bone="plate 0"), 1)


if __name__ == "__main__":
    unittest.main()
