"""The study `stability`: its points, and the evaluation of a whole map and of sites, from made-up outcomes."""

import math
import unittest

import pandas as pd
from study_files import run_of

from osteomill import _studies
from osteomill.studies import stability, stability_map, stability_onset, stability_regions, stability_sites
from osteomill.studies.options import UsageError
from osteomill.studies.program import parser_of
from osteomill.studies.stability_points import CONDITIONS, map_points, text_of
from osteomill.studies.tables import csv_of


def options_of(*words):
    return parser_of("stability", stability).parse(list(words))


def outcome(point):
    """Stable up to half a millimetre and 400 N/m; the error is a tenth of the truth's 2 N, a fifth on the bare arm."""
    is_cutting = point["scene"] == "cutting"
    resistance = 4e6 * point["depth_mm"] * point["relative_stiffness"] / point["spindle_rpm"] if is_cutting else 0.0
    return {"is_stable": point["depth_mm"] <= 0.5 if is_cutting else point["wall_n_per_mm"] <= 0.4,
            "resistance_n_s_per_m": resistance, "truth_mean_n": 2.0, "limit_cycle_n": 0.0, "injected_mj": 0.0,
            "rms_error_n": 0.4 if point["grip"] == "bare-arm" else 0.2, "mean_error_n": 0.0, "peak_n": 1.0 + point["depth_mm"],
            "largest_jump_n": 0.0, "depth_error_mm": 0.0, "removed_mm3": 1.01 if point["milling_rate_hz"] == 100.0 else 1.0,
            "max_residual_n": 0.0, "fallbacks": 0.0, "energy_faults": 0.0}


def whole_map(*words, outcome=outcome):
    points = stability.selected_points(options_of(*words))
    return stability_map.map_of(points, [outcome(point) for point in points])


class PointsTest(unittest.TestCase):
    def test_span_the_resistance_that_a_surgeon_meets_in_even_steps(self):
        from osteomill import Burr

        resistances = []
        for rpm, depth_mm, stiffness in CONDITIONS:
            force_n = _studies.reference_force(Burr(diameter_mm=5.0, rpm=rpm), (0, 0, 2.5 - depth_mm), (0, 0, 1), (1, 0, 0))
            resistances.append(1000.0 * stiffness * math.hypot(*force_n))
        self.assertLess(resistances[0], 6.0)
        self.assertGreater(resistances[-1], 3400.0)
        for low, high in zip(resistances, resistances[1:]):
            self.assertTrue(1.2 < high / low < 1.5, (low, high))

    def test_are_each_on_the_list_once(self):
        points = map_points(False, False)
        self.assertEqual(len({point["part"] + text_of(point) for point in points}), len(points))
        self.assertEqual(sum(point["part"] == "bars" for point in points), 5 * 4 * 3 * 3 * 2)

    def test_are_those_that_are_selected(self):
        points = stability.selected_points(options_of("--quick", "--methods", "hold", "--grips", "firm", "--delays", "1"))
        wanted = [point for point in map_points(True, False)
                  if (point["method"], point["grip"], point["delay_ticks"]) == ("hold", "firm", 1)]
        self.assertTrue(wanted)
        self.assertEqual(points, wanted)
        fed = stability.selected_points(options_of("--quick", "--methods", "hold", "--grips", "firm", "--delays", "1", "--feed-forward"))
        self.assertEqual(fed, [point | {"feed_forward": True} for point in wanted])

    def test_with_edges_that_rub_cut_where_a_hand_gets_on(self):
        points = stability.selected_points(options_of("--edge-forces", "--methods", "implicit"))
        without = stability.selected_points(options_of("--methods", "implicit"))
        self.assertTrue(len(without) / 8 < len(points) < len(without))
        for point in points:
            self.assertEqual((point["scene"], point["edge_n_per_mm"]), ("cutting", 0.3))
            self.assertLess(point["depth_mm"], 1.0, "deeper the edges alone take all that a hand gives")

    def test_are_run_by_scene_and_hand(self):
        points = map_points(True, False)
        cases = stability.cases_of(points)
        self.assertEqual(sum(len(case["points"]) for case in cases), len(points))
        self.assertEqual(len({stability.name_of(case) for case in cases}), len(cases))

    def test_of_options_that_exclude_one_another_are_refused(self):
        for words, reason in ((("--sites", "--grips", "firm"), "--sites excludes --grips"), (("--walks", "3"), "--walks requires --sites"),
                              (("--sites", "--rails", "3"), "--rails excludes --sites"),
                              (("--onset", "--sites"), "--onset excludes --sites"), (("--onset", "--delays", "1"), "--onset excludes --delays"),
                              (("--onset", "--edge-forces"), "--onset excludes --edge-forces"),
                              (("--only", "x"), "--only requires --sites")):
            with self.assertRaisesRegex(UsageError, reason):
                stability.run(options_of(*words), None)
        for words, reason in ((("--methods", "glue"), "'glue' is not one of implicit"), (("--milling-rates-hz", "50"), "50 is not one of 100"),
                              (("--delays", "7"), "7 not in range")):
            with self.assertRaisesRegex(UsageError, reason):
                options_of(*words)


class MapTest(unittest.TestCase):
    def test_a_score_counts_the_stable_and_takes_their_median_error(self):
        whole = whole_map("--quick", "--methods", "hold,interpolate")
        scores = stability_map.scores(whole, "map", "cutting")
        self.assertEqual(scores["method"].tolist(), ["hold", "interpolate"])
        self.assertAlmostEqual(scores["share"][0], 1.0 / 3.0, msg="two of six slots")
        self.assertAlmostEqual(scores["median_rms_error"][0], 0.1)
        self.assertAlmostEqual(scores["worst_rms_error"][0], 0.2)
        summary = stability_map.summary_of(whole, {})["methods"]["hold"]
        self.assertAlmostEqual(summary["cutting"]["stable_share"], 1.0 / 3.0)
        self.assertEqual(summary["wall"]["stable_up_to_n_per_mm"]["firm"], 0.1)
        self.assertEqual(summary["cutting"]["stable_up_to_n_s_per_m"]["firm"], 20.0)

    def test_a_method_that_is_stable_nowhere_has_no_error_to_draw(self):
        whole = whole_map("--quick", "--methods", "hold", outcome=lambda point: outcome(point) | {"is_stable": False})
        self.assertEqual(csv_of(stability_regions.pareto_table_of(whole, "wall")).splitlines()[1], "3,hold,0,")

    def test_bars_are_held_against_the_worst(self):
        whole = whole_map("--quick", "--methods", "implicit")
        bars = stability_map.bars_of(whole)
        self.assertEqual(len(bars), 11)
        slots = whole[(whole["scene"] == "cutting") & whole["is_ideal_device"] & (whole["delay_ticks"] <= 1)]
        self.assertAlmostEqual(bars[0]["worst"], 100.0 * (~slots["is_stable"]).mean())
        self.assertIn("mm deep", bars[0]["where"])
        self.assertFalse(bars[0]["is_met"])
        self.assertFalse(bars[6]["is_met"], "walls of more than 0.4 N/mm")
        self.assertAlmostEqual(bars[1]["worst"], 20.0, msg="rms error")
        self.assertAlmostEqual(bars[3]["worst"], 6.0, msg="force")
        self.assertAlmostEqual(bars[5]["worst"], 1.0, msg="bone carved at either rate")
        self.assertTrue(all(bars[i]["is_met"] for i in (5, 8, 9, 10)))
        self.assertEqual(stability_map.bars_of(whole_map("--quick", "--methods", "hold")), [])

    def test_a_bar_of_points_that_a_part_of_the_map_lacks_is_no_miss(self):
        said = "\n".join(stability_map.lines_of(whole_map("--quick", "--methods", "implicit", "--milling-rates-hz", "1000")))
        self.assertIn("-      bone carved, 100 Hz against 1000 Hz, %: this part of the map has no such point", said)
        self.assertNotIn("nan", said)

    def test_a_fallback_anywhere_misses_the_bar(self):
        def fell_back(point):
            of_walls = {"max_residual_n": 0.002, "fallbacks": 3.0, "energy_faults": 1.0}
            return outcome(point) | (of_walls if point["scene"] == "wall" and point["is_ideal_device"] else {})

        bars = stability_map.bars_of(whole_map("--quick", "--methods", "implicit", outcome=fell_back))
        self.assertFalse(any(bar["is_met"] for bar in bars[8:]))
        self.assertIn("wall of", bars[9]["where"])

    def test_regions_join_neighbours_that_are_alike(self):
        whole = whole_map("--methods", "hold", "--grips", "light", "--milling-rates-hz", "1000", "--delays", "0")
        # Boxes meet at sqrt(0.32 * 0.47), the lowest begins at 0.1 / sqrt(1.5).
        self.assertEqual(csv_of(stability_regions.region_table_of(whole, "wall")),
                         "number,method,grip,x_low,x_high,y,stable\n3,hold,2,0.0816497,0.387814,1,1\n3,hold,2,0.387814,2.21653,1,0\n")

    def test_tables_have_a_line_a_point(self):
        whole = whole_map("--quick", "--methods", "hold", "--grips", "light")
        lines = csv_of(stability_map.table_of(whole, outcome(map_points(True, False)[0]))).splitlines()
        self.assertEqual(len(lines), len(whole) + 1)
        self.assertTrue(lines[1].startswith("map,hold,cutting,light,100,0,1,80000,0.1,1,1.5,1,5,2,"), lines[1])
        errors = csv_of(stability_regions.error_table_of(whole))
        self.assertIn("\n3,hold,light,5,10,1\n", errors)
        self.assertNotIn("firm", errors)


class SitesTest(unittest.TestCase):
    def site(self, name, **changes):
        return {"kind": "edge", "name": name} | dict.fromkeys(stability_sites.COLUMNS, 0.0) | {"faults": 0} | changes

    def test_are_found_by_part_of_their_name(self):
        words = ("--sites", "--quick", "--walks", "3")
        cases = stability_sites.cases_of(options_of(*words))
        self.assertGreater(len(cases), 30)
        names = [stability_sites.name_of(case) for case in cases]
        self.assertEqual(len(set(names)), len(names))
        [walk] = stability_sites.cases_of(options_of(*words, "--only", "walk 2 of seed 1"))
        self.assertEqual(stability_sites.site_of(walk).kind, "random walk")
        self.assertEqual(stability_sites.cases_of(options_of(*words, "--only", "nowhere")), [])

    def test_are_held_against_their_bars(self):
        sites = stability_sites.judged(pd.DataFrame([
            self.site("quiet"), self.site("off", error_percent=10.0), self.site("off", kind="breakthrough", error_percent=10.0),
            self.site("faulty", faults=1), self.site("jumps", largest_jump_n=0.4)]))
        self.assertEqual(sites["is_met"].tolist(), [True, False, True, False, False])

    def test_the_worst_is_named_with_its_command(self):
        sites = stability_sites.judged(pd.DataFrame([self.site("good", stuck_ms=5.0), self.site("bad", stuck_ms=500.0)]))
        summary = stability_sites.summary_of(sites, options_of("--sites", "--walks", "2", "--seed", "9"))
        self.assertEqual(summary["kinds"]["edge"]["met"], 1)
        self.assertEqual(summary["worst"][0]["name"], "bad")
        self.assertEqual(summary["worst"][0]["command"],
                         "osteomill_study stability --sites --walks 2 --seed 9 --methods implicit --only 'bad'")

    def test_one_alone_leaves_every_tick(self):
        with run_of("stability", stability, "--sites", "--quick", "--walks", "1", "--only", "walk 1 of seed 1") as (out, _):
            trace = pd.read_csv(out / "trace.csv")
        self.assertGreater(len(trace), 1000)
        self.assertEqual(trace["t_s"].iloc[1], 0.001)
        self.assertEqual(set(trace["spindle"]), {0, 1})


class OnsetTest(unittest.TestCase):
    def outcome(self, felt_n):
        return {"exact_peak_n": 2.0, "exact_half_ms": 10.0, "ideal_peak_n": 1.0, "ideal_half_ms": 12.0, "felt_peak_n": felt_n,
                "felt_half_ms": 15.0}

    def test_shares_are_of_the_exact_peak(self):
        cases = stability_onset.cases_of(options_of("--onset", "--quick"))
        self.assertEqual(len({stability_onset.name_of(case) for case in cases}), len(cases))
        plunges = [case for case in cases if case["kind"] != stability_onset.ENTRY]
        table = stability_onset.table_of(plunges, [self.outcome(1.0 if place else 0.9) for place in range(len(plunges))])
        self.assertAlmostEqual(table["felt_share"][0], 0.45)
        self.assertAlmostEqual(table["points"][0], -5.0)
        self.assertAlmostEqual(table["felt_late_ms"][0], 5.0)
        self.assertEqual(stability_onset.bar_line_of(table), f"MISSED {len(plunges) - 1} of {len(plunges)} plunges within 3 points of the "
                         "ideal spring's share")
        self.assertIn("plunge, 3 mm, prescribed, 1.5 N/mm, implicit      0.47 (0.50)  -5.0 to +0.0     +3 to +3", stability_onset.lines_of(table))

    def test_prints_and_keeps_its_table(self):
        with run_of("stability", stability, "--onset", "--quick") as (out, said):
            table = pd.read_csv(out / "onset.csv")
        self.assertIn("met    24 of 24 plunges within 3 points", said)
        self.assertEqual(len(table), 36)
        plunges = table[table["kind"] != stability_onset.ENTRY]
        self.assertTrue((plunges["ideal_share"] < 1.0).all() and (plunges["points"].abs() > 0.0).all())
        self.assertFalse((out / "onset.svg").exists())
        with self.assertRaisesRegex(ValueError, "glue"):
            stability_onset.measure(stability_onset.cases_of(options_of("--onset"))[0] | {"method": "glue"})

    def test_with_the_feed_forward_both_are_run_and_drawn(self):
        words = ("--onset", "--quick", "--feed-forward")
        with run_of("stability", stability, *words) as (out, said):
            table = pd.read_csv(out / "onset.csv")
            self.assertIn("N/mm with feed-forward", (out / "onset.svg").read_text())
        self.assertIn("met    24 of 24 plunges within 3 points", said, "without it")
        # A firm hand's plunge at 20 mm/s, on the springs of arms that there are.
        guided = table[(table["hand"] == "guided") & (table["kind"] != stability_onset.ENTRY) & (table["stiffness_n_per_mm"] < 5.0)]
        shares = guided.groupby("method")["felt_share"].mean()
        self.assertGreater(shares["implicit with feed-forward"], shares["implicit"] + 0.1)
        self.assertLess(guided["felt_share"].max(), 1.1)


if __name__ == "__main__":
    unittest.main()
