"""A run of a study: its cases, its folder and its output.

    outcomes = study.sweep(force_of, cases)
    study.table("forces", pd.DataFrame(outcomes))
    study.chart("forces", figure)
    study.say(f"{len(cases)} motions in {study.out}")

Cases are independent, so that they may run in several processes, or in parts on several machines, and go on where
they were stopped (--jobs, --shard, --merge). Outcomes always pass through a file of JSON lines
(osteomill/part_files.py), so results do not depend on where the cases ran.
"""

import contextlib
import pathlib
import sys
from collections.abc import Callable, Generator, Iterable
from typing import TYPE_CHECKING, Any, TextIO

from osteomill import _studies
from osteomill.part_files import Header, JoinedParts, Part, PartWriter, fingerprint_of
from osteomill.studies.progress import ProgressLine
from osteomill.studies.tables import csv_of, json_of
from osteomill.studies.text import line_of, printable
from osteomill.sweep import keys_of, outcome_by_json, run_cases

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


class PartIsDone(Exception):
    """Raised by a sweep that is one part of several: its outcomes are in its file, the study ends here."""


class StudyRun:
    """Makes the folder `out` once something is written into it. Methods that write raise RuntimeError in one line.

    command, program: of the file of cases, which goes on only with the same; joined: nothing is run, but taken
    from these.
    """

    def __init__(
        self,
        out: pathlib.Path,
        command: list[str],
        program: str,
        *,
        jobs: int = 1,
        part: Part = Part(),
        joined: JoinedParts | None = None,
        said: TextIO | None = None,
        aside: TextIO | None = None,
    ) -> None:
        self.out = out
        self.jobs = jobs
        self._header: Header = {"study": command, "program": program}
        self._part = part
        self._joined = joined
        self._said = said or sys.stdout
        self._aside = aside or sys.stderr
        self._cases: pathlib.Path | None = None

    def say(self, text: str) -> None:
        """Prints a line about results, or about the files' place."""
        print(printable(text), file=self._said, flush=True)

    def warn(self, text: str) -> None:
        """Prints a line beside the results."""
        print(printable(text), file=self._aside, flush=True)

    def sweep(
        self, function: Callable[[Any], Any], cases: Iterable[Any], name: Callable[[Any], str] | None = None
    ) -> list[Any]:
        """``[function(case) for case in cases]``, as osteomill.sweep says of function, cases and outcomes.

        Call it once in a study: one that has cases of several kinds gives all of them. `name`: of a case in
        messages; otherwise its JSON. RuntimeError naming the case that fails.
        """
        if self._cases is not None:
            raise RuntimeError("a study sweeps once, so that its parts can be joined: give all cases at once")
        cases = list(cases)
        keys = keys_of(cases)
        names = [name(case) for case in cases] if name else keys
        if self._joined is not None:
            self._cases = self.out
            return self._joined.outcomes(keys, names)
        part = self._part
        self._cases = self.file(f"cases-{part.number}-of-{part.of}.jsonl")
        header = self._header | {"cases": fingerprint_of(keys), "shard": part.number, "of": part.of}
        with PartWriter(self._cases, header) as writer:
            self._perform(function, cases, keys, names, writer)
        if part.of > 1:
            self.say(f"part {part.number} of {part.of} is in {self._cases}; join the parts with --merge")
            raise PartIsDone
        return [writer.done[index] for index in range(len(cases))]

    def forget_outcomes(self) -> None:
        """The outcomes are used up: the next run in this folder may be another one."""
        if self._cases is not None and self._joined is None and self._part.of == 1:
            self._cases.unlink(missing_ok=True)

    def file(self, name: str) -> pathlib.Path:
        """A file of the folder, which is made."""
        try:
            self.out.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise RuntimeError(f"{self.out}: cannot be made a folder: {error.strerror}") from None
        return self.out / name

    def text(self, name: str, text: str) -> None:
        """A file of this name, with its extension. A file is written beside and renamed."""
        _studies.write_file(self.file(name), text.encode())

    def table(self, name: str, frame: "pd.DataFrame") -> None:
        """NAME.csv"""
        self.text(name + ".csv", csv_of(frame))

    def json(self, name: str, data: Any) -> None:
        """NAME.json"""
        self.text(name + ".json", json_of(data))

    def chart(self, name: str, figure: "Figure") -> None:
        """NAME.svg, of a figure of charts.figure()."""
        from osteomill.studies.charts import svg_of

        self.text(name + ".svg", svg_of(figure))

    def _perform(
        self, function: Callable[[Any], Any], cases: list[Any], keys: list[str], names: list[str], writer: PartWriter
    ) -> None:
        its = sorted(self._part.cases(keys))  # neighbours share costly things, such as a bone
        to_do = [index for index in its if index not in writer.done]
        if done_before := len(its) - len(to_do):
            self.say(f"{done_before} of {len(its)} cases are done in {writer.file}")
        line = ProgressLine(self._aside, "cases")
        try:
            if its:
                line.report(done_before / len(its))
            with contextlib.closing(_run_named(function, cases, names, to_do, self.jobs)) as outcomes:
                for done, (index, outcome) in enumerate(outcomes, done_before + 1):
                    writer.append(index, outcome)
                    writer.done[index] = outcome
                    line.report(done / len(its))
        finally:
            line.end()


class _Named:
    """A function of a case, whose errors say which case it was."""

    def __init__(self, function: Callable[[Any], Any]) -> None:
        self._function = function

    def __call__(self, named: tuple[str, Any]) -> Any:
        name, case = named
        try:
            return self._function(case)
        except (ValueError, RuntimeError, OSError) as error:
            raise RuntimeError(f"case '{name}': {line_of(error)}") from None


def _run_named(
    function: Callable[[Any], Any], cases: list[Any], names: list[str], to_do: list[int], jobs: int
) -> Generator[tuple[int, Any], None, None]:
    """In this process if one case runs at a time: a measurement of times has no other process beside it."""
    named = list(zip(names, cases))
    if jobs > 1:
        return run_cases(_Named(function), named, to_do, jobs)
    return ((index, outcome_by_json(_Named(function), named[index])) for index in to_do)
