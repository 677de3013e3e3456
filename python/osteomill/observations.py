"""Observations of an environment's session, as arrays by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from osteomill._core import BadInput, Case, Session, Step
from osteomill.draws import Drawn
from osteomill.gymnasium_spaces import spaces
from osteomill.render import View

if TYPE_CHECKING:
    from osteomill.fallback_spaces import Box

Observation = dict[str, NDArray[Any]]

FARTHEST_MM = 10_000.0
STRONGEST_N = 1_000.0
_IMAGES = {"rgb": "colour", "depth": "depth", "labels": "labels"}
_NAMES = ("pose", "hand", "force", "torque", "spindle", "removed", "distance", "plan", *_IMAGES)


class Pictures:
    """Pictures of sessions of one case, by one camera: shared by environments that are in one process."""

    def __init__(self, camera: Mapping[str, Any] | None, size_px: Sequence[int], names: Sequence[str]) -> None:
        width, height = size_px
        if not all(isinstance(edge, int) and 1 <= edge <= 4096 for edge in (width, height)):
            raise BadInput(f"picture_px: takes width and height, 1 to 4096 pixels each, not {tuple(size_px)}")
        self.size_px = (width, height)
        self._camera = {"name": "view", **(camera or {}), "width_px": width, "height_px": height}
        self._images = [_IMAGES[name] for name in names]
        self._view: View | None = None

    def of(self, session: Session) -> dict[str, Any]:
        """The images by kind."""
        if self._view is not None:
            try:
                return self._drawn(self._view, session)
            except BadInput:
                pass  # of another bone: a case that was drawn at random
        self._view = View(session, [self._camera], images=self._images)
        return self._drawn(self._view, session)

    @staticmethod
    def _drawn(view: View, session: Session) -> dict[str, Any]:
        [images] = view.draw(session)["images"].values()
        return dict(images)

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_view": None}

    def __deepcopy__(self, memo: dict[int, Any]) -> Pictures:
        other = self.__class__.__new__(self.__class__)
        other.__dict__.update(self.__getstate__())
        return other


class Observer:
    """Observer of sessions of `case`: the arrays of these names, each within its space."""

    def __init__(self, case: Case, names: Sequence[str], camera: Mapping[str, Any] | None, picture_px: Sequence[int]) -> None:
        self._case = case
        drawn = [name for name in names if name in _IMAGES]
        self.pictures = Pictures(camera, picture_px, drawn) if drawn else None
        self.space = spaces.Dict({name: self._space(name) for name in names})

    def _space(self, name: str) -> Box:
        if name == "pose":
            ends = np.array([FARTHEST_MM] * 3 + [1.0] * 3)
            return spaces.Box(-ends, ends, (6,), np.float64)
        if name == "hand":
            return spaces.Box(-FARTHEST_MM, FARTHEST_MM, (3,), np.float64)
        if name == "force":
            return spaces.Box(-STRONGEST_N, STRONGEST_N, (3,), np.float64)
        if name == "torque":
            return spaces.Box(-np.inf, np.inf, (3,), np.float64)
        if name == "spindle":
            return spaces.Box(-np.inf, np.inf, (2,), np.float64)
        if name == "removed":
            most_mm3 = self._case.bone.volume_mm3 + 1.0
            return spaces.Box(-1.0, most_mm3, (len(self._case.removal_names),), np.float64)
        if name == "distance":
            return spaces.Box(-np.inf, np.inf, (len(self._case.structures),), np.float64)
        if name == "plan":
            if self._case.plan_distance_mm(self._case.start_mm) is None:
                raise BadInput('observation: "plan": the case has none; set=["plan.tissue=NAME"] makes a tissue the plan')
            return spaces.Box(-np.inf, np.inf, (1,), np.float64)
        if name in _IMAGES:
            assert self.pictures is not None
            width, height = self.pictures.size_px
            if name == "depth":
                return spaces.Box(0.0, np.inf, (height, width), np.float32)
            return spaces.Box(0, 255, (height, width, 3) if name == "rgb" else (height, width), np.uint8)
        if name.startswith("crop") and name[4:].isdecimal() and 1 <= int(name[4:]) <= 256:
            return spaces.Box(0, 255, (int(name[4:]),) * 3, np.uint8)
        raise BadInput(f'observation: "{name}" is none of {", ".join(_NAMES)}, cropN (N from 1 to 256)')

    def observe(self, step: Step, session: Session, drawn: Drawn, generator: np.random.Generator) -> Observation:
        """All observations of an instant. Pose, hand and plan are as a navigation shows them, with the episode's error of
        registration and noise."""
        images = self.pictures.of(session) if self.pictures is not None else {}

        def shown(place_mm: NDArray[np.float64]) -> NDArray[np.float64]:
            place_mm = place_mm + drawn.registration_mm if drawn.registration_mm.any() else place_mm
            return place_mm + generator.normal(0.0, drawn.pose_noise_mm, 3) if drawn.pose_noise_mm > 0.0 else place_mm

        def seen(name: str) -> NDArray[Any]:
            if name == "pose":
                return np.concatenate([shown(step.burr_mm), np.clip(step.axis, -1.0, 1.0)])
            if name == "hand":
                return shown(step.hand_mm)
            if name == "force":
                return step.force_n + generator.normal(0.0, drawn.force_noise_n, 3) if drawn.force_noise_n > 0.0 else step.force_n
            if name == "torque":
                return step.torque_nmm
            if name == "spindle":
                return np.array([step.spindle_torque_nmm, step.spindle_power_w])
            if name == "removed":
                return np.array(list(step.removed_mm3.values()))
            if name == "distance":
                return np.array(list(step.distance_mm.values()))
            if name == "plan":
                return np.array([drawn.case.plan_distance_mm(shown(step.burr_mm))])
            if name in _IMAGES:
                return np.asarray(images[_IMAGES[name]])
            bone, edge = session.bone, int(name[4:])
            middle = np.rint((step.burr_mm - bone.origin_mm) / bone.spacing_mm).astype(int)
            first = middle - edge // 2
            return bone.fraction((first.tolist(), (first + edge).tolist()))

        return {name: seen(name) for name in self.space}
