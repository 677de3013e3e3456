"""Learning curves of a case: each headline against the attempt, and passes as a cumulative sum."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from osteomill.studies import charts
from osteomill.studies.sessions.cases import HEADLINES, Case, Headline
from osteomill.studies.sessions.statistics import CusumDesign, Possible, PracticeTrend, practice_trend
from osteomill.studies.sessions.words import ENGLISH, Words

MOST_IN_LEGEND = 20
STEPS_PER_ATTEMPT = 8
MARKERS = "osD^vPX*<>h"


def learning_curves(case: Case, tr: Words = ENGLISH) -> dict[str, Figure]:
    """Curves by the metric's key, of headlines that some session has: a line for each trainee, the trend, the experts'
    band."""
    return {what.key: _curve_of(case, what, tr) for what in HEADLINES if not case.values(what).empty}


def pass_chart(case: Case, tr: Words = ENGLISH) -> Figure | None:
    """A line for each trainee, with the levels at which the test decides; None where no session was judged."""
    passes = case.passes()
    if not passes:
        return None
    design = CusumDesign()
    figure, axes = _empty(tr("Passes and failures, cumulative sum (lower is better)"), tr("failures beyond the rate"), tr)
    for trainee, has_passed in passes.items():
        axes.plot(design.sums(has_passed), **_look_of(case, trainee), label=_legend_text(trainee))
    for level, text in ((design.level(), tr("fails {:.0f} % or more", 100.0 * design.unacceptable_rate)),
                        (-design.level(), tr("fails {:.0f} % or less", 100.0 * design.acceptable_rate))):
        axes.axhline(level, color=charts.GREY, linestyle="--", linewidth=1.0)
        axes.annotate(text, (1.0, level), xycoords=("axes fraction", "data"), ha="right", va="bottom", color="#555555")
    _finish(axes, len(passes))
    return figure


def _curve_of(case: Case, what: Headline, tr: Words) -> Figure:
    values = case.values(what)
    title = f"{tr(what.text)} ({tr(what.better)})" if what.better else tr(what.text)
    figure, axes = _empty(title, what.unit, tr)
    attempts = int(values["attempt"].max())
    if band := case.expert_band(what):
        axes.fill_between([1, attempts], *(what.scale * end for end in band), color=charts.SKY, alpha=0.25,
                          linewidth=0, label=tr("middle half of experts"))
    for trainee, own in values.groupby("trainee"):
        axes.plot(own["attempt"], what.scale * own["value"], **_look_of(case, str(trainee)), label=_legend_text(str(trainee)))
    if trend := practice_trend(case.learners().values(what)):
        _add_trend(axes, trend, what, attempts, tr("trend"))
    if what.possible is not Possible.ANY:
        axes.set_ylim(0.0, 1.04 * axes.get_ylim()[1])  # the highest marker whole
    if what.possible is Possible.SHARE:
        axes.set_ylim(top=min(axes.get_ylim()[1], 1.05 * what.scale))
    axes.set_xlim(0.5, attempts + 0.5)
    _finish(axes, values["trainee"].nunique())
    return figure


def _look_of(case: Case, trainee: str) -> dict[str, Any]:
    """A trainee's style, the same in all charts of a case. The numbers of markers and colours have no common factor: 88
    trainees can be told apart."""
    place = sorted({one.session.trainee for one in case.attempts}).index(trainee)
    return {"color": f"C{place % 8}", "marker": MARKERS[place % len(MARKERS)]}


def _add_trend(axes: Any, trend: PracticeTrend, what: Headline, attempts: int, label: str) -> None:
    scale = what.scale
    at = np.linspace(1.0, attempts, STEPS_PER_ATTEMPT * (attempts - 1) + 1)
    low, high = zip(*(trend.interval_at(attempt, what.possible) for attempt in at))
    axes.fill_between(at, scale * np.array(low), scale * np.array(high), color=charts.GREY, alpha=0.25, linewidth=0)
    axes.plot(at, [scale * trend.at(attempt) for attempt in at], color=charts.BLACK, linewidth=2.5, label=label)


def _empty(title: str, y_text: str, tr: Words) -> tuple[Figure, Any]:
    figure = charts.figure(9.5, 3.6)
    axes = figure.subplots()
    axes.set(title=title, xlabel=tr("attempt"), ylabel=y_text)
    axes.yaxis.set_major_formatter(lambda value, _: tr.numbers(f"{value:g}"))
    axes.xaxis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1))
    return figure, axes


def _finish(axes: Any, trainees: int) -> None:
    """A legend that would be longer than the chart is left out."""
    if trainees <= MOST_IN_LEGEND:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize="small")


def _legend_text(name: str) -> str:
    """Matplotlib leaves out a label that begins with an underscore."""
    return f" {name}" if name.startswith("_") else name
