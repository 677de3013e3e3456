"""Curves of the force and of its cost: beside the reference, the older contact models, convergence with the size of voxels, cost
against burr, bone and spindle, memory.

Each kind has its cases, its measurement of one, and its table.
"""

import time
from typing import Any

import numpy as np
import pandas as pd

from osteomill import Burr, _studies
from osteomill.studies.force_series import ForceSeries, relative_error
from osteomill.studies.studied_motions import run_motion, studied_motions

VOXEL_MM = 0.1
FEED_MM_PER_S = 6.0
CURVES = {
    "depth_mm": ("depth in mm", (0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0)),
    "feed_mm_per_s": ("feed in mm/s", (0.5, 1.0, 2.0, 4.0, 6.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0)),
    "thousand_rpm": ("thousand rpm", (10, 15, 20, 30, 40, 50, 60, 70, 80)),
}
CONTACT_FEEDS_MM_PER_S = (2.0, 6.0)


def burr_of(diameter_mm: float = 5.0, rpm: float = 10_000.0) -> Burr:
    return Burr(diameter_mm=diameter_mm, rpm=rpm, clockwise=False)


# Force against depth, feed and spindle speed: an upright 5 mm burr, 1 mm deep at 6 mm/s and 10 000 rpm, with one of these varied.


def curve_cases(quick: bool) -> list[dict[str, Any]]:
    return [{"part": "curve", "varied": varied, "at": float(at), "quick": quick} for varied, (_, all_of) in CURVES.items()
            for at in all_of]


def measure_curve(case: dict[str, Any]) -> dict[str, Any]:
    said = {"depth_mm": 1.0, "feed_mm_per_s": FEED_MM_PER_S, "thousand_rpm": 10.0} | {case["varied"]: case["at"]}
    motion = _studies.SteadyCase(name_of_curve(case), burr_of(rpm=1000.0 * said["thousand_rpm"]), said["feed_mm_per_s"],
                                 said["depth_mm"])
    path: dict[str, Any] = {"travel_mm": 0.6 if case["quick"] else 2.0, "min_steps": 10}
    reference_n, _ = motion.reference()
    return {"reference": reference_n,
            "voxels": ForceSeries(*motion.run(_studies.Milling(), **path)).mean_force_n(),
            "bins": ForceSeries(*motion.run(_studies.Milling(summation="bins"), **path)).mean_force_n()}


def name_of_curve(case: dict[str, Any]) -> str:
    return f"{CURVES[case['varied']][0]} {case['at']:g}"


def curve_table(cases: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    return pd.DataFrame([{case["varied"]: case["at"]}
                         | {f"{of}_{axis}_n": value for of, force_n in found.items() for axis, value in zip("xyz", force_n)}
                         for case, found in zip(cases, outcomes)])


# The older contact models beside milling: a 5 mm burr at rest in flat bone; milling is the reference of a slot.


def contact_cases(quick: bool) -> list[dict[str, Any]]:
    step_mm = 0.5 if quick else 0.1
    return [{"part": "contact", "depth_mm": i * step_mm} for i in range(1, round(2.5 / step_mm) + 1)]


def measure_contact(case: dict[str, Any]) -> dict[str, Any]:
    depth_mm = case["depth_mm"]
    milling = {f"milling {feed:g} mm/s": float(np.linalg.norm(_studies.reference_force(
        burr_of(), (0.0, 0.017, 2.5 - depth_mm), (0.0, 0.0, 1.0), (feed, 0.0, 0.0)))) for feed in CONTACT_FEEDS_MM_PER_S}
    return {model: _studies.resting_force_n(model, depth_mm) for model in _studies.contact_models()} | milling


def contact_table(cases: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    return pd.DataFrame([{"depth_mm": case["depth_mm"]} | found for case, found in zip(cases, outcomes)])


# Error against the size of voxels. They divide the 0.8 mm of the layer of "two layers": the study is about the cut of voxels, not
# about the border of a layer within a voxel of one stiffness.

CONVERGING = {"smoothed": "smoothed", "in_part": "linear", "there_or_gone": "binary"}


def convergence_cases(quick: bool) -> list[dict[str, Any]]:
    parts = (2, 4, 8) if quick else (2, 3, 4, 5, 6, 8, 10, 16)
    return [{"part": "convergence", "voxel_mm": 0.8 / n, "quick": quick} for n in parts]


def measure_convergence(case: dict[str, Any]) -> dict[str, float]:
    """In percent: means over motions and over lattices that lie in several ways, as shares of a voxel, so that coarse
    and fine voxels are met at the same places."""
    places = 2 if case["quick"] else 4
    errors: dict[str, list[float]] = {name: [] for name in CONVERGING}
    for motion in studied_motions(1.2 if case["quick"] else 2.4):
        for i in range(places):
            share = (i + 0.31) / places
            for name, coverage in CONVERGING.items():
                (series,) = run_motion(motion, [_studies.Milling(coverage=coverage)], voxel_mm=case["voxel_mm"],
                                       milling_rate_hz=100.0,
                                       lattice_shift_mm=case["voxel_mm"] * np.array([share, 2.62 * share % 1.0, 0.0]))
                errors[name].append(relative_error(series.mean_force_n(), motion.reference_n))
    return {f"{name}_error_percent": 100.0 * float(np.mean(its)) for name, its in errors.items()}


def convergence_table(cases: list[dict[str, Any]], outcomes: list[dict[str, float]]) -> pd.DataFrame:
    """A table with the power law that fits each: a line through the logarithms, whose slope is 1 if the error is proportional to
    the size."""
    table = pd.DataFrame([{"voxel_mm": case["voxel_mm"]} | found for case, found in zip(cases, outcomes)])
    for name in CONVERGING:
        slope, at_one = np.polyfit(np.log(table["voxel_mm"]), np.log(table[f"{name}_error_percent"]), 1)
        table[f"{name}_slope"] = slope
        table[f"{name}_fit_percent"] = np.exp(at_one) * table["voxel_mm"] ** slope
    return table


# Cost of a step as burr, bone and spindle grow: a burr that travels half immersed in the face of a cube of bone, by
# new voxels only and by the published scan, in turns.

SCALED = {"diameter_mm": (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0), "edge_voxels": (128, 256, 512, 1024),
          "thousand_rpm": (5.0, 10.0, 20.0, 40.0, 80.0)}


def scaling_cases(quick: bool) -> list[dict[str, Any]]:
    largest = 256 if quick else 1024  # 1024: 1 GiB of bone, and as much for each of two models
    return [{"part": "scaling", "varied": varied, "at": at, "quick": quick} for varied, all_of in SCALED.items()
            for at in all_of if varied != "edge_voxels" or at <= largest]


def measure_scaling(case: dict[str, Any]) -> dict[str, float]:
    """Medians in microseconds, at 100 Hz and 1 kHz."""
    said = {"diameter_mm": 5.0, "edge_voxels": 128, "thousand_rpm": 10.0} | {case["varied"]: case["at"]}
    block = _studies.Block.cube(int(said["edge_voxels"]), VOXEL_MM)
    models = [_studies.Milling(), _studies.Milling(summation="bins", coverage="binary", search="full_scan")]
    found = {}
    for rate_hz, rate in ((100.0, "100_hz"), (1000.0, "1_khz")):
        step_mm = FEED_MM_PER_S / rate_hz
        steps = 15 if case["quick"] else 40
        way = [(-0.5 * steps * step_mm + i * step_mm, 0.017, 0.0) for i in range(steps + 1)]
        burr = burr_of(said["diameter_mm"], 1000.0 * said["thousand_rpm"])
        runs = _studies.run_path(models, block, burr, (0.0, 0.0, 1.0), 1.0 / rate_hz, way)
        for name, run in zip(("new", "published"), runs):
            found[f"{name}_{rate}_us"] = float(np.median(ForceSeries(*run).step_us))
    return found


def scaling_table(cases: list[dict[str, Any]], outcomes: list[dict[str, float]]) -> pd.DataFrame:
    return pd.DataFrame([{case["varied"]: case["at"]} | found for case, found in zip(cases, outcomes)])


# Memory of a bone, and the time until it can be milled: both must grow with the bone, not with the box around it.

CUBES_VOXELS = (32, 64, 128, 256, 512)
BOXES_VOXELS = (128, 256, 512, 1024)
SCENES = ("cube", "tooth", "head", "jaw", "mastoid")


def memory_cases(quick: bool) -> list[dict[str, Any]]:
    cubes = [{"part": "memory", "of": "bone", "cube": n, "box": n} for n in CUBES_VOXELS]
    boxes = [{"part": "memory", "of": "box", "cube": 128, "box": n} for n in BOXES_VOXELS]
    return cubes + boxes + [{"part": "memory", "of": "scene", "scene": name} for name in SCENES[: 1 if quick else None]]


def measure_memory(case: dict[str, Any]) -> dict[str, Any]:
    began = time.monotonic()
    bone = _studies.Block.scene(case["scene"]) if case["of"] == "scene" else _studies.Block.cube(case["cube"], VOXEL_MM, case["box"])
    start_s = time.monotonic() - began
    return {"bone_mm3": bone.bone_mm3, "box_mm3": bone.box_mm3, "mebibytes": bone.memory_bytes / 2**20,
            "bytes_per_mm3": bone.memory_bytes / bone.bone_mm3, "start_s": start_s}


def memory_table(cases: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    return pd.DataFrame([{"of": case["of"], "name": case.get("scene") or f"cube of {VOXEL_MM * case['cube']:g} mm in "
                          f"{VOXEL_MM * case['box']:g} mm"} | found for case, found in zip(cases, outcomes)])
