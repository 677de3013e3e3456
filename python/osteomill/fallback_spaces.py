"""Spaces of an environment, as far as it needs them, in the form of gymnasium.spaces, in case that is not installed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray


class Space:
    """Base of Box and Dict: a generator of their own, which `seed` begins anew."""

    def __init__(self) -> None:
        self._np_random: np.random.Generator | None = None

    @property
    def np_random(self) -> np.random.Generator:
        """The generator with which `sample` draws."""
        if self._np_random is None:
            self._np_random = np.random.default_rng()
        return self._np_random

    def seed(self, seed: int | None = None) -> Any:
        """Begins the generator anew; returns the seed that would begin it so again."""
        sequence = np.random.SeedSequence(seed)
        self._np_random = np.random.default_rng(sequence)
        return sequence.entropy

    def contains(self, x: Any) -> bool:
        """Whether `x` is of this space."""
        raise NotImplementedError

    def __contains__(self, x: Any) -> bool:
        return self.contains(x)


class Box(Space):
    """Arrays within bounds."""

    def __init__(self, low: Any, high: Any, shape: Sequence[int] | None = None, dtype: Any = np.float32,
                 seed: int | None = None) -> None:
        super().__init__()
        self.dtype: np.dtype[Any] = np.dtype(dtype)
        low, high = np.asarray(low, self.dtype), np.asarray(high, self.dtype)
        self.shape = tuple(shape) if shape is not None else np.broadcast_shapes(low.shape, high.shape)
        self.low: NDArray[Any] = np.broadcast_to(low, self.shape).copy()
        self.high: NDArray[Any] = np.broadcast_to(high, self.shape).copy()
        if seed is not None:
            self.seed(seed)

    def contains(self, x: Any) -> bool:
        """Whether `x` is an array of this shape and kind of number, within the bounds."""
        x = np.asarray(x)
        return bool(np.can_cast(x.dtype, self.dtype, "same_kind") and x.shape == self.shape
                    and np.all((x >= self.low) & (x <= self.high)))

    def sample(self, rng: np.random.Generator | None = None) -> NDArray[Any]:
        """Drawn evenly between bounds; a value without bounds, from the normal distribution; with one, from the exponential."""
        rng = self.np_random if rng is None else rng
        low, high = self.low.astype(float), self.high.astype(float)
        if np.issubdtype(self.dtype, np.integer):
            return rng.integers(self.low, self.high, endpoint=True, dtype=self.dtype)
        has_low, has_high = np.isfinite(low), np.isfinite(high)
        drawn = rng.normal(size=self.shape)
        drawn = np.where(has_low & ~has_high, np.where(has_low, low, 0.0) + rng.exponential(size=self.shape), drawn)
        drawn = np.where(~has_low & has_high, np.where(has_high, high, 0.0) - rng.exponential(size=self.shape), drawn)
        within = has_low & has_high
        even = rng.uniform(np.where(within, low, 0.0), np.where(within, high, 1.0))
        return np.where(within, even, drawn).astype(self.dtype)

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, Box) and self.shape == other.shape and self.dtype == other.dtype
                and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

    def __repr__(self) -> str:
        return f"Box(shape={self.shape}, dtype={self.dtype})"


class Dict(Space, Mapping[str, Box]):
    """A space for each name."""

    def __init__(self, spaces: Mapping[str, Box], seed: int | None = None) -> None:
        super().__init__()
        self.spaces = dict(spaces)
        if seed is not None:
            self.seed(seed)

    def seed(self, seed: int | None = None) -> Any:
        """Begins the generator of each anew."""
        sequence = np.random.SeedSequence(seed)
        seeds = sequence.generate_state(len(self.spaces))
        return {name: space.seed(int(one)) for one, (name, space) in zip(seeds, self.spaces.items())}

    def contains(self, x: Any) -> bool:
        """Whether `x` is a dict of these names, each of its space."""
        return isinstance(x, Mapping) and x.keys() == self.spaces.keys() and all(
            space.contains(x[name]) for name, space in self.spaces.items())

    def sample(self, rng: np.random.Generator | None = None) -> dict[str, NDArray[Any]]:
        """One of each."""
        return {name: space.sample(rng) for name, space in self.spaces.items()}

    def __getitem__(self, name: str) -> Box:
        return self.spaces[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.spaces)

    def __len__(self) -> int:
        return len(self.spaces)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Dict) and self.spaces == other.spaces

    def __repr__(self) -> str:
        return f"Dict({self.spaces})"
