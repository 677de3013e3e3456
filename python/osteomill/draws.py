"""Random draws for an episode, besides the tool's start: within ranges that the user names."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from osteomill._core import BadInput, Case

Ranges = Mapping[str, Sequence[float]]

# Quantities that are no keys of a scene, and the most that each may be.
_OF_EPISODE = {"registration_mm": 50.0, "delay_ms": 1000.0, "force_noise_n": 100.0, "pose_noise_mm": 50.0}


@dataclass(frozen=True)
class Drawn:
    """The draws of an episode: its case, and the errors of observation and action."""

    case: Case
    values: dict[str, float] = field(default_factory=dict)
    """By the names of the ranges."""
    registration_mm: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    """From where the tool is to where it is shown."""
    delay_ms: int = 0
    force_noise_n: float = 0.0
    pose_noise_mm: float = 0.0


class Draws:
    """Draws one of these cases, and a value of each range, all evenly."""

    def __init__(self, cases: Sequence[Case], ranges: Ranges | None) -> None:
        self.cases = list(cases)
        if not self.cases:
            raise BadInput("case: takes a Case, its name, or several Cases; there is none")
        self.ranges = {name: _checked(name, bounds) for name, bounds in (ranges or {}).items()}
        self._keys = [name for name in self.ranges if name not in _OF_EPISODE]
        if self._keys:
            try:
                self.cases[0].with_(set=[f"{key}={self.ranges[key][0]!r}" for key in self._keys])
            except ValueError as error:
                raise BadInput(f"ranges: takes {', '.join(_OF_EPISODE)} and keys of a scene; {error}") from None

    def draw(self, generator: np.random.Generator) -> Drawn:
        """The draws of the next episode."""
        if len(self.cases) == 1 and not self.ranges:
            return Drawn(self.cases[0])
        case = self.cases[int(generator.integers(len(self.cases)))]
        values = {name: float(generator.uniform(low, high)) for name, (low, high) in self.ranges.items()}
        if "delay_ms" in values:
            low, high = self.ranges["delay_ms"]
            values["delay_ms"] = float(generator.integers(math.ceil(low), math.floor(high), endpoint=True))
        direction = generator.normal(size=3)
        if self._keys:
            case = case.with_(set=[f"{key}={values[key]!r}" for key in self._keys])
        return Drawn(case, values, values.get("registration_mm", 0.0) * direction / np.linalg.norm(direction), int(values.get("delay_ms", 0)),
                     values.get("force_noise_n", 0.0), values.get("pose_noise_mm", 0.0))


def _checked(name: str, bounds: Any) -> tuple[float, float]:
    try:
        low, high = (float(bound) for bound in bounds)
    except (TypeError, ValueError):
        raise BadInput(f"ranges: {name}: takes the least and the most, two numbers, not {bounds!r}") from None
    if not (math.isfinite(low) and math.isfinite(high) and low <= high):
        raise BadInput(f"ranges: {name}: takes two finite numbers, the least first, not {low:g} and {high:g}")
    if name in _OF_EPISODE and not 0.0 <= low <= high <= _OF_EPISODE[name]:
        raise BadInput(f"ranges: {name}: lies within 0 to {_OF_EPISODE[name]:g}, not {low:g} to {high:g}")
    if name == "delay_ms" and math.ceil(low) > math.floor(high):
        raise BadInput(f"ranges: delay_ms: is in whole milliseconds, and there is none from {low:g} to {high:g}")
    return low, high
