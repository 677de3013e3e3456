"""An environment for learning to mill: one of Gymnasium's where that is installed, and of the same form where it is not."""

from __future__ import annotations

import copy
import importlib.util
import math
import warnings
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from osteomill._core import BadInput, Case, Fault, Session, Step

HAS_GYMNASIUM = importlib.util.find_spec("gymnasium") is not None
if TYPE_CHECKING or not HAS_GYMNASIUM:
    from osteomill import spaces

    _Base = object
else:
    import gymnasium
    from gymnasium import spaces

    _Base = gymnasium.Env
    gymnasium.register(id="osteomill/Mill-v0", entry_point="osteomill.env:Env", kwargs={"case": "tooth", "actions": "normalised"})

Observation = dict[str, NDArray[Any]]
Reward = Callable[[Step, Step], float]
Actions = Literal["raw", "normalised"]

FARTHEST_MM = 10_000.0
STRONGEST_N = 1_000.0


def removed_mm3(before: Step, after: Step) -> float:
    """The reward where none is given: bone that was removed, mm^3."""
    return after.removed_mm3["total"] - before.removed_mm3["total"]


def never(before: Step, after: Step) -> bool:
    """The end where none is given: there is none but the episode's duration."""
    return False


class Env(_Base):
    """Milling as a task for an agent: `reset` and `step` as Gymnasium has them.

    case: a Case, or what one is made of ("tooth"). An action is an array (4,): the hand's velocity, mm/s in patient LPS, of at most
    `fastest_mm_per_s` along each axis, and the pedal, down above 0.5; with actions="normalised" all are from -1 to 1, the velocity as a
    share of the fastest, the pedal down above 0. The hand moves so for 1 / `control_hz` s, a tick a millisecond; the spindle keeps its
    direction. What is beyond the bounds is clipped; what is no such array, or no number, is refused.

    `observation` names what is seen, as a dict of arrays: "pose" (6,): the burr's centre (mm, LPS) and the spindle's axis;
    "hand" (3,); "force" (3,), N; "removed" (tissues + 1,), mm^3, the total first; "distance" (structures,), mm to the protected
    ones, inf beyond reach; "cropN" (N, N, N): uint8, what is left of the N^3 voxels about the burr.

    `reward(before, after)` and `is_done(before, after)` get what was known before and after an action, as Steps. An episode is truncated after
    `duration_s`. Of the same seed it is the same to the bit: the only thing that is drawn is where the tool starts, within
    `start_jitter_mm` of the case's start along each axis, by a generator of the environment's own. Other arguments
    are those of Session. An environment can be pickled, as it is before reset, if its functions can.

    With gymnasium installed it is a gymnasium.Env, and gymnasium.make("osteomill/Mill-v0") makes one of the tooth with normalised actions.
    """

    metadata: dict[str, Any] = {"render_modes": [], "render_fps": 50}
    render_mode: str | None = None
    spec: Any = None

    def __init__(
        self,
        case: Case | str = "tooth",
        *,
        control_hz: float = 50.0,
        observation: Sequence[str] = ("pose", "force"),
        actions: Actions = "raw",
        reward: Reward = removed_mm3,
        is_done: Callable[[Step, Step], bool] = never,
        duration_s: float = 10.0,
        fastest_mm_per_s: float = 20.0,
        start_jitter_mm: float = 0.0,
        render_mode: None = None,
        **session: Any,
    ) -> None:
        if not control_hz > 0.0 or not math.isfinite(control_hz):
            raise BadInput(f"control_hz: takes actions a second, 1 to 1000, not {control_hz:g}")
        self._ms = round(1000.0 / control_hz)
        if not 1 <= self._ms <= 1000 or abs(self._ms * control_hz - 1000.0) > 1e-6:
            raise BadInput(f"control_hz: an action lasts whole milliseconds up to a second, not {1000.0 / control_hz:g} ms")
        if not 0.0 < fastest_mm_per_s <= 2000.0:
            raise BadInput(f"fastest_mm_per_s: a hand moves at up to 2000 mm/s, not {fastest_mm_per_s:g}")
        if actions not in ("raw", "normalised"):
            raise BadInput(f'actions: takes "raw" or "normalised", not {actions!r}')
        if render_mode is not None:
            raise BadInput(f"render_mode: takes None, not {render_mode!r}; osteomill.render draws a session or its recording")
        self.case = Case(case) if isinstance(case, str) else case
        self._actions = actions
        self._reward, self._is_done = reward, is_done
        self._duration_s, self._start_jitter_mm = duration_s, start_jitter_mm
        session = dict(session)
        self._start_mm = np.asarray(session.pop("start_mm", self.case.start_mm), float)
        self._session_arguments = session
        self._np_random: np.random.Generator | None = None
        self._np_random_seed: int | None = None
        self._is_over = False
        self.session: Session | None = None
        self._fastest = np.append(np.full(3, fastest_mm_per_s), 1.0)
        if actions == "raw":
            self.action_space = spaces.Box(np.append(-self._fastest[:3], 0.0), self._fastest, (4,), np.float64)
        else:
            self.action_space = spaces.Box(-1.0, 1.0, (4,), np.float32)
        self.observation_space = spaces.Dict({name: self._space(name) for name in observation})

    @property
    def unwrapped(self) -> Env:
        """Itself: it wraps nothing."""
        return self

    @property
    def np_random(self) -> np.random.Generator:
        """The generator that episodes are drawn from."""
        if self._np_random is None:
            self._begin_generator(None)
        assert self._np_random is not None
        return self._np_random

    @np_random.setter
    def np_random(self, generator: np.random.Generator) -> None:
        self._np_random, self._np_random_seed = generator, -1  # as Gymnasium says that it is not known

    @property
    def np_random_seed(self) -> int:
        """What the generator began with; -1 where that is not known."""
        if self._np_random_seed is None:
            self._begin_generator(None)
        assert self._np_random_seed is not None
        return self._np_random_seed

    def _begin_generator(self, seed: int | None) -> None:
        if seed is not None and (isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or seed < 0):
            raise BadInput(f"seed: takes a whole number from 0 on, or None, not {seed!r}")
        sequence = np.random.SeedSequence(None if seed is None else int(seed))
        self._np_random, self._np_random_seed = np.random.default_rng(sequence), _entropy_of(sequence)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode; returns what is seen, and info as step does. Without a seed the generator goes on.

        options: none are known, and BadInput says so.
        """
        if options:
            raise BadInput(f"options: an episode takes none, not {', '.join(map(str, options))}")
        if seed is not None:
            self._begin_generator(seed)
        start_mm = self._start_mm + self.np_random.uniform(-1.0, 1.0, 3) * self._start_jitter_mm
        self.close()
        self.session = Session(self.case, start_mm=start_mm, **self._session_arguments)
        self._hand_mm = start_mm
        self._is_over = False
        step = self.session.now
        return self._observe(step), self._info(step)

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Takes an action, clipped to `action_space`; returns observation, reward, terminated, truncated, info.

        info: plain numbers of the last tick, "time_s", "removed_mm3" (the total), "force_n" (its magnitude), "spindle_on", "fault";
        "step", all that it knew, and "ticks", the arrays of all ticks as Session.rollout returns them.
        """
        if self.session is None:
            raise Fault("call reset() before step()")
        if self._is_over:
            warnings.warn("the episode is over: call reset() before the next step()", UserWarning, stacklevel=2)
        velocity_mm_per_s, pedal = self._meant(action)
        before = self.session.now
        way_mm = np.arange(1, self._ms + 1)[:, None] * 1e-3 * velocity_mm_per_s
        ticks = self.session.rollout(self._hand_mm + way_mm, pedals=pedal)
        self._hand_mm = self._hand_mm + way_mm[-1]
        after = self.session.now
        terminated = bool(self._is_done(before, after))
        truncated = bool(after.time_s >= self._duration_s - 1e-9)
        self._is_over = terminated or truncated
        return self._observe(after), float(self._reward(before, after)), terminated, truncated, self._info(after) | {"ticks": ticks}

    def render(self) -> None:
        """Nothing: render_mode is None. osteomill.render(env.session) draws it."""

    def close(self) -> None:
        """Ends the episode's session."""
        if self.session is not None:
            self.session.close()
            self.session = None

    def __enter__(self) -> Env:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_hand_mm"} | {"session": None, "_is_over": False}

    def __deepcopy__(self, memo: dict[int, Any]) -> Env:
        other = self.__class__.__new__(self.__class__)
        other.__dict__.update({name: value if name == "case" else copy.deepcopy(value, memo)
                               for name, value in self.__getstate__().items()})
        return other

    def __repr__(self) -> str:
        return f"<Env of {self.case!r}: {', '.join(self.observation_space)}; {1000 / self._ms:g} actions a second>"

    def _meant(self, action: Any) -> tuple[NDArray[np.float64], bool]:
        try:
            numbers = np.asarray(action, float)
        except (TypeError, ValueError):
            raise BadInput(f"action: takes an array (4,) of numbers, not {_short(action)}") from None
        if numbers.shape != (4,) or not np.isfinite(numbers).all():
            raise BadInput(f"action: takes an array (4,) of finite numbers, velocity and pedal, not {_short(action)}")
        numbers = np.clip(numbers, self.action_space.low, self.action_space.high)
        if self._actions == "raw":
            return numbers[:3], bool(numbers[3] > 0.5)
        return numbers[:3] * self._fastest[:3], bool(numbers[3] > 0.0)

    @staticmethod
    def _info(step: Step) -> dict[str, Any]:
        return {"time_s": step.time_s, "removed_mm3": step.removed_mm3["total"], "force_n": float(np.linalg.norm(step.force_n)),
                "spindle_on": step.spindle_on, "fault": step.fault, "step": step}

    def _space(self, name: str) -> Any:
        if name == "pose":
            return spaces.Box(np.repeat([-FARTHEST_MM, -1.0], 3), np.repeat([FARTHEST_MM, 1.0], 3), (6,), np.float64)
        if name == "hand":
            return spaces.Box(-FARTHEST_MM, FARTHEST_MM, (3,), np.float64)
        if name == "force":
            return spaces.Box(-STRONGEST_N, STRONGEST_N, (3,), np.float64)
        if name == "removed":
            most_mm3 = self.case.bone.volume_mm3 + 1.0
            return spaces.Box(-1.0, most_mm3, (len(self.case.removal_names),), np.float64)
        if name == "distance":
            return spaces.Box(-np.inf, np.inf, (len(self.case.structures),), np.float64)
        if name.startswith("crop") and name[4:].isdecimal() and 1 <= int(name[4:]) <= 256:
            return spaces.Box(0, 255, (int(name[4:]),) * 3, np.uint8)
        raise BadInput(f'observation: "{name}" is none of pose, hand, force, removed, distance, cropN (N from 1 to 256)')

    def _observe(self, step: Step) -> Observation:
        return {name: self._observed(name, step) for name in self.observation_space}

    def _observed(self, name: str, step: Step) -> NDArray[Any]:
        if name == "pose":
            return np.concatenate([step.burr_mm, np.clip(step.axis, -1.0, 1.0)])
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


def _entropy_of(sequence: np.random.SeedSequence) -> int:
    entropy = sequence.entropy
    return entropy if isinstance(entropy, int) else -1


def _short(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."
