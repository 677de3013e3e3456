"""The command in a study's manifest or file of cases: data from which a command line is made."""

import hashlib
import os
import pathlib
import re
from collections.abc import Iterable
from typing import Any

from osteomill import _studies
from osteomill.part_files import JoinedParts
from osteomill.studies.options import Parser, UsageError
from osteomill.studies.text import one_line

# Options of output and of execution, which no file keeps.
HOW = ("--out", "--jobs", "--shard", "--merge")
NOT_KEPT = (*HOW, "--database", "--help")


def words_of_study(words: Iterable[str]) -> list[str]:
    """The words that determine what is run."""
    kept: list[str] = []
    skips_value = False
    for word in words:
        name, equals, _ = word.partition("=")
        if skips_value:
            skips_value = False
        elif name in HOW:
            skips_value = not equals
        else:
            kept.append(word)
    return kept


def require_study_words(words: Any, study: str, parser: Parser, file: pathlib.Path) -> list[str]:
    """The words, if they are `study` and options of it that determine what is run; else RuntimeError in one line."""

    def fail(why: str) -> RuntimeError:
        shown = " ".join(map(str, words)) if isinstance(words, list) else str(words)
        return RuntimeError(f"{file}: it names no study that can be repeated: '{one_line(shown)}': {one_line(why)}")

    if not (isinstance(words, list) and words and all(isinstance(word, str) for word in words)):
        raise fail("it is no list of words")
    if words[0] != study:
        raise fail(f"'{words[0]}' is none of the studies")
    for word in words[1:]:
        name = word.partition("=")[0]
        if name in NOT_KEPT or (name.startswith("-") and not name.startswith("--") and not _is_number(name)) or name == "--":
            raise fail(f"'{name}' is no option that says what is run")
    try:
        parser.parse(words[1:])
    except UsageError as error:
        raise fail(str(error)) from None
    return list(words)


def joined_parts(places: list[str]) -> JoinedParts:
    """Parts from files of cases and folders that hold them (cases-*.jsonl), all of this build of the program."""
    files: list[pathlib.Path] = []
    for place in map(pathlib.Path, places):
        if place.is_dir():
            found = sorted(place.glob("cases-*.jsonl"))
            if not found:
                raise ValueError(f"{place}: holds no cases-*.jsonl")
            files += found
        else:
            files.append(place)
    joined = JoinedParts(files)
    if joined.header.get("program") != program_fingerprint():
        raise ValueError(f"{files[0]}: was made by another build of this program")
    return joined


def program_fingerprint() -> str:
    """Fingerprint of the package with its compiled modules: it changes with each build."""
    package = pathlib.Path(_studies.__file__).parent
    files = [pathlib.Path(folder, name) for folder, _, names in os.walk(package, followlinks=True) for name in names]
    digest = hashlib.sha256()
    for file in sorted(files):
        if file.suffix in (".py", ".so"):
            digest.update(file.name.encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()[:16]


def _is_number(word: str) -> bool:
    return re.fullmatch(r"-[0-9.]+(e[+-]?[0-9]+)?", word) is not None
