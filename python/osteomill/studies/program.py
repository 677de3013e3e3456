"""The program osteomill_study: parses, runs a study, reports an error in one line."""

import argparse
import importlib
import os
import pathlib
import signal
import sys
import warnings
from collections.abc import Sequence
from typing import Any

from osteomill import _studies
from osteomill.part_files import JoinedParts, part_named
from osteomill.repeat_recording import say_repeated
from osteomill.studies import manifest, repeat
from osteomill.studies.kept_command import joined_parts, program_fingerprint, require_study_words, words_of_study
from osteomill.studies.options import Parser, UsageError, add_common, name_of, require_plain
from osteomill.studies.study_run import PartIsDone, StudyRun
from osteomill.studies.text import line_of, one_line, printable

PROGRAM = "osteomill_study"
REPEAT = "repeat"

# Name, module of osteomill.studies, description.
STUDIES = (
    ("force", "force", "the milling force: voxel model against analytical reference"),
    ("tradeoff", "tradeoff", "speed against accuracy, on one page, for every choice that costs time"),
    ("choose", "choose", "the cheapest settings that are true enough for a case, measured on this machine"),
    ("stability", "stability", "the stability map: which coupling holds where, and how true it is there"),
    ("arms", "arms", "what an arm makes of the force: encoder steps, springs, grips"),
    ("polishing", "polishing", "the published polishing experiment: its figures"),
    ("render", "render", "the pictures: frame time against accuracy, how smooth a cut looks"),
    ("realtime", "realtime", "how late the haptic loop wakes and how long it takes, in turns with cyclictest; then under stress-ng"),
    ("bridge", "bridge", "the way to an arm behind the bridge and back, beside a bare echo of the same size"),
    ("states", "states", "the states of milling as data: force within the tooth period, vibration, sound, and what is true of the bone"),
    ("calibrate", "calibrate", "the six coefficients of the milling law from forces on a dynamometer; or which runs to make"),
    ("sessions", "sessions", "recorded sessions of several trainees: tables, learning curves, an overview, a tidy CSV"),
    ("assist", "assist", "recorded hands once more, with and without a virtual fixture: damage, time, force"),
    ("repeat", REPEAT, "run a study again, twice, and say what differs from its folder by more than its noise; or a recording, to the bit"),
)

EXIT_FAILURE, EXIT_USAGE, EXIT_INTERRUPTED = 1, 2, 128 + signal.SIGINT


def main(argv: Sequence[str]) -> int:
    """Runs the study that the arguments behind the program's name say; the exit status."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    if not sys.flags.dev_mode:  # python3 -X dev
        warnings.simplefilter("ignore")
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        return _run(list(argv))
    except UsageError as error:
        return _fail(f"{line_of(error)} (see --help)", EXIT_USAGE)
    except KeyboardInterrupt:
        return _fail("interrupted; the same command goes on with the cases that are done", EXIT_INTERRUPTED)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # the reader has gone: there is nobody to tell
        return EXIT_FAILURE
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        return _fail(f"needs {package} of Python, which is not installed (package python3-{package})", EXIT_FAILURE)
    except (ValueError, RuntimeError, OSError) as error:
        return _fail(line_of(error), EXIT_FAILURE)
    except RecursionError:
        return _fail("something lies too deep in itself", EXIT_FAILURE)
    except MemoryError:
        return _fail("memory is short", EXIT_FAILURE)
    except Exception as error:
        if sys.flags.dev_mode:
            raise
        return _fail(f"a fault of this program: {type(error).__name__}: {line_of(error)}", EXIT_FAILURE)


def _run(words: list[str]) -> int:
    require_plain(words)
    overview = Parser(prog=PROGRAM, usage=f"{PROGRAM} [OPTIONS] STUDY ...", epilog=_list_of_studies(),
                      description="Studies of the simulator: numbers and charts.",
                      formatter_class=argparse.RawDescriptionHelpFormatter)
    overview.add_argument("--version", action="version", version=_studies.VERSION)
    names = [name for name, _, _ in STUDIES]
    if not words:
        raise UsageError(f"a study to run: {', '.join(names[:-1])} or {names[-1]} is required")
    if words[0] not in names:
        if words[0].startswith("-"):
            return _parse_alone(overview, words)
        raise UsageError(f"The following argument was not expected: {printable(words[0])}; it must be a study: "
                         f"{', '.join(names[:-1])} or {names[-1]}")
    module = next(module for name, module, _ in STUDIES if name == words[0])
    if module == REPEAT:
        return _repeat(words)
    return _run_study(words, importlib.import_module(f"osteomill.studies.{module}"))


def _parse_alone(parser: Parser, words: list[str]) -> int:
    """Parses alone; --help and --version end here."""
    try:
        parser.parse(words)
    except SystemExit as end:
        return int(end.code or 0)
    raise UsageError("a study to run is required")


def _list_of_studies() -> str:
    return "studies:\n" + "\n".join(f"  {name:<12}{what}" for name, _, what in STUDIES)


def _repeat(words: list[str]) -> int:
    """The folder may be from elsewhere: its manifest must name a study that writes into --out alone."""
    parser = Parser(prog=f"{PROGRAM} {REPEAT}", description=_what_is(REPEAT))
    parser.add_argument("dir", type=pathlib.Path, help="the folder that the study wrote; or a recording (.pcap), which is computed again")
    try:
        folder = parser.parse(words[1:]).dir
    except SystemExit as end:
        return int(end.code or 0)
    if folder.is_file():
        return say_repeated(folder)
    kept = repeat.kept_manifest(folder)
    file, name = folder / manifest.NAME, kept["command"][0]
    module = next((module for study, module, _ in STUDIES if study == name), None)
    study = importlib.import_module(f"osteomill.studies.{module}") if module not in (None, REPEAT) else None
    if study is None or not getattr(study, "IS_REPEATED", True):
        raise RuntimeError(f"{file}: it names no study that can be repeated: '{one_line(' '.join(kept['command']))}'")
    require_study_words(kept["command"], name, parser_of(name, study), file)
    return 0 if repeat.repeat(folder, kept) else EXIT_FAILURE


def _what_is(name: str) -> str:
    return next(what for study, _, what in STUDIES if study == name)


def parser_of(name: str, module: Any) -> Parser:
    """Parser of a study's options."""
    parser = Parser(prog=f"{PROGRAM} {name}", description=_what_is(name))
    module.add_options(parser)
    add_common(parser, name, getattr(module, "JOBS", None))
    return parser


def _run_study(words: list[str], module: Any) -> int:
    parser = parser_of(words[0], module)
    command, joined, words = _with_parts(words, parser)
    try:
        options = parser.parse(words[1:])
    except SystemExit as end:
        return int(end.code or 0)
    if options.shard and options.merge:
        raise UsageError("--merge excludes --shard")
    _require_distinct_files(parser, options, module)
    run = StudyRun(
        options.out,
        command,
        program_fingerprint(),
        jobs=getattr(module, "JOBS", 1) if getattr(module, "ONE_BY_ONE", False) else options.jobs,
        part=part_named(options.shard or "1/1"),
        joined=joined,
    )
    try:
        module.run(options, run)
    except PartIsDone:
        return 0
    run.json(manifest.NAME.removesuffix(".json"), manifest.manifest_of(command, parser, options))
    run.forget_outcomes()
    return 0


def _with_parts(words: list[str], parser: Parser) -> tuple[list[str], JoinedParts | None, list[str]]:
    """The command that is run, the parts of --merge, and the words to parse, which then come from the parts."""
    places = _values_of("--merge", words)
    if not places:
        return words_of_study(words), None, words
    given = [word.partition("=")[0] for word in words if word.startswith("-")]
    for name in given:
        if name not in ("--merge", "--out"):
            raise UsageError(f"with --merge the parts say what was run: leave {printable(name)} out")
    joined = joined_parts(places)
    study = joined.header.get("study")
    name = study[0] if isinstance(study, list) and study else ""
    if words_of_study(_without_values("--merge", words)) != [name]:
        raise UsageError(f"the parts are of the study '{printable(str(name))}'")
    command = require_study_words(study, words[0], parser, pathlib.Path("the parts of --merge"))
    return command, joined, command + words[1:]


def _values_of(option: str, words: list[str]) -> list[str]:
    values: list[str] = []
    is_its = False
    for word in words:
        if word.startswith("--"):
            name, equals, value = word.partition("=")
            is_its = name == option
            values += [value] if is_its and equals else []
        elif is_its:
            values.append(word)
    return values


def _without_values(option: str, words: list[str]) -> list[str]:
    rest: list[str] = []
    is_its = False
    for word in words:
        if word.startswith("--"):
            is_its = word.partition("=")[0] == option
        if not is_its:
            rest.append(word)
    return rest


def _require_distinct_files(parser: Parser, options: argparse.Namespace, module: Any) -> None:
    """No file that an option names is one of those that the study writes."""
    read = []
    for action in parser.described:
        value = getattr(options, action.dest)
        for one in value if isinstance(value, list) else [value]:
            if action.dest != "out" and isinstance(one, (str, pathlib.Path)) and os.path.isfile(one):
                read.append((name_of(action), pathlib.Path(one)))
    names = [*getattr(module, "WRITES", ("*.csv", "*.json", "*.svg")), "cases-*.jsonl", manifest.NAME]
    try:
        _studies.require_distinct_files(read, options.out, names)
    except RuntimeError as error:
        raise UsageError(str(error)) from None


def _fail(line: str, status: int) -> int:
    print(f"{PROGRAM}: {line}", file=sys.stderr, flush=True)
    return status
