"""Repetition of a study from its manifest, twice, with a comparison with the files of its folder."""

import os
import pathlib
import subprocess
import sys
import tempfile
from typing import Any

from osteomill import _studies
from osteomill.studies import manifest
from osteomill.studies.repeated_tables import compare_tables, foreign_json
from osteomill.studies.text import printable


def kept_manifest(folder: pathlib.Path) -> dict[str, Any]:
    """RuntimeError in one line naming a file that is no manifest."""
    file = folder / manifest.NAME
    kept = foreign_json(file)
    is_right = isinstance(kept, dict) and all(isinstance(kept.get(key), str) for key in ("version", "commit"))
    command = kept.get("command") if is_right else None
    if not (isinstance(command, list) and command and all(isinstance(word, str) for word in command)):
        raise RuntimeError(f"{file}: is no manifest of a study")
    return dict(kept)


def repeat(folder: pathlib.Path, kept: dict[str, Any]) -> bool:
    """Whether all is as it was. `kept`: a manifest whose command is one of a study that writes into --out alone."""
    _say(f"{folder}: {' '.join(kept['command'])}")
    _say(f"made by version {kept['version']} of commit {kept['commit']}, repeated by commit {_studies.COMMIT}")
    with tempfile.TemporaryDirectory(prefix="osteomill-repeat-") as scratch:
        once, again = pathlib.Path(scratch, "once"), pathlib.Path(scratch, "again")
        for number, run in enumerate((once, again), 1):
            _run_into(run, kept["command"])
            _say(f"run {number} of 2 is done")
        tables = compare_tables(folder, once, again)
    for line in tables.other:
        _say(line)
    for column in tables.different:
        _say(f"{column.name}: cells that differ: {column.differ}, by up to {column.difference:.3g}; "
             f"its noise is {column.noise:.3g}")
    _say(f"{tables.columns - len(tables.different)} of {tables.columns} columns are as they were")
    return not tables.other and not tables.different and tables.columns > 0


def _run_into(folder: pathlib.Path, command: list[str]) -> None:
    package = str(pathlib.Path(_studies.__file__).parent.parent)
    done = subprocess.run(
        [sys.executable, "-P", "-Xutf8", "-m", "osteomill.studies", *command, "--out", str(folder)],
        env=os.environ | {"PYTHONPATH": package}, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE, text=True, errors="backslashreplace")
    if done.returncode != 0:
        raise RuntimeError(f"the study failed: {(done.stderr.splitlines() or [''])[-1]}")


def _say(line: str) -> None:
    print(printable(line), flush=True)
