"""Bones and paths of the study `states`: layered plates, and motions over them, over a case, of a recording, or of a table.

A motion is a dict that JSON can say, so that it is worked out anywhere: which bone, which path, which seed. The published motions
(doi 10.1186/s40001-023-01154-y): a 4 mm burr that leans by 45 degrees at 0.5 mm/s, slots 0.5, 1 and 1.5 mm deep.
"""

import dataclasses
import functools
import math
import pathlib
import tempfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from osteomill import Bone, Case, Recording
from osteomill.studies.text import printable

Array = NDArray[np.float64]
Motion = dict[str, Any]

FEED_MM_PER_S, TILT_DEG, SLOT_DEPTHS_MM = 0.5, 45.0, (0.5, 1.0, 1.5)
SLOT_MM, STAND_OFF_MM, BEYOND_MM, LIFT_MM_PER_S = 3.0, 0.3, 0.6, 5.0
DEEPEST_MM = 6.0  # where no far side is met
SPREAD_MM = 1.0  # of the places where motions over a case begin
VOXEL_MM = 0.1
TRABECULAR, CORTICAL = 0.113, 1.0  # scenes/materials.toml
EDGES_N_PER_MM = (0.3, 0.3, 0.0)  # of the burrs of the cases mastoid, jaw and tooth


@dataclasses.dataclass(frozen=True)
class Path:
    """One row a millisecond: the burr's centre, its axis from tip to shank, whether the spindle is on."""

    positions_mm: Array
    axes: Array
    spindle_on: NDArray[np.bool_]
    burr: int


@dataclasses.dataclass(frozen=True)
class Entry:
    """Where a straight way `into` the bone meets it, mm, and how thick it is there; None: thicker than looked for."""

    place_mm: Array
    into: Array
    thickness_mm: float | None


def motions_of(bones: list[dict[str, Any]], seed: int, randoms: int) -> list[Motion]:
    """For each bone three published slots, a hole drilled through at the same feed, and random dives."""
    kinds: list[dict[str, Any]] = [{"kind": "slot", "depth_mm": depth} for depth in SLOT_DEPTHS_MM]
    kinds += [{"kind": "drill"}] + [{"kind": "random", "draw": draw} for draw in range(randoms)]
    listed = [bone | kind for bone in bones for kind in kinds]
    return [{"number": number, "seed": seed} | motion for number, motion in enumerate(listed)]


def split_of(motions: list[Motion], seed: int) -> None:
    """Names two splits in each motion, 3 : 1 : 1 as near as the numbers allow: by case, all motions of a bone together; by motion, of
    each bone and kind alike. A motion has one name in each."""
    rng = np.random.default_rng([seed, 1])
    bones = sorted({bone_name(motion) for motion in motions})
    by_case = dict(zip(map(str, rng.permutation(bones)), _shares(len(bones))))
    by_motion = dict(zip(map(int, rng.permutation(len(motions))), _shares(len(motions))))
    for place, motion in enumerate(motions):
        motion |= {"split_by_case": by_case[bone_name(motion)], "split_by_motion": by_motion[place]}


def _shares(count: int) -> list[str]:
    fifth = math.ceil(count / 5) if count > 2 else 0
    return ["test"] * fifth + ["validation"] * fifth + ["train"] * (count - 2 * fifth)


def bone_name(motion: Motion) -> str:
    return f"plate {motion['plate']}" if "plate" in motion else str(motion["case"])


def name_of(motion: Motion) -> str:
    of = {"slot": f"slot {motion.get('depth_mm', 0):g} mm", "random": f"random {motion.get('draw')}"}.get(motion["kind"], motion["kind"])
    return printable(f"{motion['number']}, {bone_name(motion)}, {of}")


@functools.lru_cache(2)
def case_of(name: str | None, plate: int | None, seed: int, burr: str | None, rpm: float | None) -> Case:
    """A case by its name, or a plate by its number. Without a name of a burr: the 4 mm ball where the case has one, else its own."""
    if plate is not None:
        edges = f"burrs.4 mm.edge_coefficients_n_per_mm={list(EDGES_N_PER_MM)}"
        with tempfile.TemporaryDirectory(prefix="osteomill-plate-") as folder:
            file = pathlib.Path(folder, "plate.nrrd")
            plate_bone(seed, plate).save(file)
            return Case("cube", bone=file, burr=burr or "4 mm", rpm=rpm, set=[edges])
    case = Case(str(name), rpm=rpm)
    chosen = burr or next((one.name for one in case.burrs if one.name == "4 mm"), None)
    return case.with_(burr=chosen) if chosen else case


def case_of_motion(motion: Motion) -> Case:
    return case_of(motion.get("case"), motion.get("plate"), motion["seed"], motion.get("burr"), motion.get("rpm"))


def plate_layers_mm(seed: int, number: int) -> tuple[float, float, float]:
    """Thickness of the outer cortex, the cancellous bone, the inner cortex."""
    rng = np.random.default_rng([seed, 2, number])
    low, high = np.array([0.8, 1.2, 0.6]), np.array([1.6, 2.4, 1.2])
    outer, middle, inner = VOXEL_MM * np.round(rng.uniform(low, high) / VOXEL_MM)
    return float(outer), float(middle), float(inner)


def plate_bone(seed: int, number: int) -> Bone:
    """12 x 8 mm, its top at z = 0, with 3 mm of air above and below. Stiffness varies from place to place: cortex by a tenth,
    cancellous bone by half, over some 0.3 mm."""
    from scipy import ndimage

    layers = plate_layers_mm(seed, number)
    rng = np.random.default_rng([seed, 3, number])
    air, outer, middle, inner = (round(mm / VOXEL_MM) for mm in (3.0, *layers))
    shape = (120, 80, air + inner + middle + outer + air)
    texture = ndimage.gaussian_filter(rng.standard_normal(shape), 0.3 / VOXEL_MM)
    texture /= texture.std()
    stiffness = CORTICAL * rng.uniform(0.9, 1.1) * (1.0 + 0.1 * texture)
    cancellous = slice(air + inner, air + inner + middle)
    stiffness[:, :, cancellous] = TRABECULAR * rng.uniform(0.7, 1.5) * np.clip(1.0 + 0.5 * texture[:, :, cancellous], 0.2, None)
    is_bone = np.zeros(shape, bool)
    is_bone[:, :, air:-air] = True
    origin_mm = VOXEL_MM * (np.array([-60.0, -40.0, -(air + inner + middle + outer)]) + 0.5)
    return Bone.from_array(is_bone, spacing_mm=VOXEL_MM, origin_mm=origin_mm,
                           stiffness=np.clip(0.02 * np.round(stiffness / 0.02), 0.02, 5.0).astype(np.float32))


def path_of(motion: Motion, case: Case) -> Path:
    """ValueError in one line where the motion finds no bone."""
    if "recording" in motion:
        return recorded_path(pathlib.Path(motion["recording"]), case)
    if "trajectory" in motion:
        return trajectory_path(pathlib.Path(motion["trajectory"]), case)
    rng = np.random.default_rng([motion["seed"], 4, motion["number"]])
    up, start = case.start_axis, np.zeros(3) if "plate" in motion else case.start_mm
    across = np.linalg.svd(up[None])[2][1:]  # two directions across it
    turn = rng.uniform(0.0, 2.0 * np.pi)
    along = np.array([np.cos(turn), np.sin(turn)]) @ across
    entry = entry_of(case, start + SPREAD_MM * rng.uniform(-1.0, 1.0, 2) @ across, -up)
    feed, tilt, slant = FEED_MM_PER_S, np.radians(TILT_DEG), 0.0
    if motion["kind"] == "random":
        feed, tilt, slant = np.exp(rng.uniform(np.log(0.3), np.log(2.0))), np.radians(rng.uniform(0.0, 60.0)), rng.uniform(0.0, 0.6)
    begin = entry.place_mm + (0.5 * case.burrs[case.start_burr].diameter_mm + STAND_OFF_MM) * up
    lean = np.array([np.cos(turn + 0.5 * np.pi), np.sin(turn + 0.5 * np.pi)]) @ across
    corners, speeds = [begin], [feed]
    if motion["kind"] == "slot":
        corners += [begin - (STAND_OFF_MM + motion["depth_mm"]) * up]
        corners += [corners[-1] + SLOT_MM * along, corners[-1] + SLOT_MM * along + (motion["depth_mm"] + STAND_OFF_MM) * up]
        speeds = [feed, feed, LIFT_MM_PER_S]
    else:
        deep = STAND_OFF_MM + (DEEPEST_MM if entry.thickness_mm is None else entry.thickness_mm + BEYOND_MM)
        corners += [begin - deep * up + math.tan(slant) * deep * along]
    positions_mm = polyline(np.array(corners), speeds)
    if motion["kind"] == "random":
        positions_mm += wander(len(positions_mm), rng) @ across
    axis = np.cos(tilt) * up + np.sin(tilt) * lean
    return Path(positions_mm, np.tile(axis, (len(positions_mm), 1)), np.ones(len(positions_mm), bool), case.start_burr)


def polyline(corners_mm: Array, speeds_mm_per_s: list[float]) -> Array:
    """A point a millisecond, from corner to corner."""
    lasts_s = np.linalg.norm(np.diff(corners_mm, axis=0), axis=1) / speeds_mm_per_s
    at_s = np.concatenate([[0.0], np.cumsum(lasts_s)])
    time_s = 0.001 * np.arange(math.floor(1000.0 * at_s[-1]) + 1)
    return np.stack([np.interp(time_s, at_s, corners_mm[:, axis]) for axis in range(3)], axis=1)


def wander(count: int, rng: np.random.Generator) -> Array:
    """Sideways, mm (n, 2): two slow swings of up to 0.1 mm each way, from 0 on."""
    time_s = 0.001 * np.arange(count)[:, None, None]
    swings = rng.uniform(0.0, 0.1, (2, 2)) * np.sin(2.0 * np.pi * rng.uniform(0.1, 0.5, (2, 2)) * time_s)
    return np.asarray(swings.sum(axis=1))


def entry_of(case: Case, from_mm: Array, into: Array) -> Entry:
    """Looks for up to 60 mm, through bone for 12. ValueError where there is none."""
    from osteomill.studies.states_truth import is_bone_at

    step_mm = 0.5 * case.bone.spacing_mm
    along_mm = step_mm * np.arange(-20.0 / step_mm, 60.0 / step_mm)
    is_bone = is_bone_at(case, from_mm + along_mm[:, None] * into)
    if not is_bone.any():
        raise ValueError(f"no bone lies below {np.round(from_mm, 1)} of the case: start_pose must look at it along its axis")
    first = int(np.argmax(is_bone))
    behind = is_bone[first : first + round(12.0 / step_mm)]
    gap = round(0.3 / step_mm)  # less is a pore
    free = np.convolve(~behind, np.ones(gap), "valid") == gap
    thickness_mm = float(step_mm * np.argmax(free)) if free.any() else None
    return Entry(from_mm + (along_mm[first] - 0.5 * step_mm) * into, into, thickness_mm)


def recorded_path(file: pathlib.Path, case: Case) -> Path:
    """The path of the burr in a recording of a session of this case. ValueError in one line for another bone, no ticks or several burrs."""
    with Recording(file) as recording:
        ticks = recording.ticks
        if recording.bone_at(float(recording.time_s[0])).checksum() != case.bone.checksum():
            raise ValueError(f"{file}: is of another bone than this case has: name the case that was recorded")
    burrs = np.unique(ticks["burr"])
    if len(burrs) != 1:
        raise ValueError(f"{file}: has {len(burrs)} burrs in use: a motion is of one")
    return Path(ticks["burr_mm"], ticks["axis"], np.asarray(ticks["spindle_on"], bool), int(burrs[0]))


def trajectory_path(file: pathlib.Path, case: Case) -> Path:
    """The path of a table of waypoints (docs/scenes.md), straight from one to the next; its pedal is the spindle. RuntimeError in one line for one that
    haptic_server would refuse, ValueError for several burrs or less than two milliseconds."""
    import pandas as pd

    case.with_(trajectory=file)  # refuses what is no trajectory of this case
    table = pd.read_csv(file, comment="#")
    burrs = table["burr"].unique() if "burr" in table else np.array([case.start_burr])
    if len(burrs) != 1:
        raise ValueError(f"{file}: has {len(burrs)} burrs in use: a motion is of one")
    at_s = table["t_s"].to_numpy(float)
    time_s = at_s[0] + 0.001 * np.arange(math.floor(1000.0 * (at_s[-1] - at_s[0]) + 1e-6) + 1)
    if len(time_s) < 2:
        raise ValueError(f"{file}: a path lasts at least a millisecond")
    axes = table[["axis_x", "axis_y", "axis_z"]].to_numpy(float)
    axes = _between(time_s, at_s, axes / np.linalg.norm(axes, axis=1)[:, None])
    pedal = table["pedal"].to_numpy(bool)[np.searchsorted(at_s, time_s + 1e-9, "right") - 1]
    return Path(_between(time_s, at_s, table[["x_mm", "y_mm", "z_mm"]].to_numpy(float)),
                axes / np.linalg.norm(axes, axis=1)[:, None], pedal, int(burrs[0]))


def _between(time_s: Array, at_s: Array, rows: Array) -> Array:
    return np.stack([np.interp(time_s, at_s, column) for column in rows.T], axis=1)
