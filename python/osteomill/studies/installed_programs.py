"""Programs beside this package, and those that a machine may or may not have."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from types import TracebackType

from osteomill import _studies
from osteomill.studies.text import printable


def own_program(name: str) -> pathlib.Path:
    """A program of the same build or installation as this package. RuntimeError if it does not exist."""
    package = pathlib.Path(_studies.__file__).resolve().parent
    # BUILD/python/osteomill and BUILD/bin; PREFIX/lib/python3/dist-packages/osteomill and PREFIX/bin
    folders = [package.parents[1] / "bin", *(parent / "bin" for parent in package.parents[3:4])]
    for folder in folders:
        if (folder / name).is_file():
            return folder / name
    if found := shutil.which(name):
        return pathlib.Path(found)
    raise RuntimeError(f"{folders[0] / name}: is not there; build it, too")


class ChildProgram:
    """A running program, whose output on both streams can be read; it ends with the block.

    with ChildProgram([program, "--quiet"]) as child:
        child.wait(60.0, lambda: "ready" in child.output())
    """

    def __init__(self, command: Sequence[str | pathlib.Path], longest_end_s: float = 2.0) -> None:
        self._name = pathlib.Path(command[0]).name
        self._longest_end_s = longest_end_s
        self._said = tempfile.TemporaryFile()
        try:
            self._process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=self._said,
                                             stderr=subprocess.STDOUT)
        except OSError as error:
            raise RuntimeError(f"{command[0]}: cannot be run: {error.strerror}") from None

    def __enter__(self) -> "ChildProgram":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._process.terminate()
        try:
            self._process.wait(self._longest_end_s)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._said.close()

    def is_running(self) -> bool:
        return self._process.poll() is None

    def output(self) -> str:
        said = self._said.fileno()  # the program writes at its position, so that it must not be moved
        return os.pread(said, os.fstat(said).st_size, 0).decode("utf-8", "backslashreplace")

    def wait(self, longest_s: float, is_done: Callable[[], bool] = lambda: False) -> None:
        """Waits until `is_done` or the program's end, checked every 20 ms; at most for so long."""
        give_up = time.monotonic() + longest_s
        while time.monotonic() < give_up and not is_done() and self.is_running():
            time.sleep(0.02)

    def require_success(self) -> None:
        """RuntimeError with its last line of output, if it has not ended well."""
        if self._process.poll() != 0:
            said = [line for line in self.output().splitlines() if line.strip()]
            raise RuntimeError(f"{self._name} failed: {printable(said[-1]) if said else 'it says nothing'}")
