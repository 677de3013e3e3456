"""The truth about a burr on its path: the bone left in its way, what it is cutting, the state, the time to breakthrough.

The *far side* is free space of the bone as it was before milling, from which the way back along the spindle leads through at least
0.3 mm of bone: beyond a plate, in a cavity behind a wall. Free space in front of the bone is none, and what is milled is none. All
distances are to it or to a protected structure, whichever is nearer; they are good to half a voxel.
"""

import dataclasses
import functools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from osteomill import Case

Array = NDArray[np.float64]

STATES = ("air", "cancellous", "cortical", "breakthrough")
AIR, CANCELLOUS, CORTICAL, BREAKTHROUGH = range(len(STATES))
CORTICAL_FROM = 0.4  # relative stiffness; trabecular bone has 0.113, cortical bone 1
REACH_MM = 6.0  # farther is not looked for
THINNEST_WALL_MM = 0.3


def state_of(is_cutting: NDArray[np.bool_], wall_mm: Array, stiffness: Array) -> NDArray[np.uint8]:
    """The state of each sample, as a number of STATES.

    breakthrough   the ball reaches the far side or a protected structure (wall_mm <= 0)
    air            it does not, and no edge cuts
    cortical       bone is cut, and that in the middle of the cut has a relative stiffness of 0.4 or more
    cancellous     the same, softer
    """
    bone = np.where(stiffness >= CORTICAL_FROM, CORTICAL, CANCELLOUS)
    state = np.where(wall_mm <= 0.0, BREAKTHROUGH, np.where(is_cutting, bone, AIR))
    return np.asarray(state, dtype=np.uint8)


def time_to_breakthrough_s(state: NDArray[np.uint8], step_s: float) -> Array:
    """Until the first sample of that state, 0 from there on; nan in a motion that has none."""
    through = np.flatnonzero(state == BREAKTHROUGH)
    if not len(through):
        return np.full(len(state), np.nan)
    return np.asarray(step_s * np.maximum(0, through[0] - np.arange(len(state))), dtype=np.float64)


@dataclasses.dataclass(frozen=True)
class Truth:
    """A row a position of the burr."""

    wall_mm: Array  # shortest way of the ball to the far side or a structure; below 0: so far beyond; nan: beyond reach
    thickness_mm: Array  # the same along the feed; nan: beyond reach, or the burr stands
    stiffness: Array  # relative, in the middle of the cut; 0 where nothing is cut
    ct_hu: Array  # likewise; nan where nothing is cut
    tissue: NDArray[np.uint8]  # label, likewise


def truth_of(case: Case, positions_mm: Array, axes: Array, normals: Array, cut_stiffness: Array, radius_mm: float, has_scan: bool) -> Truth:
    """`normals`: mean outward normal of what cuts, (n, 3); 0 where nothing does. `cut_stiffness`: mean of what is cut, for where the
    middle of the cut lies in no bone. `has_scan`: CT numbers are the case's, else by its stiffness."""
    way = FarSide(case, axes.mean(axis=0), positions_mm, radius_mm)
    wall_mm = way.distance_mm(positions_mm) - radius_mm
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    is_cutting = lengths[:, 0] > 0.0
    outward = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0.0)
    middle_mm = positions_mm + (radius_mm + 0.5 * case.bone.spacing_mm) * outward  # the next voxel that the burr comes to
    there = sampled(case, "stiffness", middle_mm)
    stiffness = np.where(is_cutting, np.where(there > 0.0, there, cut_stiffness), 0.0)
    ct_hu = sampled(case, "hu", middle_mm) if has_scan else hu_of_stiffness(stiffness)
    return Truth(np.where(wall_mm > REACH_MM, np.nan, wall_mm), way.along_mm(positions_mm, radius_mm), stiffness,
                 np.where(is_cutting, ct_hu, np.nan), np.where(is_cutting, sampled(case, "tissue", middle_mm), 0).astype(np.uint8))


class FarSide:
    """The far side of the bone about a path, along one axis: the mean spindle axis of the path."""

    def __init__(self, case: Case, axis: Array, positions_mm: Array, radius_mm: float) -> None:
        from scipy import ndimage

        bone = case.bone
        self.spacing_mm = bone.spacing_mm
        margin_mm = radius_mm + REACH_MM
        voxels = [(ends - bone.origin_mm) / bone.spacing_mm for ends in
                  (positions_mm.min(axis=0) - margin_mm, positions_mm.max(axis=0) + margin_mm)]
        self._from = np.clip(np.floor(voxels[0]).astype(int), 0, np.array(bone.shape) - 1)
        to = np.clip(np.ceil(voxels[1]).astype(int) + 1, self._from + 1, bone.shape)
        self._origin_mm = bone.origin_mm + bone.spacing_mm * self._from
        box = (self._from.tolist(), to.tolist())
        is_bone = bone.fraction(box) >= 128
        is_end = ~is_bone & (self._bone_behind_mm(is_bone, axis / np.linalg.norm(axis)) >= THINNEST_WALL_MM)
        if case.structures:
            is_end |= is_bone & np.isin(bone.tissue(box), [case.tissues[name] for name in case.structures])
        far_mm = np.full(is_end.shape, 2.0 * margin_mm)
        self._field_mm = ndimage.distance_transform_edt(~is_end, self.spacing_mm) - 0.5 * self.spacing_mm if is_end.any() else far_mm

    def distance_mm(self, places_mm: Array) -> Array:
        """From a place to the far side's surface."""
        from scipy import ndimage

        at = (places_mm - self._origin_mm) / self.spacing_mm
        return np.asarray(ndimage.map_coordinates(self._field_mm, at.T, order=1, mode="nearest"))

    def along_mm(self, positions_mm: Array, radius_mm: float) -> Array:
        """How far a ball may go along its feed until it touches the far side, by sphere tracing."""
        feed = np.gradient(positions_mm, axis=0) if len(positions_mm) > 1 else np.zeros_like(positions_mm)
        speed = np.linalg.norm(feed, axis=1, keepdims=True)
        direction = np.divide(feed, speed, out=np.zeros_like(feed), where=speed > 0.0)
        gone_mm = np.zeros(len(positions_mm))
        for _ in range(60):
            gap_mm = self.distance_mm(positions_mm + gone_mm[:, None] * direction) - radius_mm
            gone_mm = np.minimum(gone_mm + np.maximum(gap_mm, 0.0), REACH_MM + 1.0)
        return np.where((speed[:, 0] > 0.0) & (gone_mm <= REACH_MM) & (gap_mm < 0.5 * self.spacing_mm), gone_mm, np.nan)

    def _bone_behind_mm(self, is_bone: NDArray[np.bool_], axis: Array) -> Array:
        """Bone on the way from each voxel back along the spindle, for 12 mm, in steps of a voxel."""
        count = np.zeros(is_bone.shape, np.uint8)
        for step in range(1, min(255, round(12.0 / self.spacing_mm))):
            shift = np.rint(step * axis).astype(int)
            if (np.abs(shift) >= is_bone.shape).any():
                break
            here = tuple(slice(max(0, -s), min(n, n - s)) for s, n in zip(shift, is_bone.shape))
            there = tuple(slice(max(0, s), min(n, n + s)) for s, n in zip(shift, is_bone.shape))
            count[here] += is_bone[there]
        return np.asarray(self.spacing_mm * count)


def is_bone_at(case: Case, places_mm: Array) -> NDArray[np.bool_]:
    """In the bone before milling."""
    return sampled(case, "fraction", places_mm) >= 128


@functools.lru_cache(4)
def _channel(case: Case, name: str) -> NDArray[Any]:
    return np.asarray(getattr(case.bone, name)())


def sampled(case: Case, channel: str, places_mm: Array) -> Array:
    """The channel's value in the nearest voxel; 0 (-1000 for `hu`) beyond the bone's grid."""
    values = _channel(case, channel)
    at = np.rint((places_mm - case.bone.origin_mm) / case.bone.spacing_mm).astype(int)
    inside = ((at >= 0) & (at < values.shape)).all(axis=1)
    found = np.full(len(at), -1000.0 if channel == "hu" else 0.0)
    found[inside] = values[tuple(at[inside].T)]
    return found


@functools.lru_cache(4)
def has_ct(case: Case) -> bool:
    try:
        case.bone.hu(((0, 0, 0), (1, 1, 1)))
    except ValueError:
        return False
    return True


def hu_of_stiffness(stiffness: Array) -> Array:
    """By the program's own relation (Keyak; docs/milling-model.md), the other way round: a bone without a scan has no other."""
    yield_mpa = stiffness * 114.0 * 1.6**1.72
    knee_mpa = 114.0 * 0.317**1.72
    return np.asarray(1000.0 * np.where(yield_mpa > knee_mpa, (yield_mpa / 114.0) ** (1.0 / 1.72), (yield_mpa / 137.0) ** (1.0 / 1.88)))
