"""A teacher's groups.csv, held against the trainees who have sessions."""

import dataclasses
import difflib
import pathlib
import unicodedata
from collections import Counter

from osteomill import _studies
from osteomill.studies.sessions.records import SessionRecord
from osteomill.studies.sessions.words import ENGLISH, Words
from osteomill.studies.text import printable


@dataclasses.dataclass(frozen=True)
class Groups:
    """The group and the line that says so, by the trainee's name."""

    file: pathlib.Path | None
    of_trainee: dict[str, tuple[str, int]]

    @classmethod
    def of(cls, file: pathlib.Path | None) -> "Groups":
        return cls(file, _studies.trainee_groups(file) if file else {})

    def assign(self, sessions: list[SessionRecord], tr: Words = ENGLISH) -> list[str]:
        """Sets each session's group; returns a line, in words of `tr`, for each line of the file that matches nobody.

        Names that differ only in the composition of letters and accents are the same.
        """
        trainees = {_composed(session.trainee): session.trainee for session in sessions}
        groups = {_composed(name): group for name, (group, _) in self.of_trainee.items()}
        for session in sessions:
            session.group = groups.get(_composed(session.trainee), "")
        return [
            f"{printable(str(self.file))}:{line}: " + tr('no session is of "{}"', name) + _advice(name, list(trainees.values()), tr)
            for name, (_, line) in sorted(self.of_trainee.items(), key=lambda item: item[1][1])
            if _composed(name) not in trainees
        ]


def groups_text(sessions: list[SessionRecord]) -> str:
    """Number of trainees in each group; empty if nobody is in one."""
    group_of = {session.trainee: session.group for session in sessions}
    count = Counter(group for group in group_of.values() if group)
    return "; groups: " + ", ".join(f"{number} {group}" for group, number in sorted(count.items())) if count else ""


def _composed(name: str) -> str:
    return unicodedata.normalize("NFC", name)


def _advice(name: str, trainees: list[str], tr: Words) -> str:
    first = name.split(",")[0].strip()
    if first in trainees:
        return tr('; a line is TRAINEE,GROUP: is it "{}"?', first)
    likely = difflib.get_close_matches(name, trainees, n=1)
    return tr('; is it "{}"?', likely[0]) if likely else ""
