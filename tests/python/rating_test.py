"""A case's rating puts simulated hands into the right order, and says the same everywhere."""

import concurrent.futures
import functools
import json
import multiprocessing
import pathlib
import subprocess
import tempfile
import unittest

from support import program

import osteomill as om


@functools.cache
def jaw():
    """Made once a process."""
    return om.Case("jaw")


def rated(motion, ms, file):
    with om.Session(jaw().with_(set=motion), hand="firm", record=file) as session:
        session.run(ms)
    with om.Recording(file) as recording:
        return recording.rating()


class CariesPreparations(unittest.TestCase):
    """Hands that are rated by the jaw's scale."""

    @classmethod
    def setUpClass(cls):
        held = tempfile.TemporaryDirectory()
        cls.addClassCleanup(held.cleanup)
        cls.folder = pathlib.Path(held.name)

    def check(self, depths_mm, widths_mm, different):
        """The first hand takes the lesion alone, the next go ever deeper, to the pulp; then each leaves more of the lesion."""
        motions = [(["trajectory.width_mm=5.6", f"trajectory.depth_mm={mm}"], 70_000) for mm in depths_mm]
        motions += [(["trajectory.depth_mm=4.4", f"trajectory.width_mm={mm}"], 45_000) for mm in widths_mm]
        with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
            found = [hand.result() for hand in [pool.submit(rated, motion, ms, self.folder / f"{number}.pcap")
                                                for number, (motion, ms) in enumerate(motions)]]
        points = [one["points"] for one in found]
        self.assertGreaterEqual(points[0], 0.9 * found[0]["most_points"])
        for worse_and_worse in (points[:len(depths_mm)], [points[0], *points[len(depths_mm):]]):
            self.assertEqual(worse_and_worse, sorted(worse_and_worse, reverse=True))
            self.assertLessEqual(worse_and_worse[-1], 0.25 * found[0]["most_points"])
        self.assertGreaterEqual(len(set(points)), different)
        return found


class RatingTest(CariesPreparations):
    def test_the_best_one_between_and_the_worst(self):
        found = self.check((4.4, 5.5, 7.0), (2.6,), different=3)

        report = self.folder / "report"
        subprocess.run([program("packet_replay"), self.folder / "0.pcap", "--report", report], check=True, capture_output=True)
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
