"""Tables of a study that was repeated, beside those that were kept."""

import csv
import dataclasses
import io
import json
import math
import pathlib
import re
from typing import Any

from osteomill import _studies
from osteomill.studies.manifest import NAME as MANIFEST

NOISE_MARGIN = 2.0

Columns = dict[str, list[str]]  # cells by column


@dataclasses.dataclass
class RepeatedColumn:
    """One column of one table."""

    name: str  # FILE: COLUMN; of JSON the place, * for any element of a list
    differ: int = 0  # cells that differ by more than the noise
    difference: float = 0.0  # the largest, in the column's unit
    noise: float = 0.0  # the largest between the two new runs


@dataclasses.dataclass
class RepeatedTables:
    columns: int = 0  # that were compared
    different: list[RepeatedColumn] = dataclasses.field(default_factory=list)  # by more than noise
    other: list[str] = dataclasses.field(default_factory=list)  # a line for each table that cannot be compared


def compare_tables(kept: pathlib.Path, once: pathlib.Path, again: pathlib.Path) -> RepeatedTables:
    """Compares every table of `kept`, CSV and JSON, with the same file of two runs of the same command.

    A number differs if both runs are farther from it than NOISE_MARGIN times its column's noise; any other value differs
    if it is other than in both. A column that is equal in both runs is compared exactly. RuntimeError in one line naming a
    file that cannot be read.
    """
    found = RepeatedTables()
    for file in sorted(path.name for path in kept.iterdir() if path.suffix in (".csv", ".json") and path.name != MANIFEST):
        if not ((once / file).exists() and (again / file).exists()):
            found.other.append(f"{file}: is not written any more")
            continue
        before, now, then = (_columns_of(folder / file) for folder in (kept, once, again))
        if not _are_alike(before, now) or not _are_alike(now, then):
            found.other.append(f"{file}: has other rows or columns")
            continue
        for name, cells in before.items():
            found.columns += 1
            column = _compare(f"{file}: {name}", cells, now[name], then[name])
            if column.differ:
                found.different.append(column)
    return found


def foreign_json(file: pathlib.Path) -> Any:
    """JSON from elsewhere. RuntimeError in one line if it cannot be read, is no JSON, or is nested too deeply."""
    text = _studies.read_file(file)
    if _studies.depth_of_json(text) > _studies.DEEPEST_JSON:
        raise RuntimeError(f"{file}: its lists and objects lie more than {_studies.DEEPEST_JSON} deep in one another")
    try:
        return json.loads(text)
    except ValueError:
        raise RuntimeError(f"{file}: is no JSON") from None


def _columns_of(file: pathlib.Path) -> Columns:
    columns: Columns = {}
    if file.suffix == ".json":
        _flatten(foreign_json(file), "", columns)
        return dict(sorted(columns.items()))
    try:
        names, *rows = csv.reader(io.StringIO(_studies.read_file(file).decode()))
    except (ValueError, csv.Error):
        raise RuntimeError(f"{file}: is no table in CSV") from None
    for row in rows:
        for name, cell in zip(names, row):
            columns.setdefault(name, []).append(cell)
    return dict(sorted(columns.items()))


def _flatten(value: Any, place: str, columns: Columns) -> None:
    """Values at the same place of each element of a list are a column."""
    if isinstance(value, dict) and value:
        for key, one in value.items():
            _flatten(one, f"{place}/{'*' if key.isdecimal() else key}", columns)
    elif isinstance(value, list) and value:
        for one in value:
            _flatten(one, f"{place}/*", columns)
    else:
        columns.setdefault(place, []).append(value if isinstance(value, str) else json.dumps(value))


def _are_alike(a: Columns, b: Columns) -> bool:
    return {name: len(cells) for name, cells in a.items()} == {name: len(cells) for name, cells in b.items()}


def _compare(name: str, kept: list[str], once: list[str], again: list[str]) -> RepeatedColumn:
    found = RepeatedColumn(name)
    apart = [_distance(a, b) for a, b in zip(once, again)]
    found.noise = max((one for one in apart if math.isfinite(one)), default=0.0)
    for cell, a, b in zip(kept, once, again):
        difference = min(_distance(cell, a), _distance(cell, b))
        if difference > NOISE_MARGIN * found.noise:
            found.differ += 1
            found.difference = max(found.difference, difference)
    return found


def _distance(a: str, b: str) -> float:
    """Distance of two numbers; infinite if one of them is no number, or not finite."""
    if a == b:
        return 0.0
    x, y = _number(a), _number(b)
    return math.inf if x is None or y is None else abs(x - y)


def _number(text: str) -> float | None:
    if not re.fullmatch(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?", text):
        return None
    value = float(text)
    return value if math.isfinite(value) else None
