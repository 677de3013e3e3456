"""An environment for learning to mill, in the form of Gymnasium's API and without depending on it."""

from __future__ import annotations

from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from osteomill._core import Case, Session, Step

Observation = dict[str, NDArray[Any]]
Reward = Callable[[Step, Step], float]


class Box:
    """Arrays within bounds: what `gymnasium.spaces.Box` is, as far as it is needed."""

    def __init__(self, low: Any, high: Any, shape: Sequence[int], dtype: Any) -> None:
        self.shape = tuple(shape)
        self.dtype = np.dtype(dtype)
        self.low = np.broadcast_to(np.asarray(low, self.dtype), self.shape)
        self.high = np.broadcast_to(np.asarray(high, self.dtype), self.shape)

    def contains(self, x: Any) -> bool:
        """Whether `x` is an array of this shape, within the bounds."""
        x = np.asarray(x)
        return x.shape == self.shape and bool(np.all((x >= self.low) & (x <= self.high)))

    def sample(self, rng: np.random.Generator) -> NDArray[Any]:
        """Drawn evenly between bounds that are finite."""
        return rng.uniform(self.low, self.high).astype(self.dtype)

    def __repr__(self) -> str:
        return f"Box(shape={self.shape}, dtype={self.dtype})"


def removed_mm3(before: Step, after: Step) -> float:
    """The reward where none is given: bone that was removed, mm^3."""
    return after.removed_mm3["total"] - before.removed_mm3["total"]


class Env:
    """Milling as a task for an agent: `reset` and `step` as Gymnasium has them.

    An action is an array (4,): the hand's velocity, mm/s in patient LPS, of at most `fastest_mm_per_s` along each axis, and
    the pedal, down above 0.5. The hand moves so for 1 / `control_hz` s, a tick a millisecond; the spindle keeps its direction.

    `observation` names what is seen, as a dict of arrays: "pose" (6,): the burr's centre (mm, LPS) and the spindle's axis;
    "hand" (3,); "force" (3,), N; "removed" (tissues + 1,), mm^3, the total first; "distance" (structures,), mm to the protected
    ones, inf beyond reach; "cropN" (N, N, N): uint8, what is left of the N^3 voxels about the burr.

    `reward(before, after)` and `is_done(before, after)` get what was known before and after an action, as Steps. An episode is truncated after
    `duration_s`. Of the same seed it is the same to the bit: the only thing that is drawn is where the tool starts, within
    `start_jitter_mm` of the case's start along each axis, by a generator of the environment's own. Other arguments
    are those of Session.
    """

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode = None

    def __init__(
        self,
        case: Case,
        *,
        control_hz: float = 50.0,
        observation: Sequence[str] = ("pose", "force"),
        reward: Reward = removed_mm3,
        is_done: Callable[[Step, Step], bool] = lambda before, after: False,
        duration_s: float = 10.0,
        fastest_mm_per_s: float = 20.0,
        start_jitter_mm: float = 0.0,
        **session: Any,
    ) -> None:
        self._ms = round(1000.0 / control_hz)
        if not 1 <= self._ms <= 1000 or abs(self._ms * control_hz - 1000.0) > 1e-6:
            raise ValueError(f"control_hz: an action lasts whole milliseconds up to a second, not {1000.0 / control_hz:g} ms")
        if not 0.0 < fastest_mm_per_s <= 2000.0:
            raise ValueError(f"fastest_mm_per_s: a hand moves at up to 2000 mm/s, not {fastest_mm_per_s:g}")
        self.case = case
        self._reward, self._is_done = reward, is_done
        self._duration_s, self._start_jitter_mm = duration_s, start_jitter_mm
        self._start_mm = np.asarray(session.pop("start_mm", case.start_mm), float)
        self._session_arguments = session
        self._rng = np.random.default_rng()
        self.session: Session | None = None
        fastest = np.full(3, fastest_mm_per_s)
        self.action_space = Box(np.append(-fastest, 0.0), np.append(fastest, 1.0), (4,), np.float64)
        self.observation_space = {name: self._space(name) for name in observation}

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode; returns what is seen, and {"step": Step}. Without a seed the generator goes on."""
        if seed is not None:
            self._rng = np.random.default_rng(seed)
        start_mm = self._start_mm + self._rng.uniform(-1.0, 1.0, 3) * self._start_jitter_mm
        self.close()
        self.session = Session(self.case, start_mm=start_mm, **self._session_arguments)
        self._hand_mm = start_mm
        step = self.session.now
        return self._observe(step), {"step": step}

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Takes an action, clipped to `action_space`; returns observation, reward, terminated, truncated, info.

        info: "step", what the last tick knew, and "ticks", the arrays of all of them as Session.rollout returns them.
        """
        if self.session is None:
            raise RuntimeError("call reset() before step()")
        action = np.clip(np.asarray(action, float), self.action_space.low, self.action_space.high)
        before = self.session.now
        way_mm = np.arange(1, self._ms + 1)[:, None] * 1e-3 * action[:3]
        ticks = self.session.rollout(self._hand_mm + way_mm, pedals=bool(action[3] > 0.5))
        self._hand_mm = self._hand_mm + way_mm[-1]
        after = self.session.now
        info = {"step": after, "ticks": ticks}
        truncated = after.time_s >= self._duration_s - 1e-9
        return self._observe(after), float(self._reward(before, after)), bool(self._is_done(before, after)), truncated, info

    def close(self) -> None:
        """Ends the episode's session."""
        if self.session is not None:
            self.session.close()
            self.session = None

    def _space(self, name: str) -> Box:
        if name == "pose":
            return Box(-np.inf, np.inf, (6,), np.float64)
        if name in ("hand", "force"):
            return Box(-np.inf, np.inf, (3,), np.float64)
        if name == "removed":
            return Box(0.0, np.inf, (len(self.case.removal_names),), np.float64)
        if name == "distance":
            return Box(-np.inf, np.inf, (len(self.case.structures),), np.float64)
        if name.startswith("crop") and name[4:].isdecimal() and 1 <= int(name[4:]) <= 256:
            return Box(0, 255, (int(name[4:]),) * 3, np.uint8)
        raise ValueError(f'observation: "{name}" is none of pose, hand, force, removed, distance, cropN (N from 1 to 256)')

    def _observe(self, step: Step) -> Observation:
        return {name: self._observed(name, step) for name in self.observation_space}

    def _observed(self, name: str, step: Step) -> NDArray[Any]:
        if name == "pose":
            return np.concatenate([step.burr_mm, step.axis])
        if name == "hand":
            return step.hand_mm
        if name == "force":
            return step.force_n
        if name == "removed":
            return np.array(list(step.removed_mm3.values()))
        if name == "distance":
            return np.array(list(step.distance_mm.values()))
        assert self.session is not None
        bone, edge = self.session.bone, int(name[4:])
        middle = np.rint((step.burr_mm - bone.origin_mm) / bone.spacing_mm).astype(int)
        first = middle - edge // 2
        return bone.fraction((first.tolist(), (first + edge).tolist()))
