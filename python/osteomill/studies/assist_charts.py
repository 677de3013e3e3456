"""Charts of the study `assist`."""

from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from osteomill.studies import charts
from osteomill.studies.assist import OUTCOMES, RECORDED, WITH, WITHOUT

LEAST_SHOWN = 0.01
COLOURS = (charts.BLUE, charts.RED, charts.GREEN, charts.PINK, charts.AMBER, charts.SKY)


def _labelled(text: str, unit: str) -> str:
    return f"{text}, {unit}" if unit else text


def _panels(height_in: float) -> tuple[Figure, Any]:
    figure = charts.figure(10.0, height_in)
    return figure, figure.subplots(2, 3).ravel()


def outcomes(table: pd.DataFrame) -> Figure:
    """Each trainee a line from without to with, each grip a colour; means are thick. Dashed: the mean as recorded."""
    figure, panels = _panels(7.0)
    figure.suptitle("The same hands without and with the fixture: a line a trainee, thick the mean, dashed as recorded")
    played = table[table["fixture"] != RECORDED]
    ways = [(WITHOUT, None)] + [(WITH, stiffness) for stiffness in played[played["fixture"] == WITH]["stiffness_n_per_mm"].unique()]
    names = [WITHOUT] + [WITH if pd.isna(stiffness) else f"{stiffness:g} N/mm" for _, stiffness in ways[1:]]
    for axes, (key, text, unit) in zip(panels, OUTCOMES):
        for colour, (grip, of_grip) in zip(COLOURS, played.groupby("grip", sort=False)):
            by_trainee = pd.DataFrame([_of_way(of_grip, way)[["trainee", key]].groupby("trainee")[key].mean() for way in ways])
            for trainee in by_trainee.columns:
                axes.plot(names, by_trainee[trainee].tolist(), color=colour, alpha=0.35, linewidth=0.8)
            axes.plot(names, by_trainee.mean(axis=1).tolist(), color=colour, marker="o", linewidth=2.2, label=f"{grip} grip")
        recorded = table[table["fixture"] == RECORDED]
        if key in recorded and recorded[key].notna().any():
            axes.axhline(float(recorded.groupby("trainee")[key].mean().mean()), color=charts.GREY, linestyle="--")
        # Rounding is no energy.
        axes.set(ylabel=_labelled(text, unit), ylim=(0.0, 1.05 * max(LEAST_SHOWN, axes.get_ylim()[1])))
    panels[0].legend()
    return figure


def _of_way(rows: pd.DataFrame, way: tuple[str, Any]) -> pd.DataFrame:
    fixture, stiffness = way
    rows = rows[rows["fixture"] == fixture]
    return rows if fixture == WITHOUT or pd.isna(stiffness) else rows[rows["stiffness_n_per_mm"] == stiffness]


def effects(table: pd.DataFrame) -> Figure:
    """The mean difference over trainees with its interval, a row a grip and stiffness."""
    figure, panels = _panels(6.0)
    figure.suptitle("With the fixture less without: mean over trainees and its 95 % interval")
    for axes, (key, text, unit) in zip(panels, OUTCOMES):
        rows = table[table["outcome"] == key]
        names = [row["grip"] + ("" if pd.isna(row["stiffness_n_per_mm"]) else f" {row['stiffness_n_per_mm']:g}") for _, row in rows.iterrows()]
        for place, (_, row) in enumerate(rows.iterrows()):
            if pd.notna(row["low"]):
                axes.plot([row["low"], row["high"]], [place, place], color=charts.BLUE, linewidth=2.0)
            axes.plot([row["difference"]], [place], marker="o", color=charts.BLUE)
        axes.axvline(0.0, color=charts.GREY, linewidth=1.0)
        axes.set_xlim(min(axes.get_xlim()[0], -LEAST_SHOWN), max(axes.get_xlim()[1], LEAST_SHOWN))
        axes.set_yticks(range(len(names)), names)
        axes.set(xlabel=_labelled(text, unit), ylim=(len(names) - 0.5, -0.5))
    return figure
