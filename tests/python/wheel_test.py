"""`pip install ./python` in a virtual environment gives the module."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).parents[2]


class WheelTest(unittest.TestCase):
    def test_is_installed_in_a_virtual_environment(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", folder], check=True)
            python = pathlib.Path(folder) / "bin" / "python"
            alone = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
            done = subprocess.run([python, "-m", "pip", "install", "--no-build-isolation", "--no-index", REPOSITORY / "python"],
                                  env=alone, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            says = subprocess.run([python, "-c", "import osteomill as om; case = om.Case('tooth'); [frame] = om.render(case);"
                                   "print(om.__file__, om.__version__, case.bone.shape, frame['images']['view']['colour'].shape)"],
                                  env=alone, cwd=folder, capture_output=True, text=True, check=True).stdout
            self.assertTrue(says.startswith(folder), says)
            self.assertIn("(512, 512, 128) (480, 640, 3)", says)
            self.assertTrue((pathlib.Path(says.split()[0]).parent / "_core.pyi").exists())
        self.assertEqual([path.name for path in (REPOSITORY / "python").iterdir() if "egg" in path.name or path.name == "build"], [])


if __name__ == "__main__":
    unittest.main()
