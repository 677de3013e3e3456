"""Files of the study `stability`, as they were in tests/data/stability_study."""

import json
import unittest

from study_files import DATA, expect_alike, expect_kept, run_of

from osteomill.studies import stability

KEPT = DATA / "stability_study"


class GoldenTest(unittest.TestCase):
    maxDiff = None

    def test_the_map_is_as_it_was(self):
        with run_of("stability", stability, "--quick", "--methods", "hold,implicit,interpolate+damper", "--grips", "light,firm",
                    "--delays", "0,1") as (out, said):
            expect_kept(self, out, KEPT / "map")
            self.assertIn("hold                               33.3   5.2      5.8   16.7    68.8   1.7      1.7\n", said)
            self.assertIn("met    cutting that is unstable, %: 0, at most 0\n", said)
            self.assertIn("met    largest jump between ticks, cutting on a real device, N: 0.108, at most 0.3 (implicit, cutting 3.5 mm "
                          "deep at 80000 rpm in bone of stiffness 0.4, light, 1000 Hz, 0 ticks late, real device)\n", said)
            for chart in ("cutting", "wall", "pareto", "errors"):
                self.assertIn("</svg>", (out / f"map_{chart}.svg").read_text())

    def test_the_map_of_edges_that_rub_is_as_it_was(self):
        with run_of("stability", stability, "--quick", "--edge-forces", "--methods", "hold,implicit") as (out, _):
            expect_kept(self, out, KEPT / "map_edges")
            self.assertEqual([chart.name for chart in out.glob("*.svg")], ["map_cutting.svg"])

    def test_sites_are_as_they_were(self):
        with run_of("stability", stability, "--sites", "--quick", "--only", "tilted") as (out, said):
            expect_kept(self, out, KEPT / "sites")
            self.assertIn("</svg>", (out / "sites.svg").read_text())
            self.assertIn("worst: ", said)

    def test_walks_are_as_they_were(self):
        with run_of("stability", stability, "--sites", "--quick", "--walks", "3", "--seed", "5", "--only", "walk") as (out, _):
            expect_kept(self, out, KEPT / "walks")

    def test_motions_on_rails_are_as_they_were(self):
        with run_of("stability", stability, "--rails", "5", "--seed", "3", "--methods", "implicit,hold", "--edge-forces") as (out, said):
            kept = json.loads((KEPT / "rails.json").read_text())
            expect_alike(self, json.loads((out / "rails.json").read_text()), kept, "rails.json")
            expect_alike(self, json.loads(said), kept, "what it says")


if __name__ == "__main__":
    unittest.main()
