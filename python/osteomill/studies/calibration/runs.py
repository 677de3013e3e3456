"""The table of runs on a dynamometer: each line is one straight slot of a spherical burr, its mean force, and the uncertainty
of that.

The frame of a run: x along the feed (the burr's velocity relative to the specimen), z up, out of the flat
specimen, y across = up x feed. The force is that of the bone on the burr.
"""

import os
import pathlib
import re
from collections.abc import Callable
from typing import Any, NoReturn

import numpy as np
import pandas as pd

from osteomill import _studies
from osteomill.studies.calibration.forces import AXES
from osteomill.studies.text import why_not_plain

FORCES = [f"force_{axis}_n" for axis in AXES]
SPREADS = [f"spread_{axis}_n" for axis in AXES]
GROOVE = "previous_groove_mm_higher"
MAY_BE_MISSING = (GROOVE, "order")
SENSES = ("clockwise", "counter-clockwise")
SETTINGS = ["diameter_mm", "edges", "turns", "rpm", "feed_mm_per_s", "depth_mm", "tilt_deg", "tilt_direction_deg"]

#: Columns of numbers: the right values in words, and the check of a value.
NUMBERS: dict[str, tuple[str, Callable[[float], bool]]] = {
    "diameter_mm": ("a number from 0.2 to 20", lambda v: 0.2 <= v <= 20.0),
    "edges": ("a whole number from 1 to 64", lambda v: 1 <= v <= 64 and v == int(v)),
    "rpm": ("a number from 100 to 500000", lambda v: 100.0 <= v <= 500_000.0),
    "feed_mm_per_s": ("a number above 0, at most 1000", lambda v: 0.0 < v <= 1000.0),
    "depth_mm": ("a number above 0, at most the burr's radius", lambda v: v > 0.0),
    "tilt_deg": ("a number from 0 to 85", lambda v: 0.0 <= v <= 85.0),
    "tilt_direction_deg": ("a number from -360 to 360", lambda v: abs(v) <= 360.0),
    GROOVE: ("a number above 0, or empty", lambda v: v > 0.0),
    "order": ("a number, in the order in which the runs were made", lambda v: True),
    **{name: ("a number, N", lambda v: True) for name in FORCES},
    **{name: ("a number above 0, N, the standard deviation of the mean force", lambda v: v > 0.0) for name in SPREADS},
}
COLUMNS = ["run", "material", "turns", *NUMBERS]
NUMBER = re.compile(r"-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


def read_runs(file: pathlib.Path) -> pd.DataFrame:
    """A row for each run: the COLUMNS, a groove that is not there NaN; and `time`, 0 of the first run that was made to
    1 of the last, evenly by their order or, without that, their lines.

    Raises one line, FILE:LINE, that says what is wrong and what would be right.
    """
    header: list[str] = []
    rows: list[dict[str, Any]] = []
    names: set[str] = set()
    for number, line in _studies.table_lines(file):
        where = f"{file}:{number}"
        cells = [os.fsdecode(cell) for cell in line]
        if not header:
            header = _header_of(cells, where)
            continue
        if len(cells) != len(header):
            raise ValueError(f"{where}: {len(cells)} values; there must be {len(header)}, one for each column")
        rows.append(_run_of(dict(zip(header, cells)), where))
        if rows[-1]["run"] in names:
            raise ValueError(f"{where}: run is '{rows[-1]['run']}'; it must be a name that no other line has")
        names.add(rows[-1]["run"])
    if not rows:
        raise ValueError(f"{file}: holds no run; the first line names the columns, each other is a run")
    runs = pd.DataFrame(rows)
    place = runs.order.rank() - 1.0 if "order" in runs else pd.Series(np.arange(float(len(runs))))
    if not place.is_unique:
        raise ValueError(f"{file}: two runs have the order {runs.order[place.duplicated()].iloc[0]:g}; each must have its own")
    return runs.assign(time=place / max(1.0, place.max()))


def _header_of(names: list[str], where: str) -> list[str]:
    for at, name in enumerate(names):
        if name not in COLUMNS:
            raise ValueError(f"{where}: unknown column '{name}'; there are {', '.join(COLUMNS)}")
        if name in names[:at]:
            raise ValueError(f"{where}: column '{name}' is there twice; each must be there once")
    for column in COLUMNS:
        if column not in names and column not in MAY_BE_MISSING:
            raise ValueError(f"{where}: column '{column}' is missing; the first line must name it")
    return names


def _run_of(cells: dict[str, str], where: str) -> dict[str, Any]:
    def wrong(column: str, wanted: str) -> NoReturn:
        raise ValueError(f"{where}: {column} is '{cells[column]}'; it must be {wanted}")

    for column in ("run", "material"):
        if not cells[column] or why_not_plain(cells[column]):
            wrong(column, "a text" if not cells[column] else "a text in UTF-8 without control characters")
    run: dict[str, Any] = {column: cells[column] for column in ("run", "material", "turns")}
    if run["turns"] not in SENSES:
        wrong("turns", f"{' or '.join(SENSES)}, seen from the handpiece")
    run[GROOVE] = np.nan
    for column, (wanted, is_good) in NUMBERS.items():
        if column not in cells or column == GROOVE and not cells[column]:
            continue
        run[column] = float(cells[column]) if NUMBER.fullmatch(cells[column]) else np.inf
        if not (np.isfinite(run[column]) and is_good(run[column])):
            wrong(column, wanted)
    if run["depth_mm"] > 0.5 * run["diameter_mm"]:
        wrong("depth_mm", NUMBERS["depth_mm"][0])
    return run


def table_to_fill_in(settings: pd.DataFrame, material: str) -> str:
    """CSV of runs that are still to be made: no forces, no spreads."""
    table = settings[SETTINGS].copy()
    table.insert(0, "run", range(1, len(table) + 1))
    table.insert(1, "material", material)
    return str(table.reindex(columns=[*table, *FORCES, *SPREADS]).to_csv(index=False, float_format="%.15g"))
