"""A case's rating puts ten simulated hands into the right order."""

import unittest

import rating_test


class TenHands(rating_test.CariesPreparations):
    def test_are_in_their_order(self):
        self.check((4.4, 5.0, 5.5, 6.0, 7.0), (5.0, 4.4, 3.8, 3.2, 2.6), different=5)


if __name__ == "__main__":
    unittest.main()
