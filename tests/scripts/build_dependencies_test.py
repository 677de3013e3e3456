"""debian/control has the build dependencies of scripts/packages.txt: a library added to only one of them is found."""

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
