#!/usr/bin/env python3
"""Costs of a session from Python and from C++, along the same motion: 2 s in which the tooth's burr plunges and circles. CPU time
of this process, the least of several repeats taken in turn, so that other programs do not matter much.

    PYTHONPATH=build/release/python python3 tests/benchmarks/python_benchmark.py [--sessions 1000]

It needs the target `benchmarks`, for session_benchmark; build/release unless OSTEOMILL_BUILD names another folder."""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np

BUILD = pathlib.Path(os.environ.get("OSTEOMILL_BUILD", pathlib.Path(__file__).parents[2] / "build" / "release"))
TICKS, REPEATS = 2000, 12


def motion(start_mm):
    """Down for half a second, then circles; the pedal is down."""
    s = np.arange(1, TICKS + 1) / 1000.0
    angle = 2 * np.pi * np.maximum(0.0, s - 0.5)
    hands = np.tile(start_mm, (TICKS, 1))
    hands[:, 0] += 0.5 * np.sin(angle)
    hands[:, 1] += 0.5 * (1.0 - np.cos(angle))
    hands[:, 2] -= np.minimum(s, 0.5) / 0.5 * 3.0 + 0.2 * np.maximum(0.0, s - 0.5)
    return hands


def timed(work):
    began = time.process_time()
    result = work()
    return time.process_time() - began, result


def step_all(session, hands):
    for hand in hands:
        session.step(hand_mm=hand, pedal=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split(":")[0])
    arguments.add_argument("--sessions", type=int, default=40, help="so many for the sessions a second")
    sessions = arguments.parse_args().sessions
    importing = [float(subprocess.run([sys.executable, "-c", "import time; t = time.process_time(); import osteomill; print(time.process_time() - t)"],
                                      capture_output=True, text=True, check=True).stdout) for _ in range(5)]
    import osteomill as om
    print(f"import, with numpy: {min(importing):.3f} s")
    loading, case = timed(lambda: om.Case("tooth"))
    print(f"the tooth is loaded in {loading:.2f} s")
    hands = motion(case.start_mm)
    makes, rollouts, steps, cpps = [], [], [], []
    with tempfile.NamedTemporaryFile() as file:
        np.column_stack([hands, np.tile(case.start_axis, (TICKS, 1)), np.ones(TICKS)]).tofile(file.name)
        for _ in range(REPEATS):
            made, session = timed(lambda: om.Session(case))
            makes.append(made)
            rollouts.append(timed(lambda: session.rollout(hands, pedals=True))[0])
            other = om.Session(case)
            steps.append(timed(lambda: step_all(other, hands))[0])
            lines = subprocess.run([BUILD / "bin" / "session_benchmark", file.name, "2"], capture_output=True, text=True, check=True)
            for line in lines.stdout.splitlines():
                _, _, ticking, checksum, _ = line.split()
                cpps.append(float(ticking))
                assert checksum == session.bone.checksum() == other.bone.checksum(), "not the same session"
    cpp, rollout, step = min(cpps), min(rollouts), min(steps)
    print(f"a session is made in {min(makes):.3f} s, after the first")
    print(f"C++:          {TICKS / cpp:8.0f} steps a second")
    print(f"rollout:      {TICKS / rollout:8.0f} steps a second, {100 * (rollout / cpp - 1):+.1f} %")
    print(f"step by step: {TICKS / step:8.0f} steps a second, {1e6 * (step - cpp) / TICKS:+.2f} us a step")

    def whole(_):
        om.Session(case).rollout(hands, pedals=True)

    alone, _ = timed(lambda: [whole(i) for i in range(sessions)])
    print(f"{sessions} sessions of {TICKS / 1000:g} s: {sessions / alone:.1f} a second of a core, {sessions * TICKS / 1000 / alone:.1f} times real time")
    began = time.perf_counter()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(whole, range(sessions)))
    print(f"in {os.cpu_count()} threads: {sessions / (time.perf_counter() - began):.1f} a second of the clock, on this machine as it is now")


if __name__ == "__main__":
    main()
