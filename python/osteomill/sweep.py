"""A sweep of independent cases: over the processors of one machine, or in parts over many."""

import concurrent.futures
import json
import multiprocessing
import multiprocessing.connection
import os
import pathlib
import signal
import sys
import threading
from collections.abc import Callable, Generator, Iterable
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from osteomill.part_files import Header, JoinedParts, Part, PartWriter, fingerprint_of, part_named


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
    cases: values of JSON (numbers, texts, lists, dicts), each only once.
    jobs: number of processes; None: as many as this process may use processors.
    shard, out: run part ``"I/N"`` only, keep its outcomes in ``OUT/sweep-I-of-N.jsonl`` and end the
        program (``SystemExit``). A part that was killed goes on there when it is run again.
    merge: the folder of all parts; nothing is run, their outcomes are returned.

    Left out, shard, out and merge are those of the environment (OSTEOMILL_SHARD, OSTEOMILL_OUT,
    OSTEOMILL_MERGE), so that a script runs under Slurm without change: scripts/array.sbatch.

    The function's results pass through JSON: arrays and scalars of numpy become lists and numbers, tuples lists, to the last
    bit; so the result is the same in one process and in parts. Raises ValueError in one line for parts that are missing,
    present twice, not done, or of other cases, and any exception of the function.
    """
    cases = list(cases)
    keys = keys_of(cases)
    name = f"{function.__module__}.{function.__qualname__}"
    header: Header = {"sweep": name, "cases": fingerprint_of(keys)}
    merge = merge or os.environ.get("OSTEOMILL_MERGE")
    if merge:
        return _joined(pathlib.Path(merge), header, keys)
    shard = shard or os.environ.get("OSTEOMILL_SHARD")
    if not shard:
        outcomes: list[Any] = [None] * len(cases)
        for index, outcome in run_cases(function, cases, range(len(cases)), jobs):
            outcomes[index] = outcome
        return outcomes
    part = part_named(shard)
    folder = pathlib.Path(out or os.environ.get("OSTEOMILL_OUT") or "out/parts")
    file = folder / f"sweep-{part.number}-of-{part.of}.jsonl"
    folder.mkdir(parents=True, exist_ok=True)
    with PartWriter(file, header | {"shard": part.number, "of": part.of}) as writer:
        to_do = [index for index in part.cases(keys) if index not in writer.done]
        for index, outcome in run_cases(function, cases, to_do, jobs):
            writer.append(index, outcome)
    print(f"part {part.number} of {part.of} is in {file}; OSTEOMILL_MERGE={folder} joins the parts")
    sys.exit(0)


def keys_of(cases: list[Any]) -> list[str]:
    """Texts that tell the cases from each other. ValueError for a case that is there twice."""
    keys = [json.dumps(case, sort_keys=True, default=_plain) for case in cases]
    if len(set(keys)) != len(keys):
        raise ValueError("a case is there twice: " + next(k for i, k in enumerate(keys) if k in keys[:i]))
    return keys


def run_cases(
    function: Callable[[Any], Any], cases: list[Any], indices: Iterable[int], jobs: int | None
) -> Generator[tuple[int, Any], None, None]:
    """Pairs of index and outcome, as they are done, begun in the order of `indices`, by `jobs` processes.

    An exception of the function ends the rest. ChildProcessError if a process ends by itself.
    """
    others = multiprocessing.active_children()
    with concurrent.futures.ProcessPoolExecutor(jobs or processors(), initializer=_begin_worker) as pool:
        workers: list[Any] = []
        try:
            futures = {pool.submit(_outcome, function, cases[index]): index for index in indices}
            workers = [child for child in multiprocessing.active_children() if child not in others]
            for future in concurrent.futures.as_completed(futures):
                yield futures[future], json.loads(future.result())
        except BrokenProcessPool:
            raise ChildProcessError("a process ended while it worked on a case: it was killed, or memory is short") from None
        except (KeyboardInterrupt, GeneratorExit):
            for worker in workers:
                worker.terminate()
            raise
        finally:
            pool.shutdown(cancel_futures=True)


def processors() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


def outcome_by_json(function: Callable[[Any], Any], case: Any) -> Any:
    """The outcome as a sweep in several processes gives it."""
    return json.loads(_outcome(function, case))


def _outcome(function: Callable[[Any], Any], case: Any) -> str:
    return json.dumps(function(case), default=_plain)


def _plain(value: Any) -> Any:
    """A value of numpy in a form that JSON has."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is nothing that JSON can say")


def _begin_worker() -> None:
    """A worker ends when its parent ends it, as after Ctrl-C, or is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(parent: int) -> None:
    multiprocessing.connection.wait([parent])
    os._exit(1)


def _joined(folder: pathlib.Path, header: Header, keys: list[str]) -> list[Any]:
    files = sorted(folder.glob("**/sweep-*-of-*.jsonl"))
    if not files:
        raise ValueError(f"{folder}: holds no sweep-*-of-*.jsonl")
    joined = JoinedParts(files)
    if joined.header != header:
        raise ValueError(f"{files[0]}: holds cases of another sweep: give another folder or remove it")
    return joined.outcomes(keys)


__all__ = ["Part", "keys_of", "outcome_by_json", "processors", "run_cases", "sweep"]
