"""A sweep of independent cases: over the processors of one machine, or in parts over many."""

import concurrent.futures
import fcntl
import hashlib
import json
import os
import pathlib
import sys
from collections.abc import Callable, Iterable, Iterator
from typing import Any


def sweep(
    function: Callable[[Any], Any],
    cases: Iterable[Any],
    *,
    jobs: int | None = None,
    shard: str | None = None,
    out: str | os.PathLike[str] | None = None,
    merge: str | os.PathLike[str] | None = None,
) -> list[Any]:
    """Return ``[function(case) for case in cases]``, worked out by several processes.

    function: of one case; defined at the top of a module or script, so that other processes find it.
    cases: what JSON can say (numbers, texts, lists, dicts); each its own, none there twice.
    jobs: how many processes; None: as many as this process may use processors.
    shard, out: run part ``"I/N"`` only, keep what is done in ``OUT/sweep-I-of-N.jsonl`` and end the
        program (``SystemExit``). A part that was killed goes on there when it is run again.
    merge: the folder of all parts; nothing is run, what they have done is returned.

    Left out, shard, out and merge are those of the environment (OSTEOMILL_SHARD, OSTEOMILL_OUT,
    OSTEOMILL_MERGE), so that a script runs under Slurm without change: scripts/array.sbatch.

    What the function returns passes through JSON: arrays and scalars of numpy become lists and numbers,
    tuples lists, to the last bit; so the result is the same in one process and in parts. Raises
    ValueError in one line for parts that are missing, there twice, not done, or of other cases, and what
    the function raises.
    """
    cases = list(cases)
    keys = [json.dumps(case, sort_keys=True, default=_plain) for case in cases]
    if len(set(keys)) != len(keys):
        raise ValueError("a case is there twice: " + next(k for i, k in enumerate(keys) if k in keys[:i]))
    name = f"{function.__module__}.{function.__qualname__}"
    header: dict[str, Any] = {"sweep": name, "cases": hashlib.sha256("\n".join(keys).encode()).hexdigest()}
    merge = merge or os.environ.get("OSTEOMILL_MERGE")
    if merge:
        return _merged(pathlib.Path(merge), header, keys)
    shard = shard or os.environ.get("OSTEOMILL_SHARD")
    if not shard:
        outcomes: list[Any] = [None] * len(cases)
        for index, outcome in _run(function, cases, range(len(cases)), jobs):
            outcomes[index] = outcome
        return outcomes
    number, of = _part(shard)
    folder = pathlib.Path(out or os.environ.get("OSTEOMILL_OUT") or "out/parts")
    file = folder / f"sweep-{number}-of-{of}.jsonl"
    folder.mkdir(parents=True, exist_ok=True)
    _run_part(function, cases, keys, (number, of), jobs, file, header | {"shard": number, "of": of})
    print(f"part {number} of {of} is in {file}; OSTEOMILL_MERGE={folder} joins the parts")
    sys.exit(0)


def _plain(value: Any) -> Any:
    """What numpy has, as JSON says it."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is nothing that JSON can say")


def _part(text: str) -> tuple[int, int]:
    number, slash, of = text.partition("/")
    if not (slash and number.isdecimal() and of.isdecimal() and 1 <= int(number) <= int(of)):
        raise ValueError(f"'{text}' is no part I/N with 1 <= I <= N, such as 2/8")
    return int(number), int(of)


def _cases_of(part: tuple[int, int], keys: list[str]) -> list[int]:
    """Indices of a part's cases, drawn as by lot, always the same: each part has its share of what takes long."""
    number, of = part
    lots = [hashlib.sha256(key.encode()).digest() for key in keys]
    return sorted(range(len(keys)), key=lots.__getitem__)[number - 1 :: of]


def _outcome(function: Callable[[Any], Any], case: Any) -> str:
    return json.dumps(function(case), default=_plain)


def _run(
    function: Callable[[Any], Any], cases: list[Any], indices: Iterable[int], jobs: int | None
) -> Iterator[tuple[int, Any]]:
    """Pairs of index and outcome, as they are done."""
    with concurrent.futures.ProcessPoolExecutor(jobs or len(os.sched_getaffinity(0))) as pool:
        futures = {pool.submit(_outcome, function, cases[index]): index for index in indices}
        try:
            for future in concurrent.futures.as_completed(futures):
                yield futures[future], json.loads(future.result())
        finally:
            pool.shutdown(cancel_futures=True)


def _run_part(
    function: Callable[[Any], Any],
    cases: list[Any],
    keys: list[str],
    part: tuple[int, int],
    jobs: int | None,
    file: pathlib.Path,
    header: dict[str, Any],
) -> None:
    with open(file, "a+", encoding="utf-8") as lines:
        try:
            fcntl.flock(lines, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ValueError(f"{file}: another process is writing it") from None
        whole = _whole_lines(file)
        lines.truncate(len(whole.encode()))  # what a kill tore off
        if whole:
            done = _read(file, header)
        else:
            done = dict[int, Any]()
            print(json.dumps(header), file=lines, flush=True)
        to_do = [index for index in _cases_of(part, keys) if index not in done]
        for index, outcome in _run(function, cases, to_do, jobs):
            print(json.dumps({"case": index, "outcome": outcome}), file=lines, flush=True)


def _whole_lines(file: pathlib.Path) -> str:
    text = file.read_text(encoding="utf-8")
    return text[: text.rfind("\n") + 1]


def _read(file: pathlib.Path, header: dict[str, Any]) -> dict[int, Any]:
    """Outcomes by index; `header`: of this sweep, as far as all parts have it, or with the part."""
    try:
        first, *lines = [json.loads(line) for line in _whole_lines(file).splitlines()]
        its = {key: first[key] for key in header}
    except (ValueError, KeyError, RecursionError):
        raise ValueError(f"{file}: is no part of a sweep") from None
    if its != header:
        raise ValueError(f"{file}: holds cases of another sweep: give another folder or remove it")
    return {line["case"]: line["outcome"] for line in lines}


def _merged(folder: pathlib.Path, header: dict[str, Any], keys: list[str]) -> list[Any]:
    files = sorted(folder.glob("**/sweep-*-of-*.jsonl"))
    if not files:
        raise ValueError(f"{folder}: holds no sweep-*-of-*.jsonl")
    parts = dict[tuple[int, int], pathlib.Path]()
    outcomes: list[Any] = [None] * len(keys)
    for file in files:
        done = _read(file, header)
        first = json.loads(_whole_lines(file).splitlines()[0])
        part = first["shard"], first["of"]
        if part in parts:
            raise ValueError(f"part {part[0]} is there twice: in {parts[part]} and in {file}")
        parts[part] = file
        if len({of for _, of in parts}) > 1:
            raise ValueError(f"{file}: is one of {part[1]} parts, others are of another number")
        its = _cases_of(part, keys)
        for index in its:
            if index not in done:
                raise ValueError(f"{file}: has done {len(done)} of its {len(its)} cases: run part "
                                 f"{part[0]}/{part[1]} again, which goes on there")
            outcomes[index] = done[index]
    of = next(iter(parts))[1]
    missing = [str(number) for number in range(1, of + 1) if (number, of) not in parts]
    if missing:
        raise ValueError(f"missing of {of} parts: {', '.join(missing)}")
    return outcomes
