"""The mastoid's rating puts ten simulated hands into their order by the bone that they leave; the items of force change neighbours by a point at most."""

import unittest

from mastoidectomies import Mastoidectomies


class TenHands(Mastoidectomies):
    def test_are_in_their_order(self):
        self.check([(17.0, 7.5, 6.3), (19.0, 9.0, 8.0), (22.0, 10.0, 9.0), (25.0, 11.0, 10.0)],
                   [(13.4, 6.2, 5.2), (12.0, 5.8, 4.8), (10.5, 5.6, 4.8), (9.0, 5.3, 4.5), (6.0, 4.8, 4.0)])


if __name__ == "__main__":
    unittest.main()
