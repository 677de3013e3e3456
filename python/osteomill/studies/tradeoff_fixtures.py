"""Costs and gains of virtual fixtures: the time that each adds to a step of a session, against what it spares by the same hand.

The hand drills down a tooth with a 1 mm burr, half a millimetre from side to side, and slips once, 2.2 mm into the pulp and out
again. It is recorded without a fixture and played in closed loop (assisted_hand.py) with each, for three grips. Gains: how far
the burr was from the middle of its hole while it cut (rms), and the pulp that was milled. Beside them stands the time that the hand took.

Steps are timed in sessions that are led along that hand as on rails, block by block in turns, over bone and then over what is
milled. The fixtures are so weak there that the burr goes the same way with each: nothing but their computation differs. The
median of pairs, of blocks in which the fixture moves the burr at all, is the time that it adds: of the processor, so that other
work counts little.
"""

import functools
import itertools
import pathlib
import tempfile
import time
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from numpy.typing import NDArray

from osteomill import Case, Recording, Session
from osteomill.studies import charts
from osteomill.studies.assisted_hand import GRIPS, RecordedHand, inline_tables, play

Array = NDArray[np.float64]

SCENE, BURR, STRUCTURE = "tooth", "1 mm", "pulp"
HOLE_MM = np.array([0.5, 0.2])  # its middle, x and y
WITHOUT = "none"
FIXTURES: dict[str, list[dict[str, Any]]] = {
    WITHOUT: [],
    "guide": [{"name": "Hole", "kind": "guide", "line": {"from_mm": [*HOLE_MM.tolist(), 8.0], "to_mm": [*HOLE_MM.tolist(), -4.0]}}],
    "forbidden region": [{"name": "Off the pulp", "kind": "forbidden", "tissue": STRUCTURE}],
    "slow zone": [{"name": "Slow at the pulp", "kind": "slow", "tissue": STRUCTURE, "spindle_share": 0.5}],
}
QUICK_GRIPS = ("firm",)
WEAK = {"guide": {"stiffness_n_per_mm": 0.01, "damping_n_s_per_m": 0.1}, "forbidden": {"stiffness_n_per_mm": 0.01, "damping_n_s_per_m": 0.1},
        "slow": {"damping_n_s_per_m": 0.5, "spindle_share": 1.0}}
SWAY_MM, SWAY_HZ = 0.5, 1.0
HEIGHTS_MM = ((0.0, 6.5), (0.3, 5.0), (2.5, 1.6), (2.6, -0.6), (2.9, 1.6), (3.6, 6.5))  # s, mm; the slip begins at 2.5 s
BLOCK, PASSES = 25, 3  # ticks that are timed at once; the first pass mills, the others find nothing left


def cases(quick: bool) -> list[dict[str, Any]]:
    return [{"part": "fixture", "scene": SCENE, "grip": grip} for grip in (QUICK_GRIPS if quick else GRIPS)]


@functools.cache
def plain_case() -> Case:
    return Case(SCENE, burr=BURR)


@functools.cache
def case_with(fixture: str, weak: bool = False) -> Case:
    case = plain_case()
    tables = [one | WEAK[one["kind"]] if weak else one for one in FIXTURES[fixture]]
    return case.with_(set=["fixture=" + inline_tables(tables)]) if tables else case


def hand() -> tuple[Array, NDArray[np.bool_]]:
    """Where it is each millisecond, mm, and its pedal."""
    seconds, heights_mm = zip(*HEIGHTS_MM)
    time_s = 0.001 * np.arange(round(1000 * seconds[-1]))
    sway_mm = SWAY_MM * np.sin(2.0 * np.pi * SWAY_HZ * time_s) * (time_s < seconds[2])
    places_mm = [HOLE_MM[0] + sway_mm, np.full_like(time_s, HOLE_MM[1]), np.interp(time_s, seconds, heights_mm)]
    return np.stack(places_mm, axis=1), (time_s > 0.1) & (time_s < seconds[4])


def measure(case: dict[str, Any]) -> dict[str, Any]:
    times_us = step_times_us()
    with tempfile.TemporaryDirectory(prefix="osteomill-fixtures-") as folder:
        file = pathlib.Path(folder, "hand.pcap")
        hands_mm, pedals = hand()
        with Session(case_with(WITHOUT), start_mm=hands_mm[0], record=file) as session:
            session.rollout(hands_mm, pedals=pedals)
        recorded = RecordedHand.of(Recording(file))
        return {"fixtures": {fixture: times_us[fixture] | played(recorded, fixture, case["grip"], file) for fixture in FIXTURES}}


def played(recorded: RecordedHand, fixture: str, grip: str, file: pathlib.Path) -> dict[str, Any]:
    """By the hand in closed loop; `file` is written over."""
    with Session(case_with(fixture), start_mm=recorded.hand_mm[0], record=file) as session:
        felt = play(session, recorded, GRIPS[grip])
    recording = Recording(file)
    return {"from_middle_mm": from_middle_mm(recording.ticks), "structure_mm3": recording.metrics()["structure_dose_mm3_of"][STRUCTURE],
            "time_s": felt.time_s, "peak_force_n": felt.peak_force_n}


def from_middle_mm(ticks: dict[str, NDArray[Any]]) -> float:
    """Rms of the burr's way from the middle of the hole, while its spindle turned and before the slip's height."""
    burr_mm = ticks["burr_mm"]
    is_drilling = ticks["spindle_on"].astype(bool) & (burr_mm[:, 2] < HEIGHTS_MM[1][1]) & (burr_mm[:, 2] > HEIGHTS_MM[2][1])
    return float(np.sqrt(((burr_mm[is_drilling, :2] - HOLE_MM) ** 2).sum(axis=1).mean()))


def step_times_us() -> dict[str, dict[str, float]]:
    """By fixture: the median step while milling, and what it adds to a step, with half the width of that median's interval of 95 %
    (1.57 quartile distances over the root of the count: McGill et al., The American Statistician 32:12, 1978)."""
    hands_mm, pedals = hand()
    blocks = [slice(first, first + BLOCK) for first in range(0, len(hands_mm), BLOCK)]
    sessions = {fixture: Session(case_with(fixture, weak=True), start_mm=hands_mm[0]) for fixture in FIXTURES}
    spent_us = {fixture: np.zeros((PASSES, len(blocks))) for fixture in FIXTURES}
    burr_mm = {fixture: np.zeros((PASSES, *hands_mm.shape)) for fixture in FIXTURES}
    for number, (place, block) in itertools.product(range(PASSES), enumerate(blocks)):
        for fixture in np.roll(list(FIXTURES), place):  # who is first finds the caches cold
            begin_s = time.thread_time()
            burr_mm[fixture][number, block] = sessions[fixture].rollout(hands_mm[block], pedals=pedals[block])["burr_mm"]
            spent_us[fixture][number, place] = 1e6 * (time.thread_time() - begin_s) / BLOCK
    found = {}
    for fixture in FIXTURES:
        moved = (burr_mm[fixture] != burr_mm[WITHOUT]).reshape(PASSES, len(blocks), -1).any(axis=2)
        acts = moved if fixture != WITHOUT else np.ones_like(moved)
        low_us, added_us, high_us = np.percentile((spent_us[fixture] - spent_us[WITHOUT])[acts], (25, 50, 75))
        found[fixture] = {"step_us": float(np.median(spent_us[fixture][0])), "added_us": float(added_us),
                          "added_within_us": float(1.57 * (high_us - low_us) / np.sqrt(acts.sum()))}
    return found


def table_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    """A line for each fixture and grip."""
    return pd.DataFrame([{"grip": case["grip"], "fixture": fixture} | found
                         for case, outcome in zip(choices, outcomes) for fixture, found in outcome["fixtures"].items()])


def chart_of(table: pd.DataFrame) -> Figure:
    figure = charts.figure(10.0, 4.8)
    without_us = float(table[table["fixture"] == WITHOUT]["step_us"].median())
    figure.suptitle(f"Virtual fixtures on the same hand; a step without takes {without_us:.0f} us")
    from_middle, structure = figure.subplots(1, 2)
    colours = dict(zip(FIXTURES, (charts.BLACK, charts.BLUE, charts.RED, charts.AMBER)))
    marks = dict(zip(GRIPS, ("o", "s", "^")))
    for axes, column, label in ((from_middle, "from_middle_mm", "burr from the middle of its hole (rms), mm"),
                                (structure, "structure_mm3", f"milled of the {STRUCTURE}, mm³")):
        for _, row in table.iterrows():
            axes.errorbar([row["added_us"]], [row[column]], xerr=[row["added_within_us"]], color=colours[row["fixture"]],
                          marker=marks[row["grip"]], linestyle="none", alpha=0.8)
        axes.set(xlabel="time that it adds to a step, us", ylabel=label)
        axes.set_ylim(bottom=-0.02 * float(table[column].max()), top=1.15 * float(table[column].max()))
        axes.margins(x=0.15)
    from_middle.set_title("It sways by 0.5 mm", fontsize=10)
    structure.set_title("It slips by 2.2 mm", fontsize=10)
    for fixture, colour in colours.items():
        structure.plot([], [], color=colour, linewidth=5.0, label=fixture)
    for grip in table["grip"].unique():
        structure.plot([], [], color=charts.GREY, marker=marks[grip], linestyle="none", label=f"{grip} grip")
    structure.legend(fontsize=8)
    return figure
