"""The mastoid's rating puts a good hand before one that opens the dura, and that before one that does not come half way."""

import unittest

from mastoidectomies import Mastoidectomies


class ThreeHands(Mastoidectomies):
    def test_are_in_their_order(self):
        self.check([(17.0, 7.5, 6.3)], [(9.0, 5.3, 4.5)])


if __name__ == "__main__":
    unittest.main()
