"""The study `assist`: hands that were recorded, once more with and without a fixture."""

import math
import pathlib
import tempfile
import types
import unittest

import numpy as np
import pandas as pd
from study_files import run_of
from support import tooth

import osteomill as om
from osteomill.studies import assist, assisted_hand
from osteomill.studies.assisted_hand import GRIPS, RecordedHand

OFF_THE_PULP = """[[fixture]]
name = "Off the pulp"
kind = "forbidden"
tissue = "pulp"
distance_mm = 0.6
max_force_n = 6
"""
# Into the tooth and its pulp, and out again: s, mm above the middle.
PLUNGE = ((0.0, 6.5), (0.3, 4.0), (3.5, -1.0), (4.0, 6.5))


def plunge(session):
    times, heights = zip(*PLUNGE)
    for tick in range(round(1000 * times[-1])):
        height = float(np.interp(0.001 * tick, times, heights))
        session.step(hand_mm=[0.5, 0.2, height], pedal=0.1 < 0.001 * tick < 3.6)


def record(file, *changes):
    with om.Session(tooth().with_(burr="1 mm", set=list(changes)), start_mm=[0.5, 0.2, 6.5], record=file) as session:
        plunge(session)


def fixture_of(folder, text=OFF_THE_PULP):
    file = pathlib.Path(folder) / "fixture.toml"
    file.write_text(text)
    return file


class AssistTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.hands = pathlib.Path(cls.folder) / "hands"
        cls.hands.mkdir()
        record(cls.hands / "deep.pcap")
        cls.fixture = fixture_of(cls.folder)

    def test_a_forbidden_region_spares_what_the_same_hand_mills_without_it(self):
        words = ("--recordings", str(self.hands), "--fixture", str(self.fixture), "--stiffness", "0.5,10", "--grips", "stiff")
        with run_of("assist", assist, *words) as (out, said):
            table = pd.read_csv(out / "assist.csv")
            effects = pd.read_csv(out / "effects.csv")
            for chart in ("assist", "effects"):
                self.assertIn("</svg>", (out / f"{chart}.svg").read_text())
            page = (out / "assist.html").read_text()
        recorded, without, soft, hard = (table.iloc[row] for row in range(4))
        self.assertEqual(list(table["fixture"]), ["as recorded", "without", "with", "with"])
        self.assertGreater(recorded["structure_mm3"], 0.2)
        for column in ("structure_mm3", "removed_mm3", "peak_force_n"):
            self.assertAlmostEqual(without[column], recorded[column], delta=0.01 * recorded[column], msg="the hand is that of the recording")
        self.assertEqual(without["fixture_s"], 0.0)
        self.assertLess(soft["structure_mm3"], without["structure_mm3"])
        self.assertLess(hard["structure_mm3"], 0.1 * without["structure_mm3"])
        self.assertGreater(hard["fixture_s"], 0.1)
        self.assertEqual(list(table["force_off_s"][1:]), [0.0] * 3)
        milled = effects[effects["outcome"] == "structure_mm3"].iloc[1]
        self.assertAlmostEqual(milled["difference"], hard["structure_mm3"] - without["structure_mm3"], places=5)
        self.assertTrue(math.isnan(milled["low"]), "a single trainee has no interval")
        self.assertIn("stiff grip, 10 N/mm: milled of protected structures", said)
        self.assertEqual(page.count("</svg>"), 2)
        self.assertNotIn("<script", page)
        self.assertIn("1 recording of 1 trainee", page)
        self.assertIn("name = &#34;Off the pulp&#34;", page)
        numbers = [f"{milled[column]:.3g}" for column in ("mean_without", "mean_with", "difference")]
        row = "<td>stiff grip, 10 N/mm</td><td>milled of protected structures, mm³</td>" + "".join(f"<td class='n'>{one}</td>" for one in ("1", *numbers, "–"))
        self.assertIn(row, page)

    def test_another_burr_and_speed_take_the_place_of_those_recorded(self):
        words = ("--recordings", str(self.hands), "--fixture", str(self.fixture), "--stiffness", "10", "--grips", "stiff")
        with run_of("assist", assist, *words, "--burr", "1.5 mm", "--rpm", "80000", jobs=1) as (out, _):
            recorded, without, helped = (row for _, row in pd.read_csv(out / "assist.csv").iterrows())
            self.assertIn("In place of what was recorded: burr 1.5 mm, 80000 rpm.", (out / "assist.html").read_text())
        # A hole half as wide again has 2.25 times the section; the hand, which is pushed back more, goes less deep.
        self.assertGreater(without["removed_mm3"], 1.2 * recorded["removed_mm3"])
        self.assertLess(without["removed_mm3"], 2.3 * recorded["removed_mm3"])
        self.assertGreater(helped["fixture_s"], 0.5)
        self.assertLess(helped["removed_mm3"], without["removed_mm3"])

    def test_says_in_a_line_what_is_wrong(self):
        def refusal(text, *words):
            with self.assertRaises((RuntimeError, ValueError)) as raised:
                with run_of("assist", assist, "--recordings", str(self.hands), "--fixture", str(fixture_of(self.folder, text)), *words, jobs=1):
                    pass
            self.assertNotIn("\n", str(raised.exception))
            return str(raised.exception)

        self.assertIn("takes [[fixture]] tables and nothing else; it has 'name'", refusal('name = "a case"\n' + OFF_THE_PULP))
        self.assertIn("takes [[fixture]] tables and nothing else", refusal(""))
        self.assertIn("is no TOML", refusal("[[fixture"))
        self.assertIn("no protected tissue of the scene", refusal(OFF_THE_PULP.replace("pulp\"\nd", "enamel\"\nd"), "--grips", "firm"))
        self.assertIn("began with another bone", refusal(OFF_THE_PULP, "--grips", "firm", "--case", "cube"))
        self.assertIn("9 mm", refusal(OFF_THE_PULP, "--grips", "firm", "--burr", "9 mm"))


class _SteadyForce:
    """In the place of a session: one force, wherever the hand goes."""

    def __init__(self, force_n):
        self.now = types.SimpleNamespace(force_n=np.array([force_n, 0.0, 0.0]), fault="", fixture_force_n=np.zeros(3))
        self.hand_mm = []

    def step(self, hand_mm, **_):
        self.hand_mm.append(hand_mm)
        return self.now


class HandTest(unittest.TestCase):
    def test_stands_where_it_was_recorded_while_nothing_pushes(self):
        height = np.interp(np.arange(1500) * 0.001, (0.0, 0.3, 1.2, 1.5), (6.5, 6.5, 5.0, 5.0))
        hand = RecordedHand(np.column_stack([np.full(1500, 0.5), np.full(1500, 0.2), height]), np.tile([0.0, 0.0, 1.0], (1500, 1)),
                            np.zeros((1500, 3)), np.zeros(1500, bool), np.zeros(1500, np.uint8))
        for grip in GRIPS.values():
            with om.Session(tooth(), start_mm=hand.hand_mm[0]) as session:
                felt = assisted_hand.play(session, hand, grip)
                self.assertLess(np.linalg.norm(session.now.hand_mm - hand.hand_mm[-1]), 0.05)
            self.assertTrue(felt.came_to_end)
            self.assertAlmostEqual(felt.time_s, 1.499, places=3)
            self.assertEqual((felt.peak_force_n, felt.energy_to_hand_mj), (0.0, 0.0))

    def test_swings_under_a_force_as_mass_spring_and_damper_do(self):
        """From rest under a steady force a body of m, K and B goes to F / K and beyond it by exp(-pi z / sqrt(1 - z^2)) of that, after half of
        a swing of w sqrt(1 - z^2), with w^2 = K / m and z = B / (2 sqrt(K m))."""
        force_n, ticks = 0.15, 8000
        hand = RecordedHand(np.zeros((ticks, 3)), np.tile([0.0, 0.0, 1.0], (ticks, 1)), np.zeros((ticks, 3)), np.zeros(ticks, bool),
                            np.zeros(ticks, np.uint8))
        for name, grip in GRIPS.items():
            pushed = _SteadyForce(force_n)
            felt = assisted_hand.play(pushed, hand, grip)
            kg, n_per_m, n_s_per_m = 0.045 + grip.mass_kg, 1e3 * grip.stiffness_n_per_mm, 1e3 * grip.damping_n_s_per_mm
            damping = n_s_per_m / (2.0 * math.sqrt(n_per_m * kg))
            slower = math.sqrt(1.0 - damping**2)
            rest_mm = force_n / grip.stiffness_n_per_mm
            beyond_mm = rest_mm * math.exp(-math.pi * damping / slower)
            way_mm = np.array(pushed.hand_mm)[:, 0]
            peak = int(np.argmax(way_mm > 0.999 * way_mm.max()))
            with self.subTest(name):
                self.assertAlmostEqual(way_mm[-1] / rest_mm, 1.0, delta=0.01)
                self.assertAlmostEqual(way_mm.max() / (rest_mm + beyond_mm), 1.0, delta=0.02)
                self.assertAlmostEqual(0.001 * peak / (math.pi / (math.sqrt(n_per_m / kg) * slower)), 1.0, delta=0.05)
                self.assertAlmostEqual(felt.energy_to_hand_mj / (force_n * way_mm.max()), 1.0, delta=0.01)

    def test_waits_for_its_tool(self):
        self.assertEqual([assisted_hand._pace(apart) for apart in (0.0, 1.0, 2.0, 3.0, 9.0)], [1.0, 1.0, 0.5, 0.05, 0.05])

    def test_fixtures_are_written_on_one_line(self):
        text = assisted_hand.inline_tables([{"name": 'a "b"', "on": True, "line": {"from_mm": [0, 1.5, 2]}}])
        self.assertEqual(text, '[{ name = "a \\"b\\"", on = true, line = { from_mm = [0, 1.5, 2] } }]')


class EffectsTest(unittest.TestCase):
    def test_are_paired_by_recording_averaged_by_trainee_and_have_students_interval(self):
        rows = []
        # Differences of trainee a: -1 and -3, of b: -4, of c: 0. Their means: -2, -4, 0.
        for recording, trainee, without, helped in (("1", "a", 5.0, 4.0), ("2", "a", 9.0, 6.0), ("3", "b", 4.0, 0.0), ("4", "c", 1.0, 1.0)):
            for fixture, value in (("without", without), ("with", helped)):
                rows.append({"recording": recording, "trainee": trainee, "grip": "firm", "fixture": fixture, "stiffness_n_per_mm": None}
                            | {key: value for key, _, _ in assist.OUTCOMES})
        effect = assist.effects_of(pd.DataFrame(rows)).iloc[0]
        self.assertEqual((effect["trainees"], effect["recordings"], effect["difference"]), (3, 4, -2.0))
        self.assertAlmostEqual(effect["mean_without"], (7.0 + 4.0 + 1.0) / 3.0)
        half = 4.302653 * 2.0 / math.sqrt(3.0)  # t of 2 degrees of freedom, standard deviation 2
        self.assertAlmostEqual(effect["low"], -2.0 - half, places=4)
        self.assertAlmostEqual(effect["high"], -2.0 + half, places=4)


class SessionTest(unittest.TestCase):
    def test_a_recorded_session_with_fixtures_is_computed_again_to_the_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "helped.pcap"
            record(file, "fixture=" + assisted_hand.inline_tables(assisted_hand.read_fixtures(fixture_of(folder))))
            self.assertIn("[[fixture]]", om.Recording(file).info()["scene_toml"])
            again = om.repeat(file)
            self.assertTrue(again.is_equal, again.line)

    def test_a_region_holds_off_a_head_of_any_shape_by_the_reports_own_measure(self):
        off = "fixture=[{name='off', kind='forbidden', tissue='pulp', distance_mm=1, stiffness_n_per_mm=20, max_force_n=6}]"
        axis = np.array([math.sin(0.5), 0.0, math.cos(0.5)])
        height_mm = np.interp(np.arange(2500), (0, 300, 2000, 2500), (6.5, 4.5, -0.5, -0.5))
        hand_mm = np.column_stack([np.full(2500, 0.5), np.full(2500, 0.2), height_mm])

        def held(shape, *fixture):
            """How near it came, mm, and the fixture's force at the end, N."""
            case = tooth().with_(burr="1 mm", set=[f"burrs.1 mm.shape={shape}", "burrs.1 mm.length_mm=3", *fixture])
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "held.pcap"
                with om.Session(case, start_mm=hand_mm[0], start_axis=axis, record=file) as session:
                    session.rollout(hand_mm, pedals=True)
                    force_n = float(np.linalg.norm(session.now.fixture_force_n))
                return om.Recording(file).metrics()["structure_nearest_mm_of"]["pulp"], force_n

        self.assertLess(held("cylinder")[0], 0.4)
        for shape in ("cylinder", "cone", "pear"):
            nearest_mm, force_n = held(shape, off)
            self.assertGreater(force_n, 0.5)
            # F on 20 N/mm that come in over 0.5 mm: sqrt(2 F 0.5 / 20) in, less up to 0.26 mm by which the blend of its balls holds it off.
            self.assertAlmostEqual(nearest_mm, 1.0 - math.sqrt(force_n / 20.0) + 0.1, delta=0.16, msg=f"{shape}, {force_n}")

    def test_a_step_says_the_fixtures_force(self):
        changes = ["fixture=[{name = 'gently', kind = 'slow', tissue = 'pulp', distance_mm = 3, spindle_share = 0.5},"
                   "{name = 'off', kind = 'forbidden', tissue = 'pulp', distance_mm = 4.5}]"]
        with om.Session(tooth().with_(burr="1 mm", set=changes), start_mm=[0.5, 0.2, 4.2]) as session:
            step = session.step(pedal=False, ms=500)
            self.assertGreater(step.fixture_force_n[2], 0.0, "up, off the pulp")
        with om.Session(tooth().with_(burr="1 mm"), start_mm=[0.5, 0.2, 4.2]) as session:
            self.assertEqual(list(session.step(pedal=False, ms=500).fixture_force_n), [0.0] * 3)

    def test_a_coupling_without_a_spring_refuses_fixtures(self):
        case = tooth().with_(set=["fixture=[{name = 'off', kind = 'forbidden', tissue = 'pulp'}]"])
        with self.assertRaisesRegex(ValueError, "takes no .*fixture.*choose implicit or virtual-coupling"):
            om.Session(case, coupling="interpolate")


if __name__ == "__main__":
    unittest.main()
