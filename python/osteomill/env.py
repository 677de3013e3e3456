"""An environment for learning to mill: one of Gymnasium's if that is installed, else one of the same form."""

from __future__ import annotations

import copy
import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from osteomill._core import BadInput, Case, Fault, Session, Step
from osteomill.draws import Drawn, Draws, Ranges
from osteomill.gymnasium_spaces import HAS_GYMNASIUM, spaces
from osteomill.observations import Observation, Observer

if TYPE_CHECKING or not HAS_GYMNASIUM:
    _Base = object
else:
    import gymnasium

    _Base = gymnasium.Env
    gymnasium.register(id="osteomill/Mill-v0", entry_point="osteomill.env:Env", kwargs={"case": "tooth", "actions": "normalised"})

Reward = Callable[[Step, Step], float]
Actions = Literal["raw", "normalised"]
Ends = Literal["fault", "protected"]


def removed_mm3(before: Step, after: Step) -> float:
    """The default reward: bone that was removed, mm^3."""
    return after.removed_mm3["total"] - before.removed_mm3["total"]


def never(before: Step, after: Step) -> bool:
    """The default end: only the episode's duration."""
    return False


class Way(NamedTuple):
    """Path of the hand during an action, a row for each millisecond."""

    hands_mm: NDArray[np.float64]
    axes: NDArray[np.float64] | None
    """None: the spindle keeps its direction."""
    pedals: NDArray[np.bool_]


class Env(_Base):
    """Milling as a task for an agent: `reset` and `step` as Gymnasium has them.

    case: a Case, what one is made of ("tooth"), or several, of which each episode draws one. An action is an array (4,): the hand's
    velocity, mm/s in patient LPS, of at most `fastest_mm_per_s` along each axis, and the pedal, down above 0.5; with
    actions="normalised" all are from -1 to 1, the velocity as a share of the fastest, the pedal down above 0. The hand moves so for
    1 / `control_hz` s, a tick a millisecond. The spindle keeps its direction; with `fastest_rad_per_s` above 0 it is tilted: the action
    is (7,), with the rate at which the spindle turns about the patient's axes, rad/s, before the pedal. Values beyond the bounds
    are clipped; anything but such an array of numbers is refused.

    `observation` names the quantities seen, as a dict of arrays: "pose" (6,): the burr's centre (mm, LPS) and the spindle's axis;
    "hand" (3,); "force" (3,), N; "torque" (3,), of bone on the shank, N mm; "spindle" (2,): the cut's torque on it, N mm, and
    power, W; "removed" (tissues + 1,), mm^3, the total first; "distance" (structures,), mm to the protected ones, inf beyond
    reach; "plan" (1,): mm from the burr's centre to the region that the case plans to remove, below 0 within; "cropN" (N, N, N):
    uint8, the fractions left of the N^3 voxels about the burr; "rgb" (height, width, 3), "depth" (height, width), mm, and
    "labels" (height, width): the picture of `camera`, a mapping as osteomill.render takes, at `picture_px`, width and height;
    None: the first view.

    `reward(before, after)` and `is_done(before, after)` get the state before and after an action, as Steps. Events named in
    `ends` also end an episode: a "fault", or a "protected" tissue that is cut. It is truncated after `duration_s`.

    The same seed gives the same episodes, to the bit. A generator of the environment's own draws the tool's start, within
    `start_jitter_mm` of the case's start along each axis, and the quantities in `ranges`, each evenly from its least to its most:
    "registration_mm", the error of a navigation, in any direction; "delay_ms", after which an action acts; "force_noise_n" and
    "pose_noise_mm", standard deviations of observations; or any key of a scene, as Case takes them: "force_scale", a factor of
    the cutting force, "wall_friction", "tissues.enamel.relative_stiffness". Keys that change the bone load it anew, which takes a
    second. `drawn` has the drawn values. "pose", "hand" and "plan" are as the navigation shows them; all else is without error.

    Other arguments are those of Session. An environment can be pickled in its state before reset, if its functions can.

    With gymnasium installed it is a gymnasium.Env, and gymnasium.make("osteomill/Mill-v0") makes one of the tooth with normalised actions.
    """

    metadata: dict[str, Any] = {"render_modes": [], "render_fps": 50}
    render_mode: str | None = None
    spec: Any = None

    def __init__(
        self,
        case: Case | str | Sequence[Case] = "tooth",
        *,
        control_hz: float = 50.0,
        observation: Sequence[str] = ("pose", "force"),
        actions: Actions = "raw",
        reward: Reward = removed_mm3,
        is_done: Callable[[Step, Step], bool] = never,
        ends: Sequence[Ends] = (),
        duration_s: float = 10.0,
        fastest_mm_per_s: float = 20.0,
        fastest_rad_per_s: float = 0.0,
        start_jitter_mm: float = 0.0,
        ranges: Ranges | None = None,
        camera: Mapping[str, Any] | None = None,
        picture_px: Sequence[int] = (84, 84),
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
        if not 0.0 <= fastest_rad_per_s <= 20.0:
            raise BadInput(f"fastest_rad_per_s: a hand turns at up to 20 rad/s, not {fastest_rad_per_s:g}")
        if actions not in ("raw", "normalised"):
            raise BadInput(f'actions: takes "raw" or "normalised", not {actions!r}')
        if render_mode is not None:
            raise BadInput(f"render_mode: takes None, not {render_mode!r}; osteomill.render draws a session or its recording")
        for end in ends:
            if end not in ("fault", "protected"):
                raise BadInput(f'ends: takes "fault" and "protected", not {end!r}')
        cases = [Case(case)] if isinstance(case, str) else [case] if isinstance(case, Case) else list(case)
        self._draws = Draws(cases, ranges)
        self.case = cases[0]
        self._actions, self._ends = actions, tuple(ends)
        self._reward, self._is_done = reward, is_done
        self._duration_s, self._start_jitter_mm = duration_s, start_jitter_mm
        session = dict(session)
        self._start_mm = session.pop("start_mm", None)
        self._session_arguments = session
        self._np_random: np.random.Generator | None = None
        self._np_random_seed: int | None = None
        self._is_over = False
        self.session: Session | None = None
        self._drawn = Drawn(self.case)
        rates = [fastest_mm_per_s] * 3 + [fastest_rad_per_s] * 3 * (fastest_rad_per_s > 0.0)
        self._fastest = np.array([*rates, 1.0])
        if actions == "raw":
            self.action_space = spaces.Box(np.append(-self._fastest[:-1], 0.0), self._fastest, self._fastest.shape, np.float64)
        else:
            self.action_space = spaces.Box(-1.0, 1.0, self._fastest.shape, np.float32)
        self._observer = Observer(self.case, observation, camera, picture_px)
        self.observation_space = self._observer.space

    @property
    def unwrapped(self) -> Env:
        """The environment itself: it wraps nothing."""
        return self

    @property
    def np_random(self) -> np.random.Generator:
        """The generator that draws episodes."""
        if self._np_random is None:
            self._begin_generator(None)
        assert self._np_random is not None
        return self._np_random

    @np_random.setter
    def np_random(self, generator: np.random.Generator) -> None:
        self._np_random, self._np_random_seed = generator, -1  # as Gymnasium says that it is not known

    @property
    def np_random_seed(self) -> int:
        """The generator's seed; -1 if it is not known."""
        if self._np_random_seed is None:
            self._begin_generator(None)
        assert self._np_random_seed is not None
        return self._np_random_seed

    def _begin_generator(self, seed: int | None) -> None:
        if seed is not None and (isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or seed < 0):
            raise BadInput(f"seed: takes a whole number from 0 on, or None, not {seed!r}")
        sequence = np.random.SeedSequence(None if seed is None else int(seed))
        self._np_random, self._np_random_seed = np.random.default_rng(sequence), _entropy_of(sequence)

    @property
    def drawn(self) -> dict[str, float]:
        """The values drawn for this episode, by the names of `ranges`."""
        return dict(self._drawn.values)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode; returns the observation, and info as step does. Without a seed the generator goes on.

        options: none are known, and BadInput says so.
        """
        if options:
            raise BadInput(f"options: an episode takes none, not {', '.join(map(str, options))}")
        if seed is not None:
            self._begin_generator(seed)
        jitter_mm = self.np_random.uniform(-1.0, 1.0, 3) * self._start_jitter_mm
        self._drawn = self._draws.draw(self.np_random)
        self.case = self._drawn.case
        start_mm = np.asarray(self.case.start_mm if self._start_mm is None else self._start_mm, float) + jitter_mm
        self.close()
        self.session = Session(self.case, start_mm=start_mm, **self._session_arguments)
        self._is_over = False
        self._now = self.session.now
        self._hand_mm, self._axis = start_mm, self._now.axis
        late = self._drawn.delay_ms
        self._late = Way(np.tile(start_mm, (late, 1)), np.tile(self._axis, (late, 1)), np.zeros(late, bool))
        return self._observe(self._now), self._info(self._now)

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Takes an action, clipped to `action_space`; returns observation, reward, terminated, truncated, info.

        info: plain numbers of the last tick, "time_s", "removed_mm3" (the total), "force_n" (its magnitude), "spindle_on", "fault";
        "step", all its values, and "ticks", the arrays of all ticks as Session.rollout returns them.
        """
        if self.session is None:
            raise Fault("call reset() before step()")
        if self._is_over:
            warnings.warn("the episode is over: call reset() before the next step()", UserWarning, stacklevel=2)
        way = self._way(action)
        ticks = self.session.rollout(way.hands_mm, way.axes, way.pedals)
        observation, reward, terminated, truncated, info = self._arrived(self.session.now)
        return observation, reward, terminated, truncated, info | {"ticks": ticks}

    def _way(self, action: Any) -> Way:
        """Path of the hand in this action's time; with a delay, that of an earlier action."""
        velocity_mm_per_s, rate_rad_per_s, pedal = self._meant(action)
        passed_s: NDArray[np.float64] = 1e-3 * np.arange(1, self._ms + 1, dtype=np.float64)[:, None]
        hands_mm = self._hand_mm + passed_s * velocity_mm_per_s
        axes = _turned(self._axis, rate_rad_per_s, passed_s) if rate_rad_per_s.size else None
        self._hand_mm = hands_mm[-1]
        if axes is not None:
            self._axis = axes[-1]
        way = Way(hands_mm, axes, np.full(self._ms, pedal))
        if self._drawn.delay_ms == 0:
            return way
        of_axes = None if axes is None else np.concatenate([self._late.axes, axes])
        told = Way(np.concatenate([self._late.hands_mm, hands_mm]), of_axes, np.concatenate([self._late.pedals, way.pedals]))
        self._late = Way(told.hands_mm[self._ms:], self._late.axes if of_axes is None else of_axes[self._ms:], told.pedals[self._ms:])
        return Way(told.hands_mm[:self._ms], None if of_axes is None else of_axes[:self._ms], told.pedals[:self._ms])

    def _arrived(self, after: Step) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """The values that step returns, once the session is there."""
        before, self._now = self._now, after
        terminated = bool(self._is_done(before, after)) or ("fault" in self._ends and after.fault != "") or (
            "protected" in self._ends and after.touches_protected)
        truncated = bool(after.time_s >= self._duration_s - 1e-9)
        self._is_over = terminated or truncated
        return self._observe(after), float(self._reward(before, after)), terminated, truncated, self._info(after)

    def render(self) -> None:
        """Does nothing: render_mode is None. osteomill.render(env.session) draws it."""

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
        of_episode = {"_hand_mm", "_axis", "_late", "_now"}
        return {name: value for name, value in self.__dict__.items() if name not in of_episode} | {"session": None, "_is_over": False}

    def __deepcopy__(self, memo: dict[int, Any]) -> Env:
        for case in [self.case, *self._draws.cases]:
            memo[id(case)] = case  # they never change
        other = self.__class__.__new__(self.__class__)
        other.__dict__.update({name: copy.deepcopy(value, memo) for name, value in self.__getstate__().items()})
        return other

    def __repr__(self) -> str:
        return f"<Env of {self.case!r}: {', '.join(self.observation_space)}; {1000 / self._ms:g} actions a second>"

    def _meant(self, action: Any) -> tuple[NDArray[np.float64], NDArray[np.float64], bool]:
        """Velocity, rate of turning (empty if the spindle keeps its direction), pedal."""
        shape = self._fastest.shape
        try:
            numbers = np.asarray(action, float)
        except (TypeError, ValueError):
            raise BadInput(f"action: takes an array {shape} of numbers, not {_short(action)}") from None
        if numbers.shape != shape or not np.isfinite(numbers).all():
            parts = "velocity and pedal" if shape == (4,) else "velocity, rate of turning and pedal"
            raise BadInput(f"action: takes an array {shape} of finite numbers, {parts}, not {_short(action)}")
        numbers = np.clip(numbers, self.action_space.low, self.action_space.high)
        if self._actions == "raw":
            return numbers[:3], numbers[3:-1], bool(numbers[-1] > 0.5)
        rates = numbers * self._fastest
        return rates[:3], rates[3:-1], bool(numbers[-1] > 0.0)

    @staticmethod
    def _info(step: Step) -> dict[str, Any]:
        return {"time_s": step.time_s, "removed_mm3": step.removed_mm3["total"], "force_n": float(np.linalg.norm(step.force_n)),
                "spindle_on": step.spindle_on, "fault": step.fault, "step": step}

    def _observe(self, step: Step) -> Observation:
        assert self.session is not None
        return self._observer.observe(step, self.session, self._drawn, self.np_random)


def _turned(axis: NDArray[np.float64], rate_rad_per_s: NDArray[np.float64], passed_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """The axis after these times (N, 1), turned at a constant rate: Rodrigues' formula."""
    speed = float(np.linalg.norm(rate_rad_per_s))
    if speed == 0.0:
        return np.tile(axis, (len(passed_s), 1))
    about = rate_rad_per_s / speed
    angle = speed * passed_s
    turned = axis * np.cos(angle) + np.cross(about, axis) * np.sin(angle) + about * (about @ axis) * (1.0 - np.cos(angle))
    axes: NDArray[np.float64] = turned / np.linalg.norm(turned, axis=1, keepdims=True)
    return axes


def _entropy_of(sequence: np.random.SeedSequence) -> int:
    entropy = sequence.entropy
    return entropy if isinstance(entropy, int) else -1


def _short(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."
