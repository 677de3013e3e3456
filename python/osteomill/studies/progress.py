"""Progress of a long piece of work: a line that is drawn again on a terminal, else a line every 10 %."""

import math
import time
from collections.abc import Callable
from typing import TextIO

BAR_COLUMNS = 40
PERCENT_BETWEEN_LINES = 10
ESTIMATED_AFTER_S = 2.0


def time_left(left_s: float) -> str:
    """"40 s left", "3 min left", "2 h 5 min left"; "" if nothing is left."""
    seconds = math.ceil(left_s)
    if seconds <= 0:
        return ""
    if seconds < 100:
        return f"{seconds} s left"
    minutes = -(-seconds // 60)
    return f"{minutes} min left" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min left"


class ProgressLine:
    """Prints the percentage done and, after two seconds, the time left: by the pace since the first report."""

    def __init__(self, out: TextIO, title: str, now_s: Callable[[], float] = time.monotonic) -> None:
        self._out = out
        self._is_terminal = out.isatty()
        self._title = title
        self._now_s = now_s
        self._begin: tuple[float, float] | None = None
        self._shown = (-1, "")

    def report(self, done: float) -> None:
        """Reports a share, 0 to 1, ascending."""
        if self._begin is None:
            self._begin = done, self._now_s()
        percent = int(100.0 * done + 1e-9)
        if not self._is_terminal:
            percent -= percent % PERCENT_BETWEEN_LINES
        before, left_before = self._shown
        if percent < before or (not self._is_terminal and percent == before):
            return
        left = self._left_at(done)
        if (percent, left) == self._shown:
            return
        self._shown = percent, left
        behind = f", {left}" if left else ""
        if self._is_terminal:
            bar = "#" * (percent * BAR_COLUMNS // 100)
            columns_to_clear = len(left_before) + 2 if left_before else 0
            self._say(f"\r{self._title:<10} [{bar:<{BAR_COLUMNS}}] {percent:3} %{behind:<{columns_to_clear}}")
        elif percent > 0:
            self._say(f"{self._title} {percent} %{behind}\n")

    def end(self) -> None:
        if self._is_terminal and self._shown[0] >= 0:
            self._say("\n")

    def _left_at(self, done: float) -> str:
        assert self._begin is not None
        elapsed_s = self._now_s() - self._begin[1]
        if elapsed_s < ESTIMATED_AFTER_S or done <= self._begin[0]:
            return ""
        return time_left(elapsed_s * (1.0 - done) / (done - self._begin[0]))

    def _say(self, text: str) -> None:
        self._out.write(text)
        self._out.flush()
