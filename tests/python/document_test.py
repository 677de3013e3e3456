"""Every line of Python in docs/python.md runs, from the first to the last; and the reference equals the docstrings."""

import contextlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).parents[2]


def blocks_of(page, language):
    """Each with the lines before it."""
    text = page.read_text()
    return [(text.count("\n", 0, match.start(1)), match[1]) for match in re.finditer(rf"^```{language}\n(.*?)^```", text, re.M | re.S)]


class DocumentTest(unittest.TestCase):
    def test_every_line_of_the_tutorial_runs(self):
        page = REPOSITORY / "docs" / "python.md"
        blocks = blocks_of(page, "python")
        self.assertGreater(len(blocks), 9)
        printed, names = io.StringIO(), {}
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder), contextlib.redirect_stdout(printed):
            for line, block in blocks:
                exec(compile("\n" * line + block, page, "exec"), names)
        self.assertIn("'carious lesion': 7", printed.getvalue())
        self.assertGreater(names["removed"], 0.5)
        self.assertGreater(names["force_n"].max(), 0.1)

    def test_the_first_image_set_and_its_frames_in_python_are_made_as_written(self):
        page = REPOSITORY / "docs" / "datasets.md"
        _, commands = blocks_of(page, "sh")[0]
        self.assertIn("--duration-s 4 ", commands)
        commands = commands.replace("--duration-s 4 ", "--duration-s 1 ")  # a quarter of the pictures
        [(line, block)] = blocks_of(page, "python")
        printed = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder), contextlib.redirect_stdout(printed):
            pathlib.Path("build/release").mkdir(parents=True)
            pathlib.Path("build/release/bin").symlink_to(os.environ["OSTEOMILL_PROGRAMS"])
            pathlib.Path("out").mkdir()
            ran = subprocess.run(["bash", "-euc", commands], capture_output=True, text=True)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertIn('"conventions"', ran.stdout)
            exec(compile("\n" * line + block, page, "exec"), {})
            self.assertEqual(len(printed.getvalue().splitlines()), len(list(pathlib.Path("out/mastoid/view").glob("*_colour.png"))))

    def test_the_reference_is_what_the_docstrings_say(self):
        made = subprocess.run([sys.executable, REPOSITORY / "scripts" / "python_reference.py"], check=True, capture_output=True,
                              text=True, env=os.environ).stdout
        self.assertEqual((REPOSITORY / "docs" / "python_reference.md").read_text(), made,
                         "make it anew: scripts/python_reference.py > docs/python_reference.md")


if __name__ == "__main__":
    unittest.main()
