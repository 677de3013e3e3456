"""Recorded sessions: where they lie, and what a study of several keeps of each."""

import dataclasses
import os
import pathlib
import stat
from collections.abc import Iterable
from typing import Any

from osteomill import _studies

GROUPS_FILE = "groups.csv"


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
    """Whose a session is, of what, when, and its metrics."""

    digest: str  # of the recording's bytes
    file: str
    trainee: str
    case_name: str  # or the scene's
    began_unix_ns: int
    metrics: list[Metric]
    # Of the study, not of the recording.
    group: str = ""  # of the trainee; empty: none
    report: str = ""  # address of its report from the overview; empty: there is none
    # What it began with: only sessions that began alike are attempts at one task.
    bone_at_start: str = ""  # a digest
    settings: dict[str, str] = dataclasses.field(default_factory=dict)  # those that a trainee feels

    def value(self, key: str) -> float | None:
        """Of a metric, added up over tissues, burrs or structures; None where none has a value."""
        values = [metric.value for metric in self.metrics if metric.key == key and metric.value is not None]
        return sum(values) if values else None

    def rating_items(self) -> dict[str, float]:
        """The points of each item of the case's rating, by its name; empty where it has none, or was not rated."""
        return {metric.of: metric.value for metric in self.metrics if metric.key == "rating_item_points" and metric.value is not None}

    def opened(self) -> list[Metric]:
        """Protected structures that lost bone, given back or not: of each the volume."""
        volume_mm3: dict[str, float] = {}
        for metric in self.metrics:
            if metric.key in ("structure_dose_mm3", "structure_undone_mm3") and metric.value:
                volume_mm3[metric.of] = volume_mm3.get(metric.of, 0.0) + metric.value
        return [Metric("structure_dose_mm3", of, mm3, "mm^3", "") for of, mm3 in volume_mm3.items()]


def recordings_in(places: Iterable[pathlib.Path]) -> list[pathlib.Path]:
    """Recordings that are meant: a file itself; of a folder DIR all DIR/*.pcap and DIR/*/session.pcap.

    In the order of their paths, each once. Also what has a recording's name and is none, and links that lead
    nowhere: whoever reads them says what is wrong with each. RuntimeError for what is neither file nor folder, and
    for a folder without any.
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
    """Of a recording's bytes. RuntimeError in one line for what is none."""
    try:
        if not stat.S_ISREG(os.stat(file).st_mode):
            raise RuntimeError(f"{file}: is no file")
    except OSError as error:
        raise RuntimeError(f"{file}: {error.strerror}") from None
    return _studies.digest_of_recording(file)


def read(file: str) -> dict[str, Any]:
    """What _studies.read_session says of a whole recording, or `why_not` it cannot be read."""
    try:
        return _studies.read_session(file)
    except RuntimeError as error:
        return {"why_not": str(error)}


def record_of(digest: str, file: str, found: dict[str, Any]) -> SessionRecord:
    """Of what `read` found."""
    metrics = [Metric(**row) if isinstance(row, dict) else Metric(*row) for row in found["metrics"]]
    return SessionRecord(digest, file, found["trainee"], found["case_name"], found["began_unix_ns"], metrics,
                         bone_at_start=found["bone_at_start"], settings=found["settings"])


def has_entry(path: pathlib.Path) -> bool:
    """Whether there is something, even a link that leads nowhere or in a circle."""
    return os.path.lexists(path)


def is_file(path: pathlib.Path) -> bool:
    return os.path.isfile(path)


def _recordings_of_folder(folder: pathlib.Path) -> list[pathlib.Path]:
    found = []
    for name in os.listdir(folder):
        path = folder / name
        if os.path.isdir(path) and has_entry(inner := path / "session.pcap"):
            found.append(inner)
        elif path.suffix == ".pcap" or not os.path.exists(path):
            found.append(path)
    if not found:
        raise RuntimeError(f"{folder}: holds no recording (*.pcap), and no folder that holds a session.pcap")
    return found
