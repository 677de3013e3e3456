"""Files of the parts of a sweep: JSON lines, a first one that identifies the cases, then one for each case that is done.

    {"sweep": "peaks.peak_force_n", "cases": "5b3f...", "shard": 1, "of": 3}
    {"case": 17, "outcome": ...}

A line is written as soon as its case is done, so a killed process loses only the cases it was working on, and at most the
last line is torn; a run that continues the file cuts that off. Numbers come back to the last bit.
"""

import dataclasses
import fcntl
import hashlib
import json
import os
import pathlib
from collections.abc import Iterable
from types import TracebackType
from typing import Any


Header = dict[str, Any]  # of the sweep and its cases, and by "shard" and "of" of the part
Outcomes = dict[int, Any]  # by index into the list of all cases


@dataclasses.dataclass(frozen=True)
class Part:
    """One of several parts: `number`, from 1, of `of`."""

    number: int = 1
    of: int = 1

    def cases(self, keys: list[str]) -> list[int]:
        """Indices of its cases, drawn pseudorandomly and always the same: each part gets its share of long cases."""
        lots = [hashlib.sha256(key.encode()).digest() for key in keys]
        return sorted(range(len(keys)), key=lots.__getitem__)[self.number - 1 :: self.of]


def part_named(text: str) -> Part:
    """"2/8". ValueError for anything but I/N with 1 <= I <= N."""
    number, slash, of = text.partition("/")
    both = number + of
    if not (slash and number and of and both.isascii() and both.isdecimal() and len(both) < 16
            and 1 <= int(number) <= int(of)):
        raise ValueError(f"'{text}' is no part I/N with 1 <= I <= N, such as 2/8")
    return Part(int(number), int(of))


def fingerprint_of(keys: Iterable[str]) -> str:
    """Fingerprint of a list: it changes with a key or the order."""
    return hashlib.sha256("\n".join(keys).encode()).hexdigest()


class PartFile:
    """Contents of one file. ValueError in one line for a file that cannot be read, or is not a part's."""

    def __init__(self, file: pathlib.Path) -> None:
        self.file = file
        first, *lines = whole_lines(file).split("\n")
        self.header = _header_of(first, file)
        self.part = Part(self.header["shard"], self.header["of"])
        self.outcomes: Outcomes = {}
        for number, line in enumerate(lines[:-1], 2):
            index, outcome = _case_of(line, f"{file}: line {number}")
            if index in self.outcomes:
                raise ValueError(f"{file}: line {number}: case {index} is there twice")
            self.outcomes[index] = outcome


class PartWriter:
    """Appends to the file of a part, alone: a second writer is refused while this one is open.

    Makes the file, or continues one of the same header; `done` holds its outcomes so far. ValueError in one line if it is
    of another sweep, or another process is writing it.
    """

    def __init__(self, file: pathlib.Path, header: Header) -> None:
        self.file = file
        self.done: Outcomes = {}
        flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK
        try:
            self._lines = os.fdopen(os.open(file, flags, 0o666), "ab", buffering=0)
        except OSError as error:
            raise ValueError(f"{file}: cannot be written: {error.strerror}") from None
        try:
            self._take_up(header)
        except BaseException:
            self._lines.close()
            raise

    def append(self, index: int, outcome: Any) -> None:
        self._write({"case": index, "outcome": outcome})

    def __enter__(self) -> "PartWriter":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._lines.close()

    def _take_up(self, header: Header) -> None:
        try:
            fcntl.flock(self._lines, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ValueError(f"{self.file}: another process is writing it") from None
        except OSError:
            pass  # a file system without locks: the user must start a part only once
        whole = whole_lines(self.file)
        if whole:
            kept = PartFile(self.file)
            if kept.header != header:
                raise ValueError(f"{self.file}: holds cases of another {_difference(kept.header, header)}: "
                                 "give another folder or remove it")
            self.done = kept.outcomes
        self._lines.truncate(len(whole.encode()))  # the torn end after a kill
        if not whole:
            self._write(header)

    def _write(self, line: Any) -> None:
        rest = memoryview(json.dumps(line).encode() + b"\n")
        try:
            while rest:
                rest = rest[self._lines.write(rest) or 0 :]
        except OSError as error:
            raise ValueError(f"{self.file}: cannot be written: {error.strerror}") from None


class JoinedParts:
    """All parts of a sweep that ran in parts. ValueError in one line if they do not fit together, or one is missing."""

    def __init__(self, files: Iterable[pathlib.Path]) -> None:
        self.parts: list[PartFile] = []
        for file in files:
            self._add(PartFile(file))
        self.header = {key: value for key, value in self.parts[0].header.items() if key not in ("shard", "of")}
        of = self.parts[0].part.of
        there = {part.part.number for part in self.parts}
        if len(there) < of:
            missing = [str(number) for number in range(1, min(of, 10_000) + 1) if number not in there]
            raise ValueError(f"missing of {of} parts: {', '.join(missing[:20])}{', ...' if len(missing) > 20 else ''}")

    def _add(self, part: PartFile) -> None:
        for other in self.parts:
            if other.part == part.part:
                raise ValueError(f"part {part.part.number} is there twice: in {other.file} and in {part.file}")
            if other.part.of != part.part.of:
                raise ValueError(f"{part.file}: is one of {part.part.of} parts, others are of another number")
            if other.header | {"shard": 0} != part.header | {"shard": 0}:
                raise ValueError(f"{part.file}: is of another sweep than {other.file}")
        self.parts.append(part)

    def outcomes(self, keys: list[str], names: list[str] | None = None) -> list[Any]:
        """Outcomes of the cases of these keys, in their order; `names`: the cases' names in messages."""
        fingerprint = fingerprint_of(keys)
        outcomes: list[Any] = [None] * len(keys)
        for part in self.parts:
            if part.header["cases"] != fingerprint:
                raise ValueError(f"{part.file}: holds cases of another sweep: give another folder or remove it")
            its = part.part.cases(keys)
            for index in its:
                if index not in part.outcomes:
                    which = f", not '{names[index]}'" if names else ""
                    raise ValueError(
                        f"{part.file}: has done {len(part.outcomes)} of its {len(its)} cases{which}: run part "
                        f"{part.part.number}/{part.part.of} again, which goes on there")
                outcomes[index] = part.outcomes[index]
        return outcomes


def whole_lines(file: pathlib.Path) -> str:
    """The text up to the last end of a line: a kill has torn the rest."""
    try:
        from osteomill import _studies  # which also draws: a caller that reads no part loads no OpenGL

        text = _studies.read_file(file)
        return text[: text.rfind(b"\n") + 1].decode()
    except UnicodeDecodeError:
        raise ValueError(f"{file}: is no part of a sweep: it is no text in UTF-8") from None
    except RuntimeError as error:
        raise ValueError(str(error)) from None


def _header_of(line: str, file: pathlib.Path) -> Header:
    try:
        header = json.loads(line)
        number, of = header["shard"], header["of"]
        is_right = (type(number), type(of), type(header["cases"])) == (int, int, str) and 1 <= number <= of
    except (ValueError, KeyError, TypeError, RecursionError):
        is_right = False
    if not is_right:
        raise ValueError(f"{file}: is no part of a sweep: its first line says of no cases")
    return dict(header)


def _case_of(line: str, place: str) -> tuple[int, Any]:
    try:
        case = json.loads(line)
        index, outcome = case["case"], case["outcome"]
        if type(index) is int and index >= 0:
            return index, outcome
    except RecursionError:
        raise ValueError(f"{place}: its lists and objects lie too deep in one another") from None
    except (ValueError, KeyError, TypeError):
        pass
    raise ValueError(f"{place}: is no case")


def _difference(kept: Header, own: Header) -> str:
    """Difference of two headers, in words."""
    same_but_build = kept | {"program": None} == own | {"program": None}
    return "build of this program" if same_but_build else "sweep"
