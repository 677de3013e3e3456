"""The overview: for each case a line for each session, statistics of the sessions together, and the learning curves."""

import dataclasses
import math
import pathlib
from collections.abc import Sequence
from typing import Any

import jinja2
import pandas as pd
from markupsafe import Markup

from osteomill import _studies
from osteomill.studies import charts
from osteomill.studies.sessions.cases import HEADLINES, Attempt, Case, Headline, cases_of
from osteomill.studies.sessions.curves import learning_curves, pass_chart
from osteomill.studies.sessions.records import SessionRecord
from osteomill.studies.sessions.statistics import (
    FEWEST_COMPARED,
    Interval,
    compare_means,
    compare_ranks,
    mean_of,
    practice_trend,
)
from osteomill.studies.sessions.words import ENGLISH, Words

NONE = "–"


def sessions_table(sessions: list[SessionRecord]) -> pd.DataFrame:
    """A row a session and metric; `attempt` counts a trainee's sessions of a case, in the order of `sessions`."""
    place = {id(one.session): (case.name, one.number) for case in cases_of(sessions) for one in case.attempts}
    rows = [
        (session.file, session.trainee, *place[id(session)],
         int(session.began_unix_ns / 1_000_000_000), metric.key, metric.of, metric.value, metric.unit)
        for session in sessions
        for metric in session.metrics
    ]
    return pd.DataFrame(rows, columns=["session", "trainee", "case", "attempt", "began_unix_s", "metric", "of", "value", "unit"])


def compared_groups(sessions: list[SessionRecord], wanted: list[str]) -> list[str]:
    """Two groups to compare: the requested ones, or the existing ones if there are just two.

    RuntimeError for a group without a session.
    """
    groups = sorted({session.group for session in sessions if session.group})
    for group in wanted:
        if group not in groups:
            there = "take one of " + ", ".join(f'"{one}"' for one in groups) if groups else (
                "there are no groups: write groups.csv, with lines TRAINEE,GROUP")
            raise RuntimeError(f'no session is of a trainee in group "{group}"; {there}')
    return wanted or (groups if len(groups) == 2 else [])


@dataclasses.dataclass(frozen=True)
class Overview:
    """Charts are SVG, by the name of their file; `html` holds them as well."""

    html: str
    charts: dict[str, str]


def overview(
    sessions: list[SessionRecord], compared: list[str], skipped: list[str], nobodies: Sequence[str] = (), tr: Words = ENGLISH
) -> Overview:
    """`sessions` in the order of their start; `skipped`: recordings left out and why; `nobodies`: lines of groups.csv; `tr`: its language."""
    files: dict[str, str] = {}
    shown = []
    for number, case in enumerate(cases_of(sessions, tr), 1):
        repeated = any(one.number > 1 for one in case.attempts)
        drawn = {key: charts.svg_of(figure) for key, figure in learning_curves(case, tr).items()} if repeated else {}
        files |= {key if number == 1 else f"{key}_{number}": svg for key, svg in drawn.items()}
        passes = pass_chart(case, tr)
        shown.append({
            "name": case.name,
            "apart": case.apart,
            "is_opened": any(one.session.opened() for one in case.attempts),
            "columns": [what.heading(tr) for what in _columns(case)],
            "is_judged": bool(case.passes()),
            "is_rated": any(one.session.rating_items() for one in case.attempts),
            "rating": _rating_rows(case, tr),
            "sessions": [_session_row(case, one, tr) for one in sorted(case.attempts, key=lambda one: one.session.trainee)],
            "statistics": [_statistics_row(case, what, compared, tr) for what in _columns(case)],
            "curves": [_inline(svg) for svg in drawn.values()],
            "passes": _inline(charts.svg_of(passes)) if passes else "",
        })
    page = jinja2.Environment(
        loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True, trim_blocks=True,
        lstrip_blocks=True, undefined=jinja2.StrictUndefined,
    ).get_template("page.html.jinja")
    html = page.render(tr=tr, style=Markup(_studies.PAGE_STYLE), count=len(sessions), skipped=skipped, nobodies=nobodies, cases=shown,
                       compared=compared)
    return Overview(html + "\n", files)


def _columns(case: Case) -> list[Headline]:
    return [what for what in HEADLINES if not case.values(what).empty]


def _session_row(case: Case, attempt: Attempt, tr: Words) -> dict[str, Any]:
    session = attempt.session
    values = [(what, session.value(what.key)) for what in _columns(case)]
    return {
        "file": session.file,
        "trainee": f"{session.trainee} ({session.group})" if session.group else session.trainee,
        "attempt": attempt.number,
        "began": tr.time(session.began_unix_ns),
        "report": session.report,
        "passed": session.value("passed"),
        "points": _points(session, tr),
        "undone": _undone(session, tr),
        "opened": ", ".join(f"{tr.name(one.of)} {tr.numbers(_studies.number_text(one.key, one.value or 0.0))} mm³" for one in session.opened()),
        "values": [NONE if value is None else what.number(value, tr) for what, value in values],
    }


def _points(session: SessionRecord, tr: Words) -> str:
    points, most = session.value("rating_points"), session.value("rating_most_points")
    return "" if points is None or most is None else tr("{} of {}", tr.numbers(f"{points:g}"), tr.numbers(f"{most:g}"))


def _undone(session: SessionRecord, tr: Words) -> str:
    """Beside the points: full marks by undoing are none."""
    if not (undos := session.value("undos")):
        return ""
    volume_mm3 = tr.numbers(_studies.number_text("undone_mm3", session.value("undone_mm3") or 0.0))
    return tr("{} undo, {} mm³", 1, volume_mm3) if undos == 1 else tr("{} undos, {} mm³", f"{undos:g}", volume_mm3)


def _rating_rows(case: Case, tr: Words) -> list[tuple[str, str]]:
    """For each item, the number of rated sessions in which it is reached."""
    reached: dict[str, list[bool]] = {}
    for one in case.attempts:
        for name, points in one.session.rating_items().items():
            reached.setdefault(name, []).append(points > 0.0)
    return [(tr(name), tr("{} of {}", sum(found), len(found))) for name, found in reached.items()]


def _statistics_row(case: Case, what: Headline, compared: list[str], tr: Words) -> dict[str, Any]:
    band = case.expert_band(what)
    return {
        "heading": what.heading(tr),
        "better": tr(what.better),
        "numbers": [*_mean_cells(case, what, tr), _interval_text(what, band, tr) if band else NONE, *_trend_cells(case, what, tr)],
        "comparison": _comparison_cells(case, what, compared, tr) if compared else [],
    }


def _mean_cells(case: Case, what: Headline, tr: Words) -> list[str]:
    mean = mean_of(case.learners().trainee_means(what), what.possible)
    if mean is None:
        return ["0", NONE]
    return [str(mean.n), _with_interval(what, mean.mean, mean.interval, tr) if mean.interval else what.number(mean.mean, tr)]


def _trend_cells(case: Case, what: Headline, tr: Words) -> list[str]:
    """Trend of a doubling of attempts."""
    trend = practice_trend(case.learners().values(what))
    if trend is None:
        return [NONE, NONE]
    low, high = trend.slope_interval()
    doubling = math.log(2.0)
    interval = what.possible.difference((doubling * low, doubling * high))
    return [_with_interval(what, doubling * trend.slope, interval, tr), _p_text(trend.p(), tr)]


def _comparison_cells(case: Case, what: Headline, compared: list[str], tr: Words) -> list[str]:
    """Both means, the difference, the effect size, p, and the name of the test."""
    first, second = (case.trainee_means(what, group) for group in compared)
    means = [f"{what.number(mean.mean, tr)} ({mean.n})" if (mean := mean_of(group)) else NONE for group in (first, second)]
    if min(len(first), len(second)) < FEWEST_COMPARED:
        return [*means, NONE, NONE, NONE, ""]
    if what.is_count:
        ranks = compare_ranks(first, second)
        if ranks is None:
            return [*means, NONE, NONE, NONE, ""]
        return [*means, NONE, tr.numbers(f"δ {ranks.cliffs_delta:.2f}"), _p_text(ranks.p, tr), "Mann-Whitney"]
    welch = compare_means(first, second)
    if welch is None:
        return [*means, NONE, NONE, NONE, ""]
    return [*means, _with_interval(what, welch.difference, what.possible.difference(welch.interval), tr), tr.numbers(f"g {welch.hedges_g:.2f}"), _p_text(welch.p, tr), "Welch"]


def _interval_text(what: Headline, interval: Interval, tr: Words) -> str:
    return tr("{} to {}", *(what.number(end, tr) for end in interval))


def _with_interval(what: Headline, value: float, interval: Interval, tr: Words) -> str:
    if abs(value) < 1e-9 * (interval[1] - interval[0]):
        value = 0.0  # but for rounding
    return f"{what.number(value, tr)} [{_interval_text(what, interval, tr)}]"


def _p_text(p: float, tr: Words) -> str:
    return tr.numbers("< 0.001" if p < 0.001 else f"{p:.3f}")


def _inline(svg: str) -> Markup:
    return Markup(charts.inline_svg(svg))
