"""Costs of the picture's cues, and the gain by smooth silhouettes.

A cue is on by default if it takes less than a tenth of a frame. Frames with it and without are drawn in turns in one run, so
that the machine's other work affects both alike; its cost is the median of such pairs. Silhouettes, smoothed and not, are held
against a picture of 4 x 4 rays a pixel, on the pixels at which depth jumps by a millimetre.
"""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes

from osteomill.studies import charts
from osteomill.studies.tradeoff_picture import QUICK_SIZE_PX, SIZE_PX, trial_of

CUES = ("ambient occlusion", "thin bone", "smooth silhouettes", "wet bone", "grain", "sawn faces", "handpiece", "motion blur")
SCENES = ("tooth", "mastoid")
DEFAULT_BELOW_PERCENT = 10.0  # of a frame
WORTH_DB = 3.0  # of silhouettes
PAIRS, QUICK_PAIRS = 15, 3


def cases(quick: bool) -> list[dict[str, Any]]:
    return [{"part": "cue", "scene": scene, "view": view, "quick": quick} for scene in (SCENES[:1] if quick else SCENES)
            for view in (("overview",) if quick else ("overview", "close-up"))]


def measure(case: dict[str, Any]) -> dict[str, Any]:
    size_px = QUICK_SIZE_PX if case["quick"] else SIZE_PX
    trial = trial_of(case["scene"], case["view"], "gradient", size_px, True)
    cues = {cue: trial.cue(cue, pairs=QUICK_PAIRS if case["quick"] else PAIRS) for cue in CUES}
    return {"cues": cues, "silhouettes": trial.silhouettes(), "gl_renderer": trial.gl_renderer, "size_px": size_px}


def table_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    """A line for each cue in each view; PSNR if the cue is silhouettes."""
    rows = []
    for case, outcome in zip(choices, outcomes):
        for cue, cost in outcome["cues"].items():
            psnr = outcome["silhouettes"] if cue == "smooth silhouettes" else {"without_db": None, "with_db": None}
            rows.append({"scene": case["scene"], "view": case["view"], "cue": cue, "without_ms": cost["without_ms"],
                         "with_ms": cost["with_ms"], "cost_percent": 100.0 * cost["part_of_frame"],
                         "cpu_percent": 100.0 * cost["part_of_cpu"],
                         "changed_percent": 100.0 * cost["changed_pixels"], "silhouettes_without_db": psnr["without_db"],
                         "silhouettes_with_db": psnr["with_db"], "gl_renderer": outcome["gl_renderer"],
                         "width_px": outcome["size_px"][0], "height_px": outcome["size_px"][1]})
    return pd.DataFrame(rows)


def draw_cues(costs: Axes, silhouettes: Axes, table: pd.DataFrame) -> None:
    marks: dict[tuple[str, str], dict[str, Any]] = {
        (scene, view): {"color": colour, "marker": mark} for scene, colour in zip(SCENES, (charts.BLUE, charts.AMBER))
        for view, mark in (("overview", "o"), ("close-up", "X"))}
    for (scene, view), rows in table.groupby(["scene", "view"], sort=False):
        costs.plot(rows["cost_percent"], [CUES.index(cue) for cue in rows["cue"]], linestyle="none", label=f"{scene}, {view}",
                   **marks[scene, view])
    costs.axvline(DEFAULT_BELOW_PERCENT, color=charts.GREY, linestyle=":", label="on by default below")
    costs.set_yticks(range(len(CUES)), CUES)
    costs.set(xlabel="time of a frame that it adds, %", title="")
    costs.set_ylim(len(CUES) - 0.5, -0.5)
    costs.legend(fontsize=9)
    costs.set_title("Cues of the picture: with and without in turns", fontsize=10)
    smooth = table[table["cue"] == "smooth silhouettes"]
    for _, row in smooth.iterrows():
        silhouettes.plot([row["without_ms"], row["with_ms"]], [row["silhouettes_without_db"], row["silhouettes_with_db"]],
                         label=f"{row['scene']}, {row['view']}: a ray a pixel, and smoothed", **marks[row["scene"], row["view"]])
    silhouettes.set(xlabel="time of a frame (median), ms", ylabel="PSNR of silhouettes, dB")
    silhouettes.margins(x=0.15, y=0.3)
    silhouettes.legend(fontsize=9)
    silhouettes.set_title("Silhouettes against 4 x 4 rays a pixel", fontsize=10)
