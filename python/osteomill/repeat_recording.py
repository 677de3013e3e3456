"""A recorded session, computed again from its recording alone."""

from __future__ import annotations

import os
from dataclasses import dataclass

from osteomill import _core


@dataclass(frozen=True)
class Repeated:
    """Comparison of a session that was computed again with its recording."""

    is_equal: bool
    """Every number of every tick as it is written, and every checksum of the bone."""
    line: str
    """In words: "equal to the bit: ...", or what differs first, or why it cannot be repeated."""
    ticks: int
    """That were compared."""
    tick: int | None
    """The first that differs."""
    time_s: float
    """Its time."""

    def __str__(self) -> str:
        return self.line


def repeat(recording: _core.Recording | str | os.PathLike[str]) -> Repeated:
    """Compute a recorded session again, and compare it with its recording tick by tick.

    recording: a Recording or its file, of haptic_server --record or Session(record=...), of protocol 2.3 or later: its start
    (scene, bone, arm) and the hand of every tick are in it, so it needs no case. Older recordings are reported to repeat only to
    0.1 um. Raises Fault for a file that is no recording.
    """
    file: str | os.PathLike[str] = recording.file if isinstance(recording, _core.Recording) else recording
    return Repeated(*_core._repeat(file))


def say_repeated(file: os.PathLike[str]) -> int:
    """For the program osteomill_study: prints the result in a line; returns 0 if all is equal, else 1."""
    result = repeat(file)
    print(f"{os.fspath(file)}: {result}", flush=True)
    return 0 if result.is_equal else 1
