"""Round trips to an arm in another process, beside a bare echo of the same size: over a Unix socket, over UDP within this
machine, and between two network namespaces, each with the bridge's key and some without.

A thousand of each a second, in turns, so that the machine's other work affects both. Namespaces, which only root may
make, are left out with a line that says so.
"""

import argparse
from typing import Any

import numpy as np

from osteomill import _studies
from osteomill.studies.options import number_within
from osteomill.studies.study_run import StudyRun

JOBS = 1
ONE_BY_ONE = True  # it measures this machine

WAYS: dict[str, dict[str, Any]] = {
    "Unix socket": {"over": "unix", "has_key": False},
    "Unix socket, key": {"over": "unix", "has_key": True},
    "UDP, loopback": {"over": "udp", "has_key": False},
    "UDP, loopback, key": {"over": "udp", "has_key": True},
    "UDP, two namespaces, key": {"over": "namespaces", "has_key": True},
}
SHARES = {"p50_us": 50.0, "p99_us": 99.0, "p999_us": 99.9}


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--seconds", type=number_within(1.0, 3600.0), default=20.0, metavar="S",
                        help="that each way is measured (%(default)g)")
    parser.add_argument("--quick", action="store_true", help="two seconds each")


def measure(case: dict[str, Any]) -> dict[str, Any]:
    way = WAYS[case["way"]]
    bridge_us, echo_us = _studies.round_trips_us(way["over"], has_key=way["has_key"], seconds=case["seconds"])
    return {"bridge": numbers_of(bridge_us), "echo": numbers_of(echo_us)}


def numbers_of(trips_us: list[float]) -> dict[str, float]:
    return {"count": len(trips_us)} | {name: float(np.percentile(trips_us, share)) for name, share in SHARES.items()}


def run(options: argparse.Namespace, study: StudyRun) -> None:
    why_no_namespaces = _studies.why_no_namespaces()
    ways = [way for way, its in WAYS.items() if its["over"] != "namespaces" or not why_no_namespaces]
    cases = [{"way": way, "seconds": 2.0 if options.quick else options.seconds} for way in ways]
    outcomes = study.sweep(measure, cases, lambda case: str(case["way"]))
    found = {way: outcome | {"p99_ratio": outcome["bridge"]["p99_us"] / outcome["echo"]["p99_us"]}
             for way, outcome in zip(ways, outcomes)}
    study.say(f"{'':<34}{'bridge p50/p99/p99.9, us':>28}{'bare echo':>28}{'p99, times':>12}")
    for way, numbers in found.items():
        texts = [" / ".join(f"{numbers[what][share]:.0f}" for share in SHARES) for what in ("bridge", "echo")]
        study.say(f"{way:<34}{texts[0]:>28}{texts[1]:>28}{numbers['p99_ratio']:>12.2f}")
    if why_no_namespaces:
        study.say(f"two namespaces: left out; {why_no_namespaces}")
    study.json("bridge", found)
