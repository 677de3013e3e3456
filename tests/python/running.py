"""A program that runs while a test goes on, and what a running server logs."""

import os
import re
import signal
import subprocess
import tempfile

from support import LONGEST_S, eventually, program


class Running:
    """Started with the object, killed when its block is left. Its streams are files: it never waits for a reader."""

    def __init__(self, name, *words):
        self._streams = [tempfile.TemporaryFile() for _ in range(2)]
        self.process = subprocess.Popen([program(name), *words], stdin=subprocess.DEVNULL,
                                        stdout=self._streams[0], stderr=self._streams[1])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        for stream in self._streams:
            stream.close()

    def _text(self, stream):
        return os.pread(stream.fileno(), os.fstat(stream.fileno()).st_size, 0).decode(errors="replace")

    @property
    def out(self):
        return self._text(self._streams[0])

    @property
    def err(self):
        return self._text(self._streams[1])

    def line_after(self, prefix):
        """The rest of its first line of output that begins so; None if it ends without one."""
        lines = []

        def has_come():
            has_ended = self.process.poll() is not None
            lines.extend(re.findall(rf"^{re.escape(prefix)}(.*)\n", self.out, re.MULTILINE))
            return lines or has_ended
        eventually(has_come)
        return lines[0] if lines else None

    def address(self):
        """HOST:PORT at which a server listens, as it says it; None if it ends without."""
        return self.line_after("listening on ")

    def has_logged(self, words, times=1):
        """True as soon as its messages hold the words so often; false after a time that only a defect can take."""
        return eventually(lambda: self.err.count(words) >= times)

    def wait(self):
        """Its exit status; minus the number of a signal that ended it."""
        return self.process.wait(LONGEST_S)

    def end(self, number=signal.SIGTERM):
        """Its exit status after a signal."""
        self.process.send_signal(number)
        return self.wait()


def removed_mm3(force_log):
    """The newest figure in a force log that is being written; 0 before the first."""
    try:
        rows = [line.split(",") for line in force_log.read_text().splitlines()[1:]]
    except FileNotFoundError:
        return 0.0
    return next((float(row[11]) for row in reversed(rows) if len(row) >= 14), 0.0)
