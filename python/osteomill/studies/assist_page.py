"""The page of the study `assist`: what the fixture changes, in the mean with its interval and for each trainee, and the charts."""

import pathlib
from typing import TYPE_CHECKING, Any

import jinja2
import pandas as pd
from markupsafe import Markup

from osteomill import _studies
from osteomill.studies import charts
from osteomill.studies.assist import OUTCOMES, RECORDED, WITHOUT

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NONE = "–"


def page(table: pd.DataFrame, effects: pd.DataFrame, drawn: dict[str, "Figure"], fixture: str, tools: str) -> str:
    """HTML that needs no other file. `fixture`: the text of its file; `tools`: burr and speed in place of the recorded ones, or nothing."""
    text = jinja2.Environment(
        loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True, trim_blocks=True,
        lstrip_blocks=True, undefined=jinja2.StrictUndefined,
    ).get_template("assist.html.jinja").render(
        style=Markup(_studies.PAGE_STYLE), fixture=fixture.strip(), tools=tools,
        recordings=table["recording"].nunique(), trainees=table["trainee"].nunique(),
        headings=[f"{what}, {unit}" if unit else what for _, what, unit in OUTCOMES],
        effects=[_effect_row(row) for _, row in effects.iterrows()], by_trainee=_trainee_rows(table),
        charts={name: Markup(charts.inline_svg(charts.svg_of(figure))) for name, figure in drawn.items()})
    return text + "\n"


def _effect_row(row: Any) -> dict[str, str]:
    heading, unit = next((what, unit) for key, what, unit in OUTCOMES if key == row["outcome"])
    interval = NONE if pd.isna(row["low"]) else f"{_number(row['low'])} to {_number(row['high'])}"
    return {"way": _way_text(row["grip"], "", row["stiffness_n_per_mm"]), "outcome": f"{heading}, {unit}" if unit else heading,
            "trainees": str(row["trainees"]), "without": _number(row["mean_without"]), "with": _number(row["mean_with"]),
            "difference": _number(row["difference"]), "interval": interval}


def _trainee_rows(table: pd.DataFrame) -> list[dict[str, Any]]:
    """The mean over a trainee's recordings, for each way in which these were played."""
    ways = ["trainee", "grip", "fixture", "stiffness_n_per_mm"]
    means = table.groupby(ways, sort=False, dropna=False)[[key for key, _, _ in OUTCOMES]].mean().reset_index()
    return [{"trainee": row["trainee"], "way": _way_text(row["grip"], row["fixture"], row["stiffness_n_per_mm"]),
             "is_plain": row["fixture"] in (RECORDED, WITHOUT), "values": [_number(row[key]) for key, _, _ in OUTCOMES]}
            for _, row in means.sort_values("trainee", kind="stable").iterrows()]


def _way_text(grip: Any, fixture: str, n_per_mm: Any) -> str:
    parts = ["" if pd.isna(grip) else f"{grip} grip", fixture, "" if pd.isna(n_per_mm) else f"{n_per_mm:g} N/mm"]
    return ", ".join(part for part in parts if part)


def _number(value: Any) -> str:
    return NONE if pd.isna(value) else f"{value:.3g}"
