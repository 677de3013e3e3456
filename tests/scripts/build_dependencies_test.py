"""debian/control builds with what scripts/packages.txt builds with: a library that joins one is missing in the other."""

import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop())
ONLY_FOR_TESTS = {"libgtest-dev", "libgmock-dev", "libbenchmark-dev"}


class BuildDependencies(unittest.TestCase):
    def test_name_every_library_that_the_programs_are_built_with(self):
        listed = {line for line in (SOURCE / "scripts/packages.txt").read_text().splitlines() if line.endswith("-dev")}
        fields = (SOURCE / "debian/control").read_text().split("\n\n")[0]
        build_depends = re.search(r"^Build-Depends:\n((?: .*\n?)+)", fields, re.MULTILINE).group(1)
        named = {word.strip(" ,") for word in build_depends.splitlines() if word.strip(" ,").endswith("-dev")}
        self.assertGreater(len(listed), 20)
        self.assertEqual(listed - ONLY_FOR_TESTS, named)


if __name__ == "__main__":
    unittest.main()
