"""The stubs match the module, and the package keeps to its types."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import osteomill as om


class TypesTest(unittest.TestCase):
    def run_tool(self, *command):
        package = str(pathlib.Path(om.__file__).parent.parent)
        with tempfile.TemporaryDirectory() as folder:  # mypy looks at modules of its working folder, and leaves a cache there
            done = subprocess.run([sys.executable, "-m", *command], cwd=folder, capture_output=True, text=True,
                                  env=os.environ | {"PYTHONPATH": package, "MYPYPATH": package})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_stubs_are_what_the_module_is(self):
        # pybind11's classes have a metaclass of their own, and those that nobody makes an __init__ that refuses.
        allowed = pathlib.Path(__file__).with_name("stubtest_allowed.txt")
        self.run_tool("mypy.stubtest", "osteomill._core", "osteomill._render", "osteomill._studies", "--allowlist", str(allowed), "--ignore-unused-allowlist")

    def test_the_package_keeps_to_its_types(self):
        # Debian 12's pandas, SciPy and matplotlib have no type annotations.
        self.run_tool("mypy", "--config-file", str(pathlib.Path(__file__).with_name("mypy.ini")), "-p", "osteomill")

    def test_everything_says_what_it_is(self):
        names = [getattr(om, name) for name in om.__all__ if name not in ("FAULTS", "__version__")]
        for thing in names:
            self.assertTrue(thing.__doc__, thing)
            for name, member in vars(thing).items() if isinstance(thing, type) else ():
                if not name.startswith("_") and callable(member):
                    self.assertTrue(member.__doc__, f"{thing.__name__}.{name}")


if __name__ == "__main__":
    unittest.main()
