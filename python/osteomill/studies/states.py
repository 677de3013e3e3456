"""The states of milling, as data: what sensors at a burr see, beside what is true of the bone, for generated and recorded paths.

A file of HDF5 for each motion (states_samples.COLUMNS says of what), `windows.csv` with features of windows of 0.1 s, `motions.csv`
with the motions and their splits. With --baseline a classifier is fitted to the windows and drawn (states_baseline.py).
docs/states.md is the page.
"""

import argparse
import functools
import pathlib
from typing import Any

import numpy as np
import pandas as pd

from osteomill.studies.options import UsageError, existing_file, number_above_zero, whole_within
from osteomill.studies.states_motions import Motion, bone_name, motions_of, name_of, split_of
from osteomill.studies.states_samples import samples_of, windows_of, windows_table, write_hdf5
from osteomill.studies.study_run import StudyRun

WRITES = ("motion-*.h5", "windows.csv", "motions.csv", "*.svg", "baseline.json")


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--plates", type=whole_within(1, 10_000), metavar="N",
                        help="so many plates of cortical, cancellous and cortical bone, drawn at random (10)")
    parser.add_argument("--case", metavar="NAME|DIR", help="a case that is built in, or the folder of one, in the place of plates")
    parser.add_argument("--recording", type=existing_file, metavar="FILE", help="the path of a recording of --case, in the place of generated ones")
    parser.add_argument("--trajectory", type=existing_file, metavar="FILE.csv", help="a path over --case, as of haptic_server --trajectory, likewise")
    parser.add_argument("--burr", metavar="NAME", help="of the case's burrs, a ball (4 mm where there is one)")
    parser.add_argument("--rpm", type=number_above_zero, help="of the spindle (the burr's own)")
    parser.add_argument("--randoms", type=whole_within(0, 1000), metavar="N", help="random dives in each bone (2)")
    parser.add_argument("--every", type=whole_within(1, 1000), default=1, metavar="N", help="write one sample in N of 10 000 a second (%(default)s)")
    parser.add_argument("--no-samples", action="store_true", help="write no HDF5, windows alone")
    parser.add_argument("--seed", type=whole_within(0, 2**31 - 1), default=1, help="of plates, paths, noise and splits (%(default)s)")
    parser.add_argument("--baseline", action="store_true", help="fit and draw the baseline, too; needs python3-sklearn")
    parser.add_argument("--quick", action="store_true", help="five plates, no random dives: a minute")


def motions_asked(options: argparse.Namespace) -> list[Motion]:
    """UsageError for options that do not go together."""
    given = next((name for name in ("recording", "trajectory") if getattr(options, name)), None)
    if options.recording and options.trajectory:
        raise UsageError("--recording excludes --trajectory")
    if given and not options.case:
        raise UsageError(f"--{given} requires --case, the case that " + ("was recorded" if given == "recording" else "it is of"))
    for name in ("plates", "randoms", "quick"):
        if given and getattr(options, name) not in (None, False):
            raise UsageError(f"--{given} excludes --{name}")
    if options.case and options.plates:
        raise UsageError("--plates excludes --case")
    shared = {key: value for key in ("burr", "rpm") if (value := getattr(options, key)) is not None}
    if given:
        motions: list[Motion] = [shared | {"number": 0, "seed": options.seed, "case": options.case, "kind": given,
                                           given: str(getattr(options, given))}]
    else:
        bones = [{"case": options.case}] if options.case else [
            {"plate": number} for number in range(options.plates or (5 if options.quick else 10))]
        randoms = options.randoms if options.randoms is not None else 0 if options.quick else 2
        motions = motions_of([bone | shared for bone in bones], options.seed, randoms)
    split_of(motions, options.seed)
    return motions


def measure(motion: Motion, out: pathlib.Path | None, every: int) -> list[dict[str, Any]]:
    """Features of its windows; its file is written into the folder `out`."""
    samples = samples_of(motion)
    if out is not None:
        write_hdf5(out / f"motion-{motion['number']:04}.h5", samples, every)
    return windows_of(samples)


def run(options: argparse.Namespace, study: StudyRun) -> None:
    motions = motions_asked(options)
    if options.baseline:
        from osteomill.studies import states_baseline  # before anything is worked out for it
    if not options.no_samples:
        import h5py  # noqa: F401  likewise
    out = None if options.no_samples else study.file("motions.csv").parent
    outcomes = study.sweep(functools.partial(measure, out=out, every=options.every), motions, name_of)
    windows = windows_table(motions, outcomes)
    study.table("windows", windows)
    study.table("motions", pd.DataFrame([
        {"motion": motion["number"], "bone": bone_name(motion), "kind": motion["kind"], "depth_mm": motion.get("depth_mm"),
         "split_by_case": motion["split_by_case"], "split_by_motion": motion["split_by_motion"]} for motion in motions]))
    counts = ", ".join(f"{state} {count}" for state, count in windows["state"].value_counts().items())
    study.say(f"{len(motions)} motions, {len(windows)} windows of 0.1 s ({counts}) are in {study.out}")
    if options.baseline:
        found = states_baseline.fit(windows, options.seed)
        study.json("baseline", found)
        study.chart("baseline", states_baseline.chart(found))
        in_time_s = [time_s for time_s in found["warned_s"] if time_s > 0.0]
        median = f", {np.median(in_time_s):.2f} s before in the median" if in_time_s else ""
        study.say(f"baseline: {found['accuracy']:.1%} of {len(windows)} windows of bones that it has not seen; warns before "
                  f"{len(in_time_s)} of {len(found['warned_s'])} breakthroughs{median}; {found['false_alarms']} false alarms")
