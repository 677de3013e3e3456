"""A baseline of the study `states`: a random forest tells the state of a window from the force sensor alone, and warns before breakthrough.

Features: mean force, rms and band powers of a window and of those 0.5, 1, 2 and 4 s before it, and the largest of each so far, all
of the measured force. The bones are divided into five groups; each is judged by forests that were fitted to the others. The warning:
the first two windows in a row of which a second forest says that breakthrough is 1 s away or less; over 3 s early it is a false alarm.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from sklearn.ensemble import RandomForestClassifier
from sklearn.metrics import ConfusionMatrixDisplay, accuracy_score, confusion_matrix, recall_score
from sklearn.model_selection import GroupKFold, cross_val_predict

from osteomill.studies.states_truth import STATES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WARNS_S, FALSE_FROM_S, WINDOWS_BEFORE = 1.0, 3.0, (5, 10, 20, 40)


def fit(windows: pd.DataFrame, seed: int) -> dict[str, Any]:
    """Numbers of baseline.json: confusion, row: true, column: said; warned_s, of each motion with a breakthrough the seconds before it,
    nan without a warning. ValueError where there is but one bone."""
    if windows["bone"].nunique() < 2:
        raise ValueError("the baseline needs two bones or more: it is judged on bones that it was not fitted to")
    windows = windows.assign(left_s=windows["time_to_breakthrough_s"].astype(float))
    measured = windows.filter(regex="^force_")
    by_motion = measured.groupby(windows["motion"])
    features = np.hstack([measured, by_motion.cummax(), *(by_motion.shift(count).fillna(0.0) for count in WINDOWS_BEFORE)])
    forest = RandomForestClassifier(200, min_samples_leaf=3, class_weight="balanced", random_state=seed)
    folds = GroupKFold(min(5, windows["bone"].nunique()))
    said, windows["is_near"] = (cross_val_predict(forest, features, aim.to_numpy(), groups=windows["bone"], cv=folds)
                                for aim in (windows["state"], windows["left_s"] <= WARNS_S))
    both = windows["is_near"] & windows.groupby("motion")["is_near"].shift(fill_value=False)
    first_s = windows[both].drop_duplicates("motion").set_index("motion")["left_s"]
    in_time_s = first_s[first_s <= FALSE_FROM_S]
    return {"windows": len(windows), "accuracy": accuracy_score(windows["state"], said), "states": list(STATES),
            "confusion": confusion_matrix(windows["state"], said, labels=STATES),
            "warned_s": in_time_s.reindex(windows.dropna(subset="left_s")["motion"].unique()).tolist(),
            "false_alarms": len(first_s) - len(in_time_s), "recall": recall_score(windows["state"], said, labels=STATES, average=None, zero_division=0)}


def chart(found: dict[str, Any]) -> "Figure":
    from osteomill.studies import charts

    figure = charts.figure(10.0, 4.4)
    matrix, early = figure.subplots(1, 2)
    shares = found["confusion"] / np.maximum(1, np.sum(found["confusion"], axis=1, keepdims=True))
    ConfusionMatrixDisplay(shares, display_labels=STATES).plot(cmap="Blues", values_format=".0%", colorbar=False, ax=matrix)
    matrix.set(xlabel="said", ylabel="true", title=f"State of {found['windows']} windows of unseen bones: {found['accuracy']:.1%} right")
    matrix.grid(False)
    warned_s = pd.Series(found["warned_s"]).dropna().sort_values(ascending=False)
    early.step([*warned_s, 0.0], [*range(1, len(warned_s) + 1), len(warned_s)], where="post", marker="o", color=charts.BLUE)
    early.axhline(len(found["warned_s"]), color=charts.GREY, linestyle="--")
    early.set(xlabel="time before breakthrough, s", ylabel="breakthroughs warned of by then", xlim=(FALSE_FROM_S, -0.1),
              title=f"First warning; dashed: all {len(found['warned_s'])}; {found['false_alarms']} false alarms")
    return figure
