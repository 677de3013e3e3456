"""The documents' claims about the milling force, on motions that nothing was tuned to."""

import json
import unittest

from support import FolderTest, run_study


class ForceClaims(FolderTest):
    def expect(self, cases, *options, **below):
        """So many random motions by `osteomill_study force`: each number of random.json is below its bar."""
        outcome = run_study("force", "--random", str(cases), *options, "--out", self.folder)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        found = json.loads((self.folder / "random.json").read_text())
        self.assertEqual(found["cases"], cases)
        for name, bar in below.items():
            self.assertLess(found[name], bar, name)
        return found


class ForceClaimsTest(ForceClaims):
    def test_hold_over_random_motions(self):
        # Slower steps than 5 mm/s take a level here and there of a voxel's 255.
        self.expect(500, "--seed", "20261122", median_error_percent=0.3, p95_error_percent=2.0, p99_error_percent=4.0,
                    max_error_percent=7.0, ripple_p90_from_5_mm_per_s_percent=2.5, ripple_p90_percent=5.0)

    def test_hold_with_edges_that_rub(self):
        self.expect(300, "--seed", "20261123", "--edge-forces", median_error_percent=0.5, p95_error_percent=3.0, p99_error_percent=6.0,
                    max_error_percent=12.0, window_p95_percent=10.0, largest_step_max=2.0)

    def test_hold_wherever_the_surface_lies_in_the_lattice(self):
        found = self.expect(60, "--seed", "20261126", "--offsets", along_max_change_percent=2.0, p95_change_percent=2.0)
        self.assertGreater(found["p50_change_percent"], 0.0)


if __name__ == "__main__":
    unittest.main()
