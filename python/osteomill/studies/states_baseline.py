"""A baseline of the study `states`: a random forest tells the state of a window from the force sensor alone, and warns before breakthrough.

Features: mean force, rms and band powers of a window and of those 0.5, 1, 2 and 4 s before it, and the largest of each so far, all
of the measured force. The bones are divided into five groups; each is judged by forests that were fitted to the others. The warning: the first two windows in a row of
which a second forest says that breakthrough is 1 s away or less. Its time before breakthrough is the early-warning time; over 3 s
counts as false.
"""

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from sklearn.ensemble import RandomForestClassifier
from sklearn.metrics import accuracy_score, confusion_matrix
from sklearn.model_selection import GroupKFold, cross_val_predict

from osteomill.studies.states_truth import STATES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WARNS_S, FALSE_FROM_S, WINDOWS_BEFORE = 1.0, 3.0, (5, 10, 20, 40)


@dataclasses.dataclass(frozen=True)
class Baseline:
    confusion: np.ndarray[Any, Any]  # windows, row: true, column: said, both as STATES
    warned_s: list[float | None]  # of each motion with a breakthrough; None: no warning; below 0: too late
    numbers: dict[str, Any]
    words: str


def fit(windows: pd.DataFrame, seed: int) -> Baseline:
    """ValueError where there is but one bone."""
    measured = [name for name in windows.columns if name.startswith("force_")]
    by_motion = windows.groupby("motion")[measured]
    features = np.hstack([windows[measured], by_motion.cummax()] + [by_motion.shift(count).fillna(0.0) for count in WINDOWS_BEFORE])
    bones = windows["bone"]
    if bones.nunique() < 2:
        raise ValueError("the baseline needs two bones or more: it is judged on bones that it was not fitted to")
    folds = GroupKFold(min(5, bones.nunique()))
    forest = RandomForestClassifier(200, min_samples_leaf=3, class_weight="balanced", random_state=seed)
    said, is_near = (cross_val_predict(forest, features, aim.to_numpy(), groups=bones, cv=folds)
                     for aim in (windows["state"], windows["time_to_breakthrough_s"].astype(float) <= WARNS_S))
    confusion = confusion_matrix(windows["state"], said, labels=STATES)
    warned_s, false_alarms = _warnings(windows, is_near)
    right, given = accuracy_score(windows["state"], said), [time for time in warned_s if time is not None and time > 0.0]
    numbers = {"windows": len(windows), "accuracy": right, "states": list(STATES), "confusion": confusion, "warned_s": warned_s,
               "false_alarms": false_alarms, "recall": confusion.diagonal() / np.maximum(1, confusion.sum(axis=1))}
    median = f"{np.median(given):.2f} s before breakthrough in the median, " if given else ""
    return Baseline(confusion, warned_s, numbers, f"baseline: {100.0 * right:.1f} % of {len(windows)} windows of bones that it has not seen; "
                    f"warns before {len(given)} of {len(warned_s)} breakthroughs, {median}{false_alarms} false alarms")


def _warnings(windows: pd.DataFrame, is_near: Any) -> tuple[list[float | None], int]:
    warned_s: list[float | None] = []
    false_alarms = 0
    for _, motion in windows.assign(near=is_near).groupby("motion"):
        near = motion["near"].to_numpy()
        both = np.flatnonzero(near[1:] & near[:-1])
        left_s = motion["time_to_breakthrough_s"].astype(float).to_numpy()
        first_s = left_s[both[0] + 1] if len(both) else None
        is_false = first_s is not None and (np.isnan(first_s) or first_s > FALSE_FROM_S)
        false_alarms += is_false
        if not np.isnan(left_s).all():
            warned_s.append(None if first_s is None or is_false else float(first_s))
    return warned_s, false_alarms


def chart(found: Baseline) -> "Figure":
    from osteomill.studies import charts

    figure = charts.figure(10.0, 4.4)
    matrix, early = figure.subplots(1, 2)
    shares = found.confusion / np.maximum(1, found.confusion.sum(axis=1, keepdims=True))
    matrix.imshow(shares, cmap="Blues", vmin=0.0, vmax=1.0)
    for row, column in np.ndindex(shares.shape):
        matrix.text(column, row, f"{100.0 * shares[row, column]:.0f} %\n{found.confusion[row, column]}", ha="center", va="center",
                    fontsize=9, color="white" if shares[row, column] > 0.6 else "black")
    matrix.set_xticks(range(len(STATES)), STATES)
    matrix.set_yticks(range(len(STATES)), STATES)
    matrix.set(xlabel="said", ylabel="true", title=f"State of {found.confusion.sum()} windows of unseen bones: {100.0 * found.numbers['accuracy']:.1f} % right")
    matrix.grid(False)
    given = sorted((time for time in found.warned_s if time is not None), reverse=True)
    early.step([*given, 0.0], [*(1 + np.arange(len(given))), len(given)], where="post", color=charts.BLUE)
    early.plot(given, 1 + np.arange(len(given)), linestyle="none", marker="o", color=charts.BLUE)
    early.axhline(len(found.warned_s), color=charts.GREY, linestyle="--")
    early.set(xlabel="time before breakthrough, s", ylabel="breakthroughs warned of by then", xlim=(FALSE_FROM_S, -0.1),
              ylim=(0.0, len(found.warned_s) + 1.0), title=f"First warning; dashed: all {len(found.warned_s)}; {found.numbers['false_alarms']} false alarms")
    return figure
