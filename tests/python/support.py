"""Parts that the tests share: the tooth, loaded once a process, motions through it, and the programs."""

import functools
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

REPOSITORY = pathlib.Path(__file__).parents[2]
LONGEST_S = 120.0  # a time that only a defect can take
NO_STUDY = "names no study that can be repeated"  # what several tests expect of a manifest
IS_SANITIZED = os.environ.get("OSTEOMILL_SANITIZER", "none") != "none"
IS_OPTIMISED = os.environ.get("OSTEOMILL_BUILD_TYPE", "Release") == "Release"


@functools.cache
def tooth():
    import osteomill  # not above: under the sanitizers the programs are tested where there is no package

    return osteomill.Case("tooth")


def plunge(case, ms, depth_mm):
    """A hand that goes straight down from the case's start: (ms, 3)."""
    hands = np.tile(case.start_mm, (ms, 1))
    return hands - np.linspace(0.0, depth_mm, ms)[:, None] * case.start_axis


def program(name):
    return str(pathlib.Path(os.environ["OSTEOMILL_PROGRAMS"]) / name)


def run(name, *words, **settings):
    """A program to its end, with its output."""
    streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.run([program(name), *words], text=True, **(streams | settings))


def run_study(*words, **settings):
    return run("osteomill_study", *words, **settings)


def disk_of(kibibytes):
    """`preexec_fn` of a program whose files may have so many KiB: a full disk."""
    return functools.partial(resource.setrlimit, resource.RLIMIT_FSIZE, 2 * (1024 * kibibytes,))


# A program inherits the peak of the one that starts it, so a small one does.
STARTER = """import os, sys
_, status, used = os.wait4(os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ), 0)
print(used.ru_maxrss)
sys.exit(os.waitstatus_to_exitcode(status))"""


def run_measured(name, *words):
    """A program to its end, and its peak resident bytes."""
    finished = subprocess.run([sys.executable, "-ISc", STARTER, program(name), *words], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    return finished, 1024 * int(finished.stdout.split()[-1])


class FolderTest(unittest.TestCase):
    """A test with a folder of its own, in which programs leave their files."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def json(self, name):
        return json.loads((self.folder / name).read_text())

    def run_to(self, status, name, *words, **settings):
        """A program that ends with this exit status."""
        finished = run(name, *words, **settings)
        self.assertEqual(finished.returncode, status, finished.stderr)
        return finished

    def expect_line(self, status, reason, name, *words, **settings):
        """A program that ends with this exit status and one line, which holds the reason."""
        said = self.run_to(status, name, *words, **settings).stderr
        self.assertEqual(said.count("\n"), 1, said)
        self.assertIn(reason, said)
        return said


def eventually(holds, longest_s=LONGEST_S, every_s=0.01):
    """True as soon as `holds()`; false after so long."""
    until = time.monotonic() + longest_s
    while not holds():
        if time.monotonic() > until:
            return False
        time.sleep(every_s)
    return True


def run_server(folder, *arguments):
    """Runs haptic_server on the virtual clock; returns its measurements, its log, column by column and line by line, and its messages."""
    json_file, log = folder / "session.json", folder / "log.csv"
    finished = run("haptic_server", "--clock", "virtual", "--json", json_file, "--log-csv", log, *arguments, check=True)
    table = np.genfromtxt(log, delimiter=",", names=True)
    return json.loads(json_file.read_text()), table, log.read_text().splitlines(), finished.stderr
