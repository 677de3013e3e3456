"""Recorded sessions: their places, and the record that a study of several keeps of each."""

import dataclasses
import os
import pathlib
import re
import stat
from collections.abc import Iterable
from typing import Any

from osteomill import _studies
from osteomill.studies.sessions.words import ENGLISH, Words

GROUPS_FILE = "groups.csv"
SESSION_FILE = re.compile(r"session(\.part|\.torn-\d+)?\.pcap")  # the last two have no end


@dataclasses.dataclass(frozen=True)
class Metric:
    """One number of a session: docs/metrics.md."""

    key: str
    of: str  # which tissue, burr or structure; empty: the session
    value: float | None
    unit: str
    text: str


@dataclasses.dataclass
class SessionRecord:
    """A session's trainee, case, time and metrics."""

    digest: str  # of the recording's bytes
    file: str
    trainee: str
    case_name: str  # or the scene's
    began_unix_ns: int
    metrics: list[Metric]
    # These belong to the study, not to the recording.
    group: str = ""  # of the trainee; empty: none
    report: str = ""  # address of its report from the overview; empty: there is none
    # Its start conditions: only sessions that began alike are attempts at one task.
    bone_at_start: str = ""  # a digest
    settings: dict[str, str] = dataclasses.field(default_factory=dict)  # those that a trainee feels

    def value(self, key: str) -> float | None:
        """Value of a metric, added up over tissues, burrs or structures; None if none has a value."""
        values = [metric.value for metric in self.metrics if metric.key == key and metric.value is not None]
        return sum(values) if values else None

    def rating_items(self) -> dict[str, float]:
        """The points of each item of the case's rating, by its name; empty if it has none, or was not rated."""
        return {metric.of: metric.value for metric in self.metrics if metric.key == "rating_item_points" and metric.value is not None}

    def opened(self) -> list[Metric]:
        """Volume lost by each protected structure that lost bone, given back or not."""
        volume_mm3: dict[str, float] = {}
        for metric in self.metrics:
            if metric.key in ("structure_dose_mm3", "structure_undone_mm3") and metric.value:
                volume_mm3[metric.of] = volume_mm3.get(metric.of, 0.0) + metric.value
        return [Metric("structure_dose_mm3", of, mm3, "mm^3", "") for of, mm3 in volume_mm3.items()]


def recordings_in(places: Iterable[pathlib.Path]) -> list[pathlib.Path]:
    """Recordings in the given places: a file itself; in a folder DIR all DIR/*.pcap, and DIR/*/session.pcap or what is left of a
    session that was broken off, DIR/*/session.part.pcap and DIR/*/session.torn-N.pcap.

    In the order of their paths, each once. Files that merely have a recording's name, and links that lead nowhere, are included:
    reading them reports the error of each. RuntimeError for a place that is neither file nor folder, and for a folder without
    any.
    """
    found: list[pathlib.Path] = []
    for place in places:
        if place.is_dir():
            found += sorted(_recordings_of_folder(place))
        elif has_entry(place):
            found.append(place)
        else:
            raise RuntimeError(f"{place}: there is no such recording or folder")
    first_of_file = {os.path.realpath(file): file for file in reversed(found)}
    return [file for file in dict.fromkeys(found) if first_of_file[os.path.realpath(file)] == file]


def groups_file(places: Iterable[pathlib.Path]) -> pathlib.Path | None:
    """The groups.csv in the first of the folders that holds one."""
    return next((file for place in places if is_file(file := place / GROUPS_FILE)), None)


def digest_of(file: pathlib.Path) -> str:
    """Digest of a recording's bytes. RuntimeError in one line if it is no recording."""
    try:
        if not stat.S_ISREG(os.stat(file).st_mode):
            raise RuntimeError(f"{file}: is no file")
    except OSError as error:
        raise RuntimeError(f"{file}: {error.strerror}") from None
    return _studies.digest_of_recording(file)


def read(file: str) -> dict[str, Any]:
    """The result of _studies.read_session, or `why_not` the recording cannot be read at all."""
    try:
        return _studies.read_session(file)
    except RuntimeError as error:
        return {"why_not": str(error)}


def record_of(digest: str, file: str, found: dict[str, Any]) -> SessionRecord:
    """The record of the result of `read`."""
    metrics = [Metric(**row) if isinstance(row, dict) else Metric(*row) for row in found["metrics"]]
    return SessionRecord(digest, file, found["trainee"], found["case_name"], found["began_unix_ns"], metrics,
                         bone_at_start=found["bone_at_start"], settings=found["settings"])


def broken_off_text(file: str, found: dict[str, Any], tr: Words = ENGLISH) -> str:
    """A line, in words of `tr`, for the result of `read` of a recording without the session's end."""
    began = tr.time(found["began_unix_ns"])
    whose = ", ".join(part for part in (found["trainee"], tr(found["case_name"]), began) if part)
    seconds = tr.numbers(_studies.number_text("time_s", found["goes_to_s"]))
    why = found["why_not"].removeprefix(file).lstrip(", ")
    return f"{file}: " + tr("{}: broken off, or still under way: goes to {} s, without the session's end", whose, seconds) + (f" ({why})" if why else "")


def has_entry(path: pathlib.Path) -> bool:
    """Whether something exists, even a link that leads nowhere or in a circle."""
    return os.path.lexists(path)


def is_file(path: pathlib.Path) -> bool:
    return os.path.isfile(path)


def _recordings_of_folder(folder: pathlib.Path) -> list[pathlib.Path]:
    found = []
    for name in os.listdir(folder):
        path = folder / name
        if os.path.isdir(path):
            inside = [inner for inner in os.listdir(path) if SESSION_FILE.fullmatch(inner)]
            found += [path / inner for inner in inside] or ([path] if path.suffix == ".pcap" else [])
        elif path.suffix == ".pcap" or not os.path.exists(path):
            found.append(path)
    if not found:
        raise RuntimeError(f"{folder}: holds no recording (*.pcap), and no folder that holds a session.pcap")
    return found
