"""The study `render`: pictures are as accurate as before (tests/data/render_study, by Mesa's llvmpipe); no time is asserted."""

import json
import unittest

import pandas as pd
from study_files import DATA, run_of

from osteomill import _studies
from osteomill.studies import render, render_charts, render_full_rate
from osteomill.studies.charts import svg_of
from osteomill.studies.options import UsageError
from osteomill.studies.program import parser_of


def options_of(*words):
    return parser_of("render", render).parse(list(words))


def what_draws():
    try:
        return _studies.what_draws()
    except RuntimeError as error:
        raise unittest.SkipTest(str(error)) from None


class AccuracyTest(unittest.TestCase):
    def test_pictures_are_as_true_as_they_were(self):
        renderer, is_software = what_draws()
        with run_of("render", render, "--quick", jobs=1) as (out, said):
            found = pd.read_csv(out / "accuracy.csv")
            report = json.loads((out / "render.json").read_text())
            self.assertIn("</svg>", (out / "render_accuracy.svg").read_text())
        self.assertTrue(said.startswith(f"drawn by {renderer}\n"))
        self.assertIn("real CT skipped: --quick\n", said)
        self.assertLess(report["cut_wall"]["p95_deg"], 1.0)
        self.assertEqual([wall["px_per_voxel"] for wall in report["cut_wall"]["pictures"]], [4.0, 10.0, 20.0])
        kept = pd.read_csv(DATA / "render_study" / "accuracy.csv")
        told = ["panel_number", "panel", "bone", "view", "family", "label", "step_voxels", "skips", "divisor", "is_default"]
        pd.testing.assert_frame_equal(found[told], kept[told])
        self.assertTrue((found["frame_ms"] > 0.0).all())
        tolerance_db = 0.05 if is_software else 3.0
        for column, tolerance in (("psnr_db", tolerance_db), ("ssim", 0.01)):
            self.assertLess((found[column] - kept[column]).abs().max(), tolerance, column)

    def test_varies_every_axis_by_itself_from_the_default(self):
        settings = render.settings_of(False)
        [default] = [setting for setting in settings if setting["is_default"]]
        axes = ("renderer", "step_voxels", "skips", "divisor", "look")
        for setting in settings:
            changed = [axis for axis in axes if setting[axis] != default[axis]]
            self.assertLessEqual(len(changed), 3, setting)
        self.assertEqual(len({json.dumps(setting, sort_keys=True) for setting in settings}), len(settings))
        names = [render.name_of(case) for case in render.cases_of([render.TOOTH, render.SKULL], [640, 480], False)]
        self.assertEqual(len(set(names)), len(names))
        self.assertIn("skull CT, close-up, rays to surface voxels", names)

    def test_options_that_do_not_belong_together_are_refused(self):
        for words, reason in ((("--size-px", "160x90"), "--size-px requires --full-rate"), (("--frames", "3"), "--frames requires --full-rate"),
                              (("--full-rate", "--size-px", "160x90", "--width-px", "100"), "--size-px excludes --width-px")):
            with self.assertRaisesRegex(UsageError, reason):
                render.run(options_of(*words), None)
        with self.assertRaisesRegex(UsageError, "'wide', not WIDTHxHEIGHT"):
            options_of("--full-rate", "--size-px", "wide")


class FullRateTest(unittest.TestCase):
    def frames(self, ms):
        return {"wall_ms": [ms, 3.0 * ms], "gpu_ms": [ms, ms], "cpu_ms": [ms, ms]}

    def test_frames_a_second_are_of_all_frames_together(self):
        drawn = {phantom: {"orbit": self.frames(1.0), "carve": self.frames(2.0), "orbit_side_by_side": self.frames(1.5),
                           "orbit_both_whole": self.frames(2.0)} for phantom in render_full_rate.PHANTOMS}
        table = render_full_rate.table_of(drawn, [160, 90], "made up")
        self.assertEqual(table["frames_per_s"].iloc[0], 500.0)
        self.assertEqual(render_full_rate.two_eyes_to_one(table, "tooth"), {"side_by_side": 1.5, "quad_buffer": 2.0})
        self.assertIn("</svg>", svg_of(render_charts.full_rate(table, "made up")))

    def test_a_software_rasteriser_is_told_of(self):
        lines = render_full_rate.lines_before("llvmpipe", True, [640, 360], 8, False)
        self.assertEqual(lines[1], "no GPU: a software rasteriser draws, and the goals are not for it")
        self.assertIn("--size-px 2560x1440 --frames 600", lines[2])
        self.assertEqual(len(render_full_rate.lines_before("a card", False, [640, 360], 8, False)), 1)

    def test_measures_uploads_of_a_carve(self):
        what_draws()
        upload = _studies.upload_carves("tooth", 2)
        self.assertEqual(upload["times_coarser"], 1)
        self.assertEqual(sum(upload["textures"].values()), upload["texture_bytes"])
        for of in ("upload_of_frame", "upload_of_5_mm_ball"):
            self.assertEqual(len(upload[of]["wall_ms"]), 2)
        self.assertEqual(len(render_full_rate.lines_of_upload("tooth", upload, "any")), 2)
        self.assertNotIn("description", render_full_rate.figures_of(upload))
        table = render_full_rate.table_of_uploads({"tooth": upload})
        self.assertEqual(table.groupby("cut")["upload_ms"].count().to_dict(), {"a ball of 5 mm at once": 2, "what the 5 mm burr cuts in a frame": 2})
        self.assertIn("</svg>", svg_of(render_charts.uploads(table, "made up")))


if __name__ == "__main__":
    unittest.main()
