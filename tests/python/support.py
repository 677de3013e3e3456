"""Parts that the tests share: the tooth, loaded once a process, motions through it, and the programs."""

import functools
import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

import numpy as np

import osteomill as om


@functools.cache
def tooth():
    return om.Case("tooth")


def plunge(case, ms, depth_mm):
    """A hand that goes straight down from the case's start: (ms, 3)."""
    hands = np.tile(case.start_mm, (ms, 1))
    return hands - np.linspace(0.0, depth_mm, ms)[:, None] * case.start_axis


def program(name):
    return str(pathlib.Path(os.environ["OSTEOMILL_PROGRAMS"]) / name)


def run_study(*words, **settings):
    """osteomill_study to its end, with its output."""
    return subprocess.run([program("osteomill_study"), *words], capture_output=True, text=True, stdin=subprocess.DEVNULL, **settings)


class FolderTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


def eventually(holds, longest_s=120.0):
    """True as soon as `holds()`; false after a time that only a defect can take."""
    until = time.monotonic() + longest_s
    while not holds():
        if time.monotonic() > until:
            return False
        time.sleep(0.01)
    return True


def run_server(folder, *arguments):
    """Runs haptic_server on the virtual clock; returns its measurements, its log, column by column and line by line, and its messages."""
    json_file, log = folder / "session.json", folder / "log.csv"
    finished = subprocess.run(
        [program("haptic_server"), "--clock", "virtual", "--json", json_file, "--log-csv", log, *arguments],
        check=True, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    table = np.genfromtxt(log, delimiter=",", names=True)
    return json.loads(json_file.read_text()), table, log.read_text().splitlines(), finished.stderr
