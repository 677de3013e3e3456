"""Options of the studies: a parser whose errors are one line, kinds of values, and the options of every study."""

import argparse
import math
import pathlib
import re
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from osteomill.part_files import part_named
from osteomill.studies.text import one_line, why_not_plain
from osteomill.sweep import processors


class UsageError(Exception):
    """An error on the command line, in one line with what would be right."""


class Parser(argparse.ArgumentParser):
    """Options have their whole names, their errors are UsageError, and they may stand in any order."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(allow_abbrev=False, **settings)
        self.described: list[argparse.Action] = []

    def add_argument(self, *names: Any, **settings: Any) -> argparse.Action:
        action = super().add_argument(*names, **settings)
        if not isinstance(action, argparse._HelpAction):
            self.described.append(action)
        return action

    def parse(self, words: Sequence[str]) -> argparse.Namespace:
        for word in words:
            name, equals, value = word.partition("=")
            if name.startswith("--") and equals and not value:
                raise UsageError(f"{name}: is given without a value")
            if not word:
                raise UsageError("an argument is empty: a variable of a script that was not set?")
        self._require_values(words)
        return self.parse_intermixed_args(list(words))

    def _require_values(self, words: Sequence[str]) -> None:
        """argparse of Python 3.13 takes the name of the next option for a value of one that has several."""
        for place, word in enumerate(words):
            action = self._option_string_actions.get(word)
            if action is None or not isinstance(action.nargs, int) or action.nargs == 0:
                continue
            values = words[place + 1 : place + 1 + action.nargs]
            if len(values) < action.nargs or any(value in self._option_string_actions for value in values):
                raise UsageError(f"{word}: expected {action.nargs} arguments")

    def error(self, message: str) -> NoReturn:
        message = re.sub("^argument (-h/)?", "", message)
        message = re.sub("^the following arguments are required: (.*)$", r"\1 is required", message)
        message = re.sub("^unrecognized arguments: ", "The following argument was not expected: ", message)
        raise UsageError(one_line(message))


def name_of(action: argparse.Action) -> str:
    """An option's longest name, or the placeholder of a value without one."""
    return action.option_strings[-1] if action.option_strings else str(action.metavar or action.dest)


def require_plain(words: Sequence[str]) -> None:
    """Names go into files and onto terminals."""
    for number, word in enumerate(words, 1):
        if why := why_not_plain(word):
            raise UsageError(f"argument {number}, '{one_line(word)}', {why}; names are UTF-8 without control characters")


def number(text: str) -> float:
    """A finite one."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"'{one_line(text)}' is no number")
    return value


def number_above_zero(text: str) -> float:
    if (value := number(text)) > 0.0:
        return value
    raise argparse.ArgumentTypeError(f"{one_line(text)} is not above 0")


def number_within(low: float, high: float) -> Callable[[str], float]:
    """Both ends are allowed."""

    def read(text: str) -> float:
        if low <= (value := number(text)) <= high:
            return value
        raise argparse.ArgumentTypeError(f"{one_line(text)} is not within {low:g} to {high:g}")

    return read


def whole_within(low: int, high: int) -> Callable[[str], int]:
    """Both ends are allowed."""

    def read(text: str) -> int:
        if len(text) < 20 and re.fullmatch("[+-]?[0-9]+", text) and low <= int(text) <= high:
            return int(text)
        raise argparse.ArgumentTypeError(f"Value {one_line(text)} not in range {low} to {high}")

    return read


def one_of(*names: str) -> Callable[[str], str]:
    def read(text: str) -> str:
        if text in names:
            return text
        raise argparse.ArgumentTypeError(f"'{one_line(text)}' is not one of {', '.join(names)}")

    return read


def listed(read: Callable[[str], Any]) -> Callable[[str], list[Any]]:
    """Several values, with commas between."""
    return lambda text: [read(one) for one in text.split(",")]


def existing_file(text: str) -> pathlib.Path:
    if (path := pathlib.Path(text)).exists() and not path.is_dir():
        return path
    raise argparse.ArgumentTypeError(f"File does not exist: {one_line(text)}")


def add_common(parser: argparse.ArgumentParser, name: str, usual_jobs: int | None) -> None:
    """--out, and the options for running a study's cases."""
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("study") / name, metavar="DIR",
                        help="folder for what the study writes; made if it is not there (%(default)s)")
    parser.add_argument("--jobs", type=whole_within(1, 1024), default=usual_jobs or processors(), metavar="N",
                        help="cases that run at a time (here %(default)s)")
    parser.add_argument("--shard", type=_part_text, metavar="I/N",
                        help="run part I of N only; a part that was stopped goes on where it was")
    parser.add_argument("--merge", nargs="+", metavar="DIR",
                        help="join parts that ran apart, files of cases or folders that hold them, and write the "
                        "results; not together with --shard")


def _part_text(text: str) -> str:
    try:
        part_named(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(one_line(str(error))) from None
    return text
