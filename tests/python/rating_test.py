"""Ratings of the built-in cases put simulated hands into the right order, and say the same everywhere."""

import json
import pathlib
import subprocess
import tempfile
import unittest

from support import program

import osteomill as om

MOST_MS = 200_000  # a hand ends where its trajectory does


class RatingTest(unittest.TestCase):
    """Ten hands a case, each a little worse than the one before: further beside the plan, and deeper or less deep."""

    def ratings(self, name, motions):
        case = om.Case(name)
        found = []
        for number, motion in enumerate(motions):
            file = self.folder / f"{name}{number}.pcap"
            with om.Session(case.with_(set=motion), hand="firm", record=file) as session:
                session.run(MOST_MS)
            with om.Recording(file) as recording:
                found.append(recording.rating())
        return found

    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = pathlib.Path(held.name)

    def check_order(self, found):
        points = [one["points"] for one in found]
        self.assertEqual(points, sorted(points, reverse=True))
        self.assertGreaterEqual(points[0], 0.9 * found[0]["most_points"])
        self.assertLessEqual(points[-1], 0.25 * found[0]["most_points"])
        self.assertGreaterEqual(len(set(points)), 6)

    def test_a_caries_preparation(self):
        # From over the lesion to the side, and from its floor into the pulp.
        self.check_order(self.ratings("jaw", [
            [f"trajectory.start_mm=[{-0.55 + 0.3 * worse}, -0.3, 6.6]", f"trajectory.depth_mm={4.4 + 0.25 * worse}"]
            for worse in range(10)]))

    def test_a_mastoidectomy(self):
        # From the way to the antrum back to the sinus, and ever less deep.
        found = self.ratings("mastoid", [
            [f"trajectory.start_mm=[19.0, {11.5 + 0.8 * worse}, 4.5]", f"trajectory.depth_mm={13.9 - 0.4 * worse}"]
            for worse in range(10)])
        self.check_order(found)
        visible = found[0]["items"][0]
        self.assertEqual(visible["values"], {"plan_removed_share": found[0]["items"][3]["values"]["plan_removed_share"], "burr_in_view_share": None})
        self.assertIsNone(visible["is_reached"], "nobody looked")
        report = self.folder / "report"
        subprocess.run([program("packet_replay"), self.folder / "mastoid0.pcap", "--report", report], check=True, capture_output=True)
        self.assertEqual(json.loads((report / "metrics.json").read_text())["rating"], found[0])

    def test_a_case_without_one_has_none(self):
        file = self.folder / "tooth.pcap"
        with om.Session(om.Case("tooth"), record=file) as session:
            session.step()
        with om.Recording(file) as recording:
            self.assertIsNone(recording.rating())
            self.assertNotIn("rating_share", recording.metrics())


if __name__ == "__main__":
    unittest.main()
