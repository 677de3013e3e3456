"""Parts that the tests share: the tooth, loaded once a process, motions through it, and the programs."""

import functools
import json
import os
import pathlib
import subprocess

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


def run_server(folder, *arguments):
    """Runs haptic_server on the virtual clock; returns its measurements, and its log, column by column."""
    json_file, log = folder / "session.json", folder / "log.csv"
    subprocess.run(
        [program("haptic_server"), "--clock", "virtual", "--json", json_file, "--log-csv", log, *arguments],
        check=True, capture_output=True)
    table = np.genfromtxt(log, delimiter=",", names=True)
    return json.loads(json_file.read_text()), table, log.read_text().splitlines()
