"""The mastoid's rating puts ten simulated hands into the right order: such as differ by more than the one point that forces near a structure give or take."""

import unittest

from mastoidectomies import Mastoidectomies


class TenHands(Mastoidectomies):
    def test_are_in_their_order(self):
        boldest = self.check([(17.0, 7.5, 6.3), (19.0, 9.0, 8.0), (22.0, 10.0, 9.0), (25.0, 11.0, 10.0)],
                             [(12.0, 5.8, 4.8), (10.5, 5.6, 4.8), (9.0, 5.3, 4.5), (6.0, 4.8, 4.0), (3.0, 4.3, 3.5)], different=6)
        self.assertLess(boldest, 0.75)


if __name__ == "__main__":
    unittest.main()
