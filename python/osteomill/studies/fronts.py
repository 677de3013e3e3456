"""The front of the best among choices that cost and err."""

from collections.abc import Iterable


def on_front(cost: Iterable[float], error: Iterable[float]) -> list[bool]:
    """Whether each is on the front: no other is at most as costly and as wrong, and less so in one of
    both."""
    points = list(zip(cost, error))
    return [not any(c <= cost_of and e <= error_of and (c, e) != (cost_of, error_of) for c, e in points)
            for cost_of, error_of in points]
