"""Latencies gathered from several runs, as counts by upper edge."""

import math
from collections.abc import Iterable
from typing import Any

BINS_PER_OCTAVE = 6

Counts = list[tuple[float, int]]


class Latencies:
    """`count` latencies were up to an edge in microseconds, and longer than the next smaller edge."""

    def __init__(self, counts: Iterable[tuple[float, int]] = ()) -> None:
        self._by_edge_us: dict[float, int] = {}
        self.add(counts)

    def add(self, counts: Iterable[tuple[float, int]]) -> None:
        for up_to_us, count in counts:
            if count:
                self._by_edge_us[float(up_to_us)] = self._by_edge_us.get(float(up_to_us), 0) + count

    def counts(self) -> Counts:
        return sorted(self._by_edge_us.items())

    def count(self) -> int:
        return sum(self._by_edge_us.values())

    def max_us(self) -> float:
        """0 if there are none."""
        return max(self._by_edge_us, default=0.0)

    def quantile_us(self, share: float) -> float:
        """The edge that a share (0 to 1) of them do not exceed; 0 if there are none."""
        wanted = math.ceil(min(max(share, 0.0), 1.0) * self.count())
        seen = 0
        for up_to_us, count in self.counts():
            seen += count
            if seen >= wanted:
                return up_to_us
        return self.max_us()

    def over(self, limit_us: float) -> int:
        """Number of latencies with edges above the limit."""
        return sum(count for up_to_us, count in self._by_edge_us.items() if up_to_us > limit_us)

    def summary(self) -> dict[str, Any]:
        shares = {"p50": 0.5, "p99": 0.99, "p999": 0.999, "p9999": 0.9999}
        return {"count": self.count(), **{name: self.quantile_us(share) for name, share in shares.items()},
                "max": self.max_us(), "over_1_ms": self.over(1000.0)}

    def bins(self) -> list[dict[str, float]]:
        """All bins of a sixth of an octave from the first to the last that is not empty: share, and share that is longer."""
        counts = self.counts()
        if not counts:
            return []
        all_of, first = self.count(), _bin_of(counts[0][0])
        edges = [2.0 ** (number / BINS_PER_OCTAVE) for number in range(first - 1, _bin_of(counts[-1][0]) + 1)]
        in_bins = [0] * (len(edges) - 1)
        for up_to_us, count in counts:
            in_bins[_bin_of(up_to_us) - first] += count
        rows = []
        seen = 0
        for from_us, up_to_us, count in zip(edges, edges[1:], in_bins):
            seen += count
            rows.append({"from_us": from_us, "up_to_us": up_to_us, "share": count / all_of, "share_above": (all_of - seen) / all_of})
        return rows


def _bin_of(us: float) -> int:
    return math.ceil(BINS_PER_OCTAVE * math.log2(max(us, 1e-3)) - 1e-9)


def of_server(histogram: Any) -> Latencies:
    """Latencies of a histogram that haptic_server --json writes beside its file."""
    return Latencies((float(up_to_us), int(count)) for up_to_us, count in histogram)


def of_cyclictest(report: Any) -> Latencies:
    """Latencies of cyclictest --json with one thread: whole microseconds, rounded down, so 12 lies below 13. Those beyond its
    histogram go to its maximum."""
    thread = report["thread"]["0"]
    latencies = Latencies((float(us) + 1.0, int(count)) for us, count in thread["histogram"].items())
    beyond = int(thread["cycles"]) - latencies.count()
    latencies.add([(float(thread["max"]) + 1.0, max(beyond, 0))])
    return latencies
