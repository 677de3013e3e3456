"""An arm's effect on the force: measures of a force, kernels, and the study's charts. No time is asserted."""

import pathlib
import tempfile
import types
import unittest

import numpy as np
import pandas as pd

from osteomill import _studies
from osteomill.studies import arms, force_edges
from osteomill.studies.study_run import StudyRun
from support import tooth


def along_x(values):
    return np.column_stack([values, np.zeros_like(values), np.zeros_like(values)])


class MeasureTest(unittest.TestCase):
    TIME_S = np.arange(0.0, 8.0, arms.TICK_S)

    def test_noise_is_what_goes_above_5_hz(self):
        steady = arms.noise_of(along_x(np.full_like(self.TIME_S, 0.7)))
        self.assertAlmostEqual(steady["mean_force_n"], 0.7)
        self.assertAlmostEqual(steady["noise_n"], 0.0, places=9)
        slow, fast = (arms.noise_of(along_x(1.0 + 0.1 * np.sin(2.0 * np.pi * hz * self.TIME_S)))["noise_n"] for hz in (0.5, 60.0))
        self.assertLess(slow, 0.002)
        self.assertAlmostEqual(fast, 0.1 / np.sqrt(2.0), delta=0.002)

    def test_jumps_are_counted_while_there_is_a_force(self):
        stairs = np.floor(self.TIME_S) * 0.1  # seven steps of 0.1 N, the first second without a force
        found = arms.noise_of(along_x(stairs))
        self.assertAlmostEqual(found["largest_jump_n"], 0.1)
        self.assertAlmostEqual(found["jumps_per_s"], 1.0)

    def test_no_force_is_no_noise(self):
        self.assertEqual(set(arms.noise_of(np.zeros((100, 3))).values()), {0.0})

    def test_limit_cycle_is_what_the_mean_over_a_tenth_of_a_second_leaves(self):
        cycle = 0.3 * np.sin(2.0 * np.pi * 20.0 * self.TIME_S)
        self.assertAlmostEqual(arms.limit_cycle_n(along_x(self.TIME_S + cycle)), 0.3 / np.sqrt(2.0), delta=0.005)
        self.assertEqual(arms.limit_cycle_n(np.zeros((10, 3))), 0.0)


class KernelTest(unittest.TestCase):
    def test_coarser_encoders_make_noise(self):
        quiet, coarse = (arms.noise_of(_studies.forces_on_hand(tooth(), _studies.ArmModel(resolution_mm=step), longest_s=4.0))
                         for step in (0.0, 0.1))
        self.assertGreater(coarse["noise_n"], 2.0 * quiet["noise_n"])

    def test_stiffer_springs_pass_more(self):
        gains = [abs(_studies.force_response("implicit", stiffness, 2.0)[0]) for stiffness in (0.5, 5.0)]
        self.assertLess(gains[0], 0.2)
        self.assertGreater(gains[1], 0.7)
        with self.assertRaisesRegex(ValueError, "a frequency of 1000 Hz is not within 0.1 to 100"):
            _studies.force_response("implicit", 1.5, 1000.0)

    def test_response_is_as_it_was(self):
        for coupling, stiffness, hz, gain, rigid in (("implicit", 1.5, 1.0, 0.867385, 352.009), ("implicit", 5.0, 10.0, 0.0719598, 351.945)):
            response, rigid_n_s_per_m = _studies.force_response(coupling, stiffness, hz)
            self.assertAlmostEqual(abs(response) / gain, 1.0, delta=2e-3)  # since then the map sees where thin bone begins
            self.assertAlmostEqual(rigid_n_s_per_m / rigid, 1.0, delta=1e-5)

    def test_every_shipped_arm_gets_a_spring(self):
        shipped = dict(_studies.shipped_arms())
        self.assertIn("simulated", shipped)
        self.assertGreater(len(shipped), 3)
        for name, arm in shipped.items():
            self.assertGreater(arm.stiffness_n_per_mm, 0.0, name)


class EdgesTest(unittest.TestCase):
    def test_mean_does_not_depend_on_edges_but_the_peak_and_a_tooth_do(self):
        cases = force_edges.cases(quick=True)
        table = force_edges.table_of(cases, [force_edges.measure(case) for case in cases])
        edges = table[table["rpm"] == force_edges.RESOLVED_RPM].set_index("edges")
        self.assertLess(edges["mean_n"].max() / edges["mean_n"].min(), 1.05)
        self.assertGreater(edges["peak_over_mean"].iloc[0], 1.5 * edges["peak_over_mean"].iloc[-1])
        self.assertAlmostEqual(edges["one_tooth_n"].iloc[-1] * edges.index[-1], edges["mean_n"].iloc[-1])
        speeds = table[table["rpm"] != force_edges.RESOLVED_RPM].sort_values("rpm")
        times_faster = speeds["rpm"].iloc[-1] / speeds["rpm"].iloc[0]
        self.assertAlmostEqual(speeds["mean_n"].iloc[0] / speeds["mean_n"].iloc[-1], times_faster, delta=0.5)


class StudyTest(unittest.TestCase):
    def test_quick_study_draws_every_chart(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            with open(out / "said", "w+") as said:
                arms.run(types.SimpleNamespace(quick=True), StudyRun(out, ["arms"], "", jobs=2, said=said, aside=said))
            tables = {name: pd.read_csv(out / f"{name}.csv") for name in ("encoder", "response", "springs", "slide")}
            charts = {name: (out / f"{name}.svg").read_text() for name in tables}
        self.assertEqual(list(tables["encoder"]["step_mm"]), [0.0, 0.0125, 0.1])
        self.assertTrue((tables["response"]["gain"] > 0.0).all())
        self.assertEqual(set(tables["springs"]["coupling"]), {"implicit", *arms.UNSPRUNG})
        sprung = tables["springs"][tables["springs"]["coupling"] == "implicit"].sort_values("stiffness_n_per_mm")
        shares = sprung.drop_duplicates("stiffness_n_per_mm")["share_of_peak"]
        self.assertTrue(shares.is_monotonic_increasing and 0.2 < shares.min() < shares.max() < 1.0, shares)
        self.assertEqual(set(tables["slide"]["way"]), set(arms.SLIDE_WAYS))
        for name, words in (("encoder", "encoder step, mm"), ("response", "phase, degrees"), ("springs", "share of the exact peak"),
                            ("slide", "as published")):
            self.assertIn(words, charts[name])


if __name__ == "__main__":
    unittest.main()
