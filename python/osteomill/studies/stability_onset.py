"""The onset: how much of the peak of the force a hand feels that enters bone, and how much later.

A burr of 1.5, 3 or 5 mm plunges along its spindle into bone, along the lattice and aslant, or one of 3 mm enters the side of a
block; on rails (prescribed), or in a firm hand whose arm is guided along the line. The yardstick is the exact answer: the same hand whose
burr is rigidly its own, on the bone's impulse by depth, integrated implicitly (studies/stability/onset). Beside it stands an
ideal spring: the coupling's own, in balance with that bone, which is the best that a coupling with such a spring can do; its
burr stays on the line, so that at an entry, where edges push a burr aside, a soft spring cannot do as well. A peak is the largest
mean over 5 ms.
"""

import argparse
from typing import Any

import pandas as pd

from osteomill import Burr, _studies
from osteomill.studies.study_run import StudyRun

Case = dict[str, Any]

BURRS_MM = (3.0, 1.5, 5.0)
SPEEDS_RPM = (10e3, 40e3)
HANDS_MM_PER_S = (5.0, 20.0, 60.0)
# N/mm and N s/mm: a soft arm's, the simulated arm's, the one that a measurement gives it, and three that no arm here renders.
SPRINGS = ((1.5, 0.004), (1.7, 0.005), (1.99, 0.0065), (3.0, 0.008), (15.0, 0.04), (30.0, 0.08))
PLUNGES = {"plunge": (0.0, 0.0, 1.0), "plunge aslant": (0.36, 0.48, 0.8)}
ENTRY = "entry"
POINTS_BAR = 3.0


def cases_of(options: argparse.Namespace) -> list[Case]:
    speeds_rpm, hands = (SPEEDS_RPM[:1], HANDS_MM_PER_S[1:2]) if options.quick else (SPEEDS_RPM, HANDS_MM_PER_S)
    burrs_mm = BURRS_MM[:1] if options.quick else BURRS_MM
    return [{"method": method, "kind": kind, "burr_mm": burr_mm, "is_guided": is_guided, "stiffness_n_per_mm": stiffness, "damping_n_s_per_mm": damping,
             "rpm": rpm, "speed_mm_per_s": speed, "feed_forward": feed_forward}
            for method in options.methods or ["implicit"] for feed_forward in (False, True)[:1 + options.feed_forward] for burr_mm in burrs_mm
            for kind in (*PLUNGES, ENTRY)[:None if burr_mm == BURRS_MM[0] else -1] for is_guided in (False, True) for stiffness, damping in SPRINGS for rpm in speeds_rpm for speed in hands]


def name_of(case: Case) -> str:
    return (f"{case['kind']} of {case['burr_mm']:g} mm at {case['speed_mm_per_s']:g} mm/s and {case['rpm']:g} rpm, {hand_of(case)}, "
            f"{case['stiffness_n_per_mm']:g} N/mm, {method_of(case)}")


def method_of(case: Case) -> str:
    return str(case["method"]) + (" with feed-forward" if case["feed_forward"] else "")


def hand_of(case: Case) -> str:
    return "guided" if case["is_guided"] else "prescribed"


def measure(case: Case) -> dict[str, float]:
    is_entry = case["kind"] == ENTRY
    return _studies.run_onset(
        Burr(diameter_mm=case["burr_mm"], rpm=case["rpm"]), is_entry=is_entry, up=(0.0, 0.0, 1.0) if is_entry else PLUNGES[case["kind"]],
        way_mm=1.5 if is_entry else 0.5, speed_mm_per_s=case["speed_mm_per_s"], method=case["method"],
        stiffness_n_per_mm=case["stiffness_n_per_mm"], damping_n_s_per_mm=case["damping_n_s_per_mm"], is_guided=case["is_guided"],
        feed_forward=case["feed_forward"])[0]


def share_of_peak(stiffness_n_per_mm: float) -> float:
    """The share of the exact peak that a firm hand feels with that spring and 4 N s/m, in a plunge at 20 mm/s and 40 000 rpm."""
    peaks = measure({"method": "implicit", "kind": "plunge aslant", "burr_mm": BURRS_MM[0], "is_guided": True, "stiffness_n_per_mm": stiffness_n_per_mm,
                     "damping_n_s_per_mm": 0.004, "rpm": 40e3, "speed_mm_per_s": 20.0, "feed_forward": False})
    return peaks["felt_peak_n"] / peaks["exact_peak_n"]


def table_of(cases: list[Case], outcomes: list[dict[str, float]]) -> pd.DataFrame:
    """A line for each case: peaks, shares of the exact one, and by how many points the felt one misses the ideal."""
    table = pd.DataFrame([case | {"hand": hand_of(case), "method": method_of(case)} | outcome for case, outcome in zip(cases, outcomes)])
    table["ideal_share"] = table["ideal_peak_n"] / table["exact_peak_n"]
    table["felt_share"] = table["felt_peak_n"] / table["exact_peak_n"]
    table["points"] = 100.0 * (table["felt_share"] - table["ideal_share"])
    table["ideal_late_ms"] = table["ideal_half_ms"] - table["exact_half_ms"]
    table["felt_late_ms"] = table["felt_half_ms"] - table["exact_half_ms"]
    return table.drop(columns=["is_guided", "feed_forward", "exact_half_ms", "ideal_half_ms", "felt_half_ms"])


def lines_of(table: pd.DataFrame) -> list[str]:
    """A line for each way in, hand and spring: felt and ideal share by the hand's speed, means over spindles and lattices; and
    over all of them by how many points the felt one misses the ideal, and how much later half of the peak is there."""
    speeds = list(dict.fromkeys(table["speed_mm_per_s"]))
    of_speeds = "".join(f"{f'{speed:g} mm/s':>14}" for speed in speeds)
    lines = [f"{'share of the exact peak: felt (ideal)':<47}{of_speeds}{'points':>14}{'ms later':>13}"]
    by = ["method", table["kind"].str.split().str[0], "burr_mm", "hand", "stiffness_n_per_mm"]
    for (method, way, burr_mm, hand, stiffness), rows in table.groupby(by, sort=False):
        means = rows.groupby("speed_mm_per_s")[["felt_share", "ideal_share"]].mean()
        shares = "".join(f"{f'{means.felt_share[speed]:.2f} ({means.ideal_share[speed]:.2f})':>14}" for speed in speeds)
        off = f"{rows['points'].min():+.1f} to {rows['points'].max():+.1f}"
        late = rows["felt_late_ms"] - rows["ideal_late_ms"]
        lines.append(f"{f'{way}, {burr_mm:g} mm, {hand}, {stiffness:g} N/mm, {method}':<47}{shares}{off:>14}{f'{late.min():+g} to {late.max():+g}':>13}")
    return lines


def bar_line_of(table: pd.DataFrame) -> str:
    """Whether every plunge on `implicit` is within its points of the ideal spring's."""
    plunges = table[(table["kind"] != ENTRY) & (table["method"] == "implicit")]
    within = int((plunges["points"].abs() <= POINTS_BAR).sum())
    verdict = "met   " if within == len(plunges) else "MISSED"
    return f"{verdict} {within} of {len(plunges)} plunges within {POINTS_BAR:g} points of the ideal spring's share"


def run(options: argparse.Namespace, study: StudyRun) -> None:
    cases = cases_of(options)
    table = table_of(cases, study.sweep(measure, cases, name_of))
    study.table("onset", table)
    for line in lines_of(table):
        study.say(line)
    if (table["method"] == "implicit").any():
        study.say(bar_line_of(table))
    if options.feed_forward:
        from osteomill.studies.stability_onset_chart import chart_of

        study.chart("onset", chart_of(table))
    study.say(f"onset.csv is in {study.out}")
