"""Many environments in one call: their sessions are stepped in threads, without the interpreter's lock."""

from __future__ import annotations

import copy
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from osteomill._core import BadInput, Case, Fault, _step_together
from osteomill.env import Env
from osteomill.gymnasium_spaces import HAS_GYMNASIUM, spaces
from osteomill.observations import Observation

if TYPE_CHECKING or not HAS_GYMNASIUM:
    _Base = object
    _NEXT_STEP: Any = "NextStep"
else:
    from gymnasium.vector import AutoresetMode, VectorEnv as _Base

    _NEXT_STEP = AutoresetMode.NEXT_STEP

Flags = NDArray[np.bool_]


class VectorEnv(_Base):
    """`num_envs` environments of one case, stepped together: in gymnasium's vector form, and a VectorEnv of gymnasium's if that
    is installed.

    Each is the Env of the same arguments, and its results are to the bit those of that Env alone. Observations are batched,
    (num_envs, ...) by name; rewards, terminations and truncations are (num_envs,). An environment whose episode has ended is
    begun anew by the next step, whose action it does not take, with reward 0 (metadata["autoreset_mode"]).

    threads: number of threads that step sessions; None: as many as this process may use processors.
    """

    metadata: dict[str, Any] = {"render_modes": [], "render_fps": 50, "autoreset_mode": _NEXT_STEP}
    render_mode: str | None = None
    spec: Any = None
    closed = False

    def __init__(self, case: Case | str | Sequence[Case] = "tooth", num_envs: int = 1, *, threads: int | None = None, **arguments: Any) -> None:
        if isinstance(num_envs, bool) or not isinstance(num_envs, int) or not 1 <= num_envs <= 100_000:
            raise BadInput(f"num_envs: takes 1 to 100000 environments, not {num_envs!r}")
        threads = len(os.sched_getaffinity(0)) if threads is None else threads
        if isinstance(threads, bool) or not isinstance(threads, int) or threads < 1:
            raise BadInput(f"threads: takes 1 or more, or None, not {threads!r}")
        self.num_envs, self.threads = num_envs, threads
        first = Env(case, **arguments)
        self.envs = [first, *(copy.copy(first) for _ in range(num_envs - 1))]  # what never changes is shared
        self.single_observation_space, self.single_action_space = first.observation_space, first.action_space
        self.observation_space = spaces.Dict({name: self._batched(space) for name, space in first.observation_space.items()})
        self.action_space = self._batched(first.action_space)
        self._is_over = np.zeros(num_envs, bool)

    def _batched(self, space: Any) -> Any:
        shape = (self.num_envs, *space.shape)
        return spaces.Box(np.broadcast_to(space.low, shape), np.broadcast_to(space.high, shape), shape, space.dtype)

    def reset(self, *, seed: int | Sequence[int | None] | None = None,
              options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode of each. seed: one for each environment, or the first's, and each next has one more."""
        if seed is None or isinstance(seed, (int, np.integer)):
            seeds: Sequence[int | None] = [None if seed is None else int(seed) + i for i in range(self.num_envs)]
        else:
            seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise BadInput(f"seed: takes one for each of the {self.num_envs} environments, not {len(seeds)}")
        results = [env.reset(seed=one, options=options) for env, one in zip(self.envs, seeds)]
        self._is_over[:] = False
        return self._stacked([seen for seen, _ in results]), _gathered([info for _, info in results])

    def step(self, actions: Any) -> tuple[Observation, NDArray[np.float64], Flags, Flags, dict[str, Any]]:
        """Takes an action for each, (num_envs, ...); returns observations, rewards, terminations, truncations, infos.

        infos: of each plain number of Env's info an array (num_envs,), and "_NAME", a mask of the environments that have it;
        "step", the Steps. There are no "ticks".
        """
        if any(env.session is None for env in self.envs):
            raise Fault("call reset() before step()")
        actions = self._checked(actions)
        moving = np.flatnonzero(~self._is_over)
        ways = [self.envs[i]._way(actions[i]) for i in moving]
        steps = _step_together([self.envs[i].session for i in moving], [way.hands_mm for way in ways], [way.axes for way in ways],
                               [way.pedals for way in ways], self.threads)
        results: list[Any] = [None] * self.num_envs
        for i, step in zip(moving, steps):
            results[i] = self.envs[i]._arrived(step)
        for i in np.flatnonzero(self._is_over):
            seen, info = self.envs[i].reset()
            results[i] = (seen, 0.0, False, False, info)
        terminations, truncations = (np.array([result[at] for result in results], bool) for at in (2, 3))
        self._is_over = terminations | truncations
        return (self._stacked([result[0] for result in results]), np.array([result[1] for result in results], float), terminations, truncations,
                _gathered([result[4] for result in results]))

    def _checked(self, actions: Any) -> NDArray[Any]:
        try:
            numbers = np.asarray(actions, float)
        except (TypeError, ValueError):
            numbers = np.empty(0)
        if numbers.shape != self.action_space.shape:
            raise BadInput(f"actions: takes an array {self.action_space.shape} of numbers, not {np.shape(numbers) or type(actions).__name__}")
        return numbers

    def _stacked(self, seen: list[Observation]) -> Observation:
        return {name: np.stack([one[name] for one in seen]) for name in self.observation_space}

    def render(self) -> None:
        """Does nothing: render_mode is None. osteomill.render(env.session) draws one of `envs`."""

    def close(self, **_: Any) -> None:
        """Ends the sessions."""
        for env in self.envs:
            env.close()
        self.closed = True

    def __repr__(self) -> str:
        return f"<VectorEnv of {self.num_envs} times {self.envs[0]!r}, in {self.threads} threads>"


def _gathered(infos: list[dict[str, Any]]) -> dict[str, Any]:
    """Infos gathered as in gymnasium's vector environments: arrays by name, and masks of the environments that have a value."""
    gathered: dict[str, Any] = {}
    for name in {name: None for info in infos for name in info}:
        has = np.array([name in info for info in infos])
        values = [info.get(name) for info in infos]
        if all(isinstance(value, (bool, int, float)) for value in values):
            gathered[name] = np.array(values)
        else:
            gathered[name] = np.empty(len(infos), object)
            gathered[name][:] = values
        gathered["_" + name] = has
    return gathered
