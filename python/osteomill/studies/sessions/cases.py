"""The sessions of one case, in the order of their start, and the questions asked of them together."""

import dataclasses
from collections.abc import Iterable
from typing import Any

import pandas as pd

from osteomill import _studies
from osteomill.studies.sessions.records import SessionRecord
from osteomill.studies.sessions.statistics import Interval, Possible, middle_half
from osteomill.studies.sessions.words import ENGLISH, Words

EXPERTS = "expert"  # the group that others are shown against


@dataclasses.dataclass(frozen=True)
class Headline:
    """A metric by which people judge a session: its name, its form and its meaning."""

    key: str  # docs/metrics.md; of several structures the sum
    text: str
    unit: str  # as shown
    scale: float  # from the metric's own unit to the shown one
    better: str  # which is better, in words; empty: neither
    is_count: bool  # compared by ranks, not by means

    @property
    def possible(self) -> Possible:
        if self.key in ("stroke_smoothness_ldlj", "cutting_angle_mean_deg"):
            return Possible.ANY
        return Possible.SHARE if self.unit == "%" else Possible.NOT_NEGATIVE

    def number(self, value: float, tr: Words = ENGLISH) -> str:
        return tr.numbers(_studies.number_text(self.key, value))

    def heading(self, tr: Words) -> str:
        return f"{tr(self.text)} ({self.unit})" if self.unit else tr(self.text)


HEADLINES = [Headline(*row) for row in _studies.headlines()]


@dataclasses.dataclass(frozen=True)
class Attempt:
    session: SessionRecord
    number: int  # of the trainee's sessions of the case that began alike, from 1


@dataclasses.dataclass(frozen=True)
class Case:
    """Sessions of a case that began alike; `apart`: their difference from most sessions of the case, empty: none."""

    name: str
    attempts: list[Attempt]
    apart: str = ""

    def learners(self) -> "Case":
        """The case without the sessions of experts, whose level and trend differ; all sessions if all are of
        experts."""
        some = [one for one in self.attempts if one.session.group != EXPERTS]
        return dataclasses.replace(self, attempts=some or self.attempts)

    def values(self, what: Headline) -> pd.DataFrame:
        """A row for each session that has a value: trainee, group, attempt, value, in the metric's own unit."""
        rows = [
            (one.session.trainee, one.session.group, one.number, value)
            for one in self.attempts
            if (value := one.session.value(what.key)) is not None
        ]
        return pd.DataFrame(rows, columns=["trainee", "group", "attempt", "value"])

    def trainee_means(self, what: Headline, group: str = "") -> list[float]:
        """A value for each trainee: those of one trainee are not independent. `group`: only of its trainees."""
        values = self.values(what)
        if group:
            values = values[values["group"] == group]
        return [float(mean) for mean in values.groupby("trainee")["value"].mean()]

    def expert_band(self, what: Headline) -> Interval | None:
        """Band of the middle half of the experts' sessions."""
        values = self.values(what)
        return middle_half(values["value"][values["group"] == EXPERTS].tolist())

    def passes(self) -> dict[str, list[bool]]:
        """Whether each judged session passed, by trainee."""
        passes: dict[str, list[bool]] = {}
        for one in self.attempts:
            if (passed := one.session.value("passed")) is not None:
                passes.setdefault(one.session.trainee, []).append(passed != 0.0)
        return dict(sorted(passes.items()))


def cases_of(sessions: Iterable[SessionRecord], tr: Words = ENGLISH) -> list[Case]:
    """In the order in which the cases first occur; within a case, sessions that began as most did come first. Names are in words of `tr`."""
    cases: dict[str, dict[Any, list[SessionRecord]]] = {}
    for session in sessions:
        start = (session.bone_at_start, *sorted(session.settings.items()))
        cases.setdefault(session.case_name, {}).setdefault(start, []).append(session)
    found = []
    for name, starts in cases.items():
        by_number = sorted(starts.values(), key=len, reverse=True)
        usual = by_number[0][0]
        for alike in by_number:
            apart = _apart(alike[0], usual, tr)
            found.append(Case(f"{tr(name)} ({apart})" if apart else tr(name), _numbered(alike), apart))
    return found


def _numbered(sessions: list[SessionRecord]) -> list[Attempt]:
    count: dict[str, int] = {}
    attempts = []
    for session in sessions:
        count[session.trainee] = count.get(session.trainee, 0) + 1
        attempts.append(Attempt(session, count[session.trainee]))
    return attempts


def _apart(one: SessionRecord, usual: SessionRecord, tr: Words) -> str:
    ways = [tr("another bone at the start")] if one.bone_at_start != usual.bone_at_start else []
    for name in sorted({*one.settings, *usual.settings}):
        if (value := one.settings.get(name)) != usual.settings.get(name):
            ways.append(f"{tr.name(name)} {tr.numbers(value or '') or tr('none')}")
    return ", ".join(ways)
