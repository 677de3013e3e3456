"""Costs and gains of the states of milling as data (states.py): seconds of a core for one second of a path, without and with the force
within the tooth period at 10 kHz.

    labels   the path is milled, a step a millisecond: mean force, engagement, sound, and beside them wall, state, time to breakthrough
    force    the force within the tooth period, a sensor's reading of it, and all columns at 10 kHz

Gain: the swing of that force about its mean over a tooth period, which labels and means alone do not show (rms, of the mean). The paths
are those over one plate of the study. Times are the processor's.
"""

import time
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from numpy.typing import NDArray

from osteomill.studies import charts, states_samples
from osteomill.studies.states_motions import Motion, case_of_motion, motions_of, path_of, split_of
from osteomill.studies.states_sensor import RATE_HZ, ForceSensor

SEED = 1
QUICK_KINDS = ("drill",)
STAGES = {"labels": "labels and mean force, 1 kHz", "force": "the force within the tooth period, 10 kHz"}


def cases(quick: bool) -> list[dict[str, Any]]:
    """A motion each."""
    motions = motions_of([{"plate": 0}], SEED, 2)
    split_of(motions, SEED)
    return [{"part": "states", "motion": motion} for motion in motions if not quick or motion["kind"] in QUICK_KINDS]


def measure(case: dict[str, Any]) -> dict[str, Any]:
    from scipy import ndimage, signal  # noqa: F401  to load them takes no part in the times

    motion: Motion = case["motion"]
    asked = case_of_motion(motion)
    path = path_of(motion, asked)
    burr, rng = asked.burrs[path.burr], np.random.default_rng(SEED)
    begin_s = time.thread_time()
    found = states_samples.labelled(asked, path, False)
    labelled_s = time.thread_time()
    columns = states_samples.columns_of(found, path, burr, ForceSensor.drawn(rng), rng)
    sampled_s = time.thread_time()
    return {"path_s": 0.001 * (len(path.positions_mm) - 1), "labels_s": labelled_s - begin_s, "force_s": sampled_s - labelled_s,
            "swing_percent": swing_percent(columns["force_n"], burr.edges * burr.rpm / 60.0)}


def swing_percent(force_n: NDArray[np.float64], teeth_hz: float) -> float:
    """Rms of the force about its mean over each tooth period, in percent of the rms of these means. Rows at RATE_HZ, (n, 3)."""
    rows = round(RATE_HZ / teeth_hz)
    periods_n = force_n[: len(force_n) // rows * rows].reshape(-1, rows, 3)
    means_n = periods_n.mean(axis=1)
    swing_n = np.sqrt(((periods_n - means_n[:, None]) ** 2).sum(axis=2).mean())
    return 100.0 * float(swing_n / np.sqrt((means_n**2).sum(axis=1).mean()))


def table_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    """A line a motion: seconds of a core for one second of its path, by stage."""
    return pd.DataFrame([{"motion": case["motion"]["number"], "kind": case["motion"]["kind"], "depth_mm": case["motion"].get("depth_mm"),
                          "path_s": found["path_s"], **{f"{stage}_s_per_s": found[f"{stage}_s"] / found["path_s"] for stage in STAGES},
                          "swing_percent": found["swing_percent"]} for case, found in zip(choices, outcomes)])


def chart_of(table: pd.DataFrame) -> Figure:
    figure = charts.figure(10.0, 4.4)
    axes = figure.subplots()
    names = [f"{row['kind']}" + (f" {row['depth_mm']:g} mm" if pd.notna(row["depth_mm"]) else "") for _, row in table.iterrows()]
    places, before = np.arange(len(table)), np.zeros(len(table))
    for colour, (stage, text) in zip((charts.BLUE, charts.AMBER), STAGES.items()):
        took = table[f"{stage}_s_per_s"].to_numpy()
        axes.barh(places, took, left=before, color=colour, label=text)
        before = before + took
    for place, end, percent in zip(places, before, table["swing_percent"]):
        axes.annotate(f"swing {percent:.0f} %", (float(end), float(place)), xytext=(4, -3), textcoords="offset points", fontsize=9)
    axes.set_yticks(places, names)
    axes.set_xlim(right=1.3 * float(before.max()))
    axes.set_ylim(len(table) - 0.4, -1.6)
    axes.set(xlabel="seconds of a core for one second of a path")
    axes.legend(fontsize=8, loc="upper right")
    axes.set_title("States as data: what the force within the tooth period costs, and the swing that it shows", fontsize=10)
    return figure
