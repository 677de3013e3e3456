"""Simulated hands that open a mastoid, well or badly, for tests of its rating."""

import concurrent.futures
import functools
import multiprocessing
import pathlib
import tempfile
import unittest

import numpy as np

import osteomill as om

MOUTH_MM, ANTRUM_MM = np.array([19.0, 12.0, 4.0]), np.array([6.0, 11.0, 5.5])  # the plan of the case
BURR_MM, LAYER_MM, TURN_MM, FEED_MM_PER_S = 5.0, 1.25, 1.5, 10.0

# Depth of the cavity along the plan, its radius at the mouth and at the floor, mm. The plan is 13 mm deep and 6 mm wide; the dura
# comes to 5.5 mm from its middle at 12 mm, the short process of the incus to 5.1 at 19, the facial nerve to 5.0 at 22.
BEST = (14.8, 6.5, 5.3)


def cavity_mm(depth_mm, mouth_mm, floor_mm):
    """The burr's centre, a row a millisecond: layer by layer, each in circles that widen."""
    into = (ANTRUM_MM - MOUTH_MM) / np.linalg.norm(ANTRUM_MM - MOUTH_MM)
    right, forward = np.linalg.svd(into[None])[2][1:]
    angles = np.linspace(0.0, 2.0 * np.pi, 60)[:, None]
    circle = np.cos(angles) * right + np.sin(angles) * forward
    outside_mm = MOUTH_MM - (0.5 * BURR_MM + 1.0) * into
    corners_mm = [outside_mm[None]]
    for share in np.linspace(0.0, 1.0, 1 + int(np.ceil(depth_mm / LAYER_MM)))[1:]:
        middle_mm = MOUTH_MM + (share * depth_mm - 0.5 * BURR_MM) * into
        widest_mm = mouth_mm + share * (floor_mm - mouth_mm) - 0.5 * BURR_MM
        radii_mm = np.linspace(0.0, widest_mm, 1 + int(np.ceil(widest_mm / TURN_MM)))[1:]
        corners_mm += [middle_mm[None], *(middle_mm + radius_mm * circle for radius_mm in radii_mm), middle_mm[None]]
    corners = np.concatenate([*corners_mm, outside_mm[None]])
    at_s = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1))]) / FEED_MM_PER_S
    time_s = 0.001 * np.arange(int(1000.0 * at_s[-1]))
    return np.stack([np.interp(time_s, at_s, corners[:, axis]) for axis in range(3)], axis=1), -into


@functools.cache
def mastoid():
    """Made once a process."""
    return om.Case("mastoid")


def rated(cavity, file):
    """The rating of a hand that makes it. The bone yields 100 times a second, which is quick."""
    hand_mm, axis = cavity_mm(*cavity)
    with om.Session(mastoid(), start_mm=hand_mm[0], start_axis=axis, milling_rate_hz=100.0, record=file) as session:
        session.rollout(hand_mm, pedals=True)
    with om.Recording(file) as recording:
        return recording.rating()


def points_without_force(rating):
    """Points of the items that the finished bone decides alone."""
    return sum(one["points"] for one in rating["items"] if one["is_reached"] and "force" not in one["when"])


class Mastoidectomies(unittest.TestCase):
    def check(self, bolder, more_timid):
        """After the best hand some go ever deeper and wider, to the labyrinth; then some leave ever more of the way to the antrum.

        By the bone that they leave they come in their order. The two items of force may change neighbours: they compare a hand to itself.
        So the first timid hand, 13.4 mm deep, has a point less than the second, 12 mm deep: both lack the free way to the antrum (75 and
        57 % of the plan) and have all else that bone decides, but near the dura the first cuts with 1.10 times its own force elsewhere,
        the second, which is farther from it, with 0.83.
        """
        hands = [BEST, *bolder, *more_timid]
        with tempfile.TemporaryDirectory() as folder, \
                concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
            files = [pathlib.Path(folder, f"{number}.pcap") for number in range(len(hands))]
            found = list(pool.map(rated, hands, files))
        points, most = [one["points"] for one in found], found[0]["most_points"]
        # A hand without a trainee's view has not the point for it, and the plan's last corners lie at the dura.
        self.assertGreaterEqual(points[0], most - 2)
        self.assertEqual(points[0], max(points), points)
        by_bone = [points_without_force(one) for one in found]
        self.assertLess(max(by_bone[1:]), by_bone[0])
        for row in (range(1 + len(bolder)), [0, *range(1 + len(bolder), len(hands))]):
            self.assertEqual([by_bone[hand] for hand in row], sorted((by_bone[hand] for hand in row), reverse=True))
            self.assertEqual(points[row[-1]], min(points[hand] for hand in row), points)
            self.assertLess(points[row[-1]], points[0], points)
            for better, worse in zip(row, row[1:]):
                self.assertLessEqual(points[worse], points[better] + 1, f"neighbours may change by a point: {points}")
