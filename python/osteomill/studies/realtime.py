"""Wake-up latency and duration of the haptic loop's ticks, next to cyclictest.

On few processors the two cannot run at once without one being the other's load. They take turns, ten seconds each, under the same
priority, so that the machine's other work affects both; first as the machine is, then under stress-ng: every processor, memory
and the network. haptic_server works all the while: the tooth on the real clock, two clients that keep up, a recording, milling at
1 kHz; cyclictest does nothing but wake, one thread, a wake-up a millisecond, memory locked, and no other change of the system
than haptic_server makes.

A program that is not installed (cyclictest, stress-ng) is left out with a line that says so.
"""

import argparse
import contextlib
import functools
import math
import pathlib
import re
import shutil
from typing import Any

import pandas as pd

from osteomill import _studies
from osteomill.studies import latencies
from osteomill.studies.installed_programs import ChildProgram, own_program
from osteomill.studies.latencies import Latencies
from osteomill.studies.options import UsageError, number_within
from osteomill.studies.repeated_tables import foreign_json
from osteomill.studies.study_run import StudyRun

JOBS = 1
ONE_BY_ONE = True  # it measures this machine

USUAL_DURATION_S = 600.0
MOST_TIMES_CYCLICTEST = 1.5
MORE_LATE_TICKS_SHARE = 1e-5
BAR_QUANTILE = 0.999
PERIOD_US = 1000.0
ROOM_S = 60.0  # beyond the duration: to load, to join threads, to write
LONGEST_US = 20_000  # of cyclictest's histogram
STRESS = "stress-ng"
LOOPS = ("wakeup_latency", "haptic_tick", "milling_step")
COUNTS = ("ticks", "late_ticks", "missed_deadlines", "missed_milling_steps")


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--duration-s", type=number_within(10.0, 86_400.0), metavar="S",
                        help=f"how long each of the two is measured, without load and again under it ({USUAL_DURATION_S:g})")
    parser.add_argument("--quick", action="store_true", help="9 s each: shows that it works, not how long the tail is")


def run(options: argparse.Namespace, study: StudyRun) -> None:
    if options.quick and options.duration_s:
        raise UsageError("--quick excludes --duration-s")
    own_program("haptic_server")
    if not shutil.which("cyclictest"):
        study.say("cyclictest is not installed (package rt-tests): nothing to compare with")
    loads = ["no load", STRESS]
    if not shutil.which(STRESS):
        study.say("stress-ng is not installed (package stress-ng): not measured under load")
        loads.remove(STRESS)
    slice_s = 3.0 if options.quick else 10.0
    slices = math.ceil((9.0 if options.quick else options.duration_s or USUAL_DURATION_S) / slice_s)
    cases = [{"load": load, "slice": number, "slice_s": slice_s} for load in loads for number in range(1, slices + 1)]
    outcomes = study.sweep(functools.partial(measure, study.out), cases, lambda case: f"{case['load']}, slice {case['slice']}")
    found, rows = [], []
    for load in loads:
        gathered = gather(load, [outcome for case, outcome in zip(cases, outcomes) if case["load"] == load])
        for line in lines_of(gathered):
            study.say(line)
        found.append(summary_of(gathered))
        for name, what in (("wakeup_latency", "wakeup"), ("haptic_tick", "haptic tick"), ("milling_step", "milling step"),
                           ("cyclictest", "cyclictest")):
            rows += [{"load": load, "what": what} | one for one in gathered[name].bins()]
    table = pd.DataFrame(rows)
    study.table("latencies", table)
    study.json("realtime", found)
    from osteomill.studies.realtime_chart import chart_of

    study.chart("realtime", chart_of(table))
    study.say(f"realtime.json, latencies.csv and realtime.svg are in {study.out}")


def measure(out: pathlib.Path, case: dict[str, Any]) -> dict[str, Any]:
    """A slice of both, one in turn with the other."""
    work = out / f"{case['load']}-{case['slice']}"
    work.mkdir(exist_ok=True)
    slice_s = case["slice_s"]
    with contextlib.ExitStack() as around:
        stress = around.enter_context(_stress(2.0 * (slice_s + ROOM_S))) if case["load"] == STRESS else None
        measured = serve(slice_s, work)
        if cyclictest := shutil.which("cyclictest"):
            measured["cyclictest"] = cycle(cyclictest, slice_s, measured["real_time_priority"], work)
        if stress and not stress.is_running():
            raise RuntimeError("stress-ng ended by itself: the load was not there")
    shutil.rmtree(work)
    return measured


def _stress(longest_s: float) -> ChildProgram:
    """The machine's load, until it ends."""
    return ChildProgram([shutil.which(STRESS) or STRESS, "--quiet", "--cpu", "0", "--vm", "1", "--vm-bytes", "128M",
                         "--sock", "1", "--timeout", f"{longest_s:.0f}"], longest_end_s=10.0)


def serve(duration_s: float, work: pathlib.Path) -> dict[str, Any]:
    """haptic_server's report of its times, and the observations of its two clients."""
    file = work / "server.json"
    with ChildProgram([own_program("haptic_server"), "--listen", "127.0.0.1:0", "--milling-rate-hz", "1000",
                       "--duration-s", f"{duration_s:g}", "--record", work / "session.pcap", "--json", file]) as server:
        server.wait(ROOM_S, lambda: port_said_in(server.output()) is not None)
        port = port_said_in(server.output())
        if port is None:
            server.require_success()
            raise RuntimeError("haptic_server: does not say where it listens")
        clients = [_studies.Client("127.0.0.1", port) for _ in range(2)]
        frames = [0, 0]

        def follow() -> bool:
            frames[:] = [client.frames() for client in clients]
            return False

        server.wait(ROOM_S + duration_s, follow)
        del clients
        server.require_success()
    if not sum(frames):
        raise RuntimeError("haptic_server: no client has seen the session")
    told, histograms = foreign_json(file), foreign_json(work / "server.histograms.json")
    try:
        return {**{loop: latencies.of_server(histograms[loop]).counts() for loop in LOOPS},
                **{count: told[count] for count in COUNTS},
                "page_faults": told["page_faults"]["haptic"] + told["page_faults"]["milling"],
                "overrun_faults": told["faults"]["overrun"], "client_frames": sum(frames),
                "removed_mm3": told["removed_mm3"]["total"], "real_time_priority": told["real_time_priority"],
                "memory_locked": told["memory_locked"], "cyclictest": []}
    except (KeyError, TypeError) as error:
        raise RuntimeError(f"{file}: is not what haptic_server writes: {error}") from None


def port_said_in(output: str) -> int | None:
    """Port in "listening on 127.0.0.1:PORT", once the whole line is there."""
    said = re.search(r"listening on \S*:([0-9]+)\n", output)
    return int(said[1]) if said else None


def cycle(cyclictest: str, duration_s: float, has_priority: bool, work: pathlib.Path) -> latencies.Counts:
    """Runs cyclictest, which waits as haptic_server's loop would: at its priority, or an ordinary one if it has none."""
    file = work / "cyclictest.json"
    policy = ["--policy=fifo", f"--priority={_studies.HAPTIC_PRIORITY}"] if has_priority else ["--policy=other"]
    with ChildProgram([cyclictest, "--quiet", "--mlockall", "--default-system", "--threads=1", "--interval=1000",
                       f"--histogram={LONGEST_US}", "--histfile=/dev/null", f"--duration={math.ceil(duration_s)}",
                       f"--json={file}", *policy]) as child:
        child.wait(ROOM_S + duration_s)
        child.require_success()
    try:
        return latencies.of_cyclictest(foreign_json(file)).counts()
    except (KeyError, TypeError) as error:
        raise RuntimeError(f"{file}: is not what cyclictest writes: {error}") from None


def gather(load: str, slices: list[dict[str, Any]]) -> dict[str, Any]:
    """Measurements without load, or under it."""
    gathered: dict[str, Any] = {"load": load}
    for name in (*LOOPS, "cyclictest"):
        gathered[name] = Latencies()
        for one in slices:
            gathered[name].add(one[name])
    for name in (*COUNTS, "page_faults", "overrun_faults", "client_frames", "removed_mm3"):
        gathered[name] = sum(one[name] for one in slices)
    for name in ("real_time_priority", "memory_locked"):
        gathered[name] = all(one[name] for one in slices)
    return gathered


def allowed_late_ticks(gathered: dict[str, Any]) -> float:
    """Wakes of cyclictest over a millisecond, of as many as there were ticks, and one tick in a hundred thousand."""
    late_share = gathered["cyclictest"].over(PERIOD_US) / gathered["cyclictest"].count()
    return float((late_share + MORE_LATE_TICKS_SHARE) * gathered["ticks"])


def times_cyclictest(gathered: dict[str, Any]) -> float:
    return float(gathered["wakeup_latency"].quantile_us(BAR_QUANTILE) / gathered["cyclictest"].quantile_us(BAR_QUANTILE))


def summary_of(gathered: dict[str, Any]) -> dict[str, Any]:
    has_cyclictest = gathered["cyclictest"].count() > 0
    summary = {"load": gathered["load"], **{f"{loop}_us": gathered[loop].summary() for loop in LOOPS},
               **{key: value for key, value in gathered.items() if not isinstance(value, (str, Latencies))},
               "cyclictest_us": gathered["cyclictest"].summary() if has_cyclictest else None}
    if has_cyclictest:
        summary |= {"p999_times_cyclictest": times_cyclictest(gathered), "allowed_late_ticks": allowed_late_ticks(gathered)}
    return summary


def lines_of(gathered: dict[str, Any]) -> list[str]:
    load, wakeup, cyclictest = gathered["load"], gathered["wakeup_latency"], gathered["cyclictest"]
    lines = []
    if not gathered["real_time_priority"]:
        lines.append(f"{load}: without real-time priority, so cyclictest as well; see README on how to grant it")
    lines.append(f"{load}: {gathered['ticks']} ticks, wake-up p99.9 {wakeup.quantile_us(BAR_QUANTILE):.1f} us, tick p99.9 "
                 f"{gathered['haptic_tick'].quantile_us(BAR_QUANTILE):.1f} us; {gathered['late_ticks']} late by 1 ms, "
                 f"{gathered['missed_deadlines']} deadlines missed, {gathered['page_faults']} page faults")
    if cyclictest.count():
        lines.append(f"{load}: cyclictest {cyclictest.count()} wake-ups, p99.9 {cyclictest.quantile_us(BAR_QUANTILE):.1f} us, "
                     f"{cyclictest.over(PERIOD_US)} over 1 ms; wake-up p99.9 is {times_cyclictest(gathered):.2f} times that "
                     f"(bar: {MOST_TIMES_CYCLICTEST}), late ticks {gathered['late_ticks']} (bar: {allowed_late_ticks(gathered):.1f})")
    return lines
