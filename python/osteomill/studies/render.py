"""Speed against accuracy of pictures, and how smooth a cut looks.

Every way to draw a bone is timed and held against a reference image of the same look: rays in steps of a tenth of a voxel
in double precision, on the CPU (peak signal-to-noise ratio, structural similarity). Each axis of choice is varied by
itself, from the default: distance of the samples, shading, empty space that is skipped or not, resolution, and slices in
the place of rays. A wall cut by a sphere is drawn and held against the analytic picture of the sphere. Bones: the tooth of the
default scene, and, if OSTEOMILL_SCANS names the folder of trial scans, 40 mm of a skull.

--full-rate measures instead the frames that a graphics card draws in a second: render_full_rate.py.
"""

import argparse
import functools
import os
import pathlib
import re
from typing import Any

import pandas as pd

from osteomill import _studies
from osteomill.studies import render_full_rate
from osteomill.studies.options import UsageError, whole_within
from osteomill.studies.study_run import StudyRun

JOBS = 1
ONE_BY_ONE = True  # it draws and measures this machine

FULL_QUALITY_GOAL_DB = 40.0
WALL_PX_PER_VOXEL = (4.0, 10.0, 20.0)
TOOTH, SKULL = "tooth phantom", "skull CT"
SIZE_PX, QUICK_SIZE_PX = (640, 480), (240, 180)
USUAL_STEP_VOXELS = 0.5

GRADIENT = {"shading": "gradient", "transfer": ""}
SURFACE_VOXELS = {"shading": "surface-voxels", "transfer": ""}
SEE_THROUGH = {"shading": "gradient", "transfer": "tooth"}  # since the tooth's bone is seen through


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--width-px", type=whole_within(64, 4096), metavar="N", help="width of the pictures, 4:3 (640; 240 with --quick)")
    parser.add_argument("--full-rate", action="store_true",
                        help="only what a graphics card draws in a second at 2560 x 1440, orbiting and carving, with uploads and "
                        "texture memory; smaller and shorter where a software rasteriser draws")
    parser.add_argument("--size-px", type=_size, metavar="WxH", help="size of these pictures (2560x1440; 640x360 by a software rasteriser)")
    parser.add_argument("--frames", type=whole_within(1, 1_000_000), metavar="N",
                        help="of each of their rows (600; 8 by a software rasteriser)")
    parser.add_argument("--gpu", type=whole_within(0, 63), metavar="N",
                        help="draw on this GPU of several, counted from 0 (the first; where there is none, Mesa's software rasteriser)")
    parser.add_argument("--quick", action="store_true", help="fewer settings, smaller pictures: under a minute")


def _size(text: str) -> list[int]:
    read = re.fullmatch("([0-9]{1,5})x([0-9]{1,5})", text)
    if read and all(1 <= int(edge) <= 16384 for edge in read.groups()):
        return [int(edge) for edge in read.groups()]
    raise argparse.ArgumentTypeError(f"'{text}', not WIDTHxHEIGHT, such as 2560x1440")


def run(options: argparse.Namespace, study: StudyRun) -> None:
    if options.size_px and options.width_px:
        raise UsageError("--size-px excludes --width-px")
    for name in ("size_px", "frames"):
        if getattr(options, name) and not options.full_rate:
            raise UsageError(f"--{name.replace('_', '-')} requires --full-rate")
    renderer, is_software = _studies.what_draws(options.gpu)
    if options.full_rate:
        render_full_rate.run(options, study, renderer, is_software)
    else:
        run_accuracy(options, study, renderer)


def settings_of(quick: bool) -> list[dict[str, Any]]:
    """Every axis of choice by itself, from the default; fewer if quick."""
    def way(family: str, label: str, look: dict[str, Any], **changes: Any) -> dict[str, Any]:
        return {"family": family, "label": label, "look": look, "renderer": "raycast", "step_voxels": USUAL_STEP_VOXELS,
                "skips": True, "divisor": 1, "is_default": False} | changes

    settings = []
    for step in (0.5, 1.0, 2.0) if quick else (0.25, 0.5, 1.0, 2.0):
        settings.append(way("rays shaded by gradient", f"step {step:g}", GRADIENT, step_voxels=step, is_default=step == USUAL_STEP_VOXELS))
        settings.append(way("rays to surface voxels", f"step {step:g}", SURFACE_VOXELS, step_voxels=step))
    for step in (0.5,) if quick else (0.5, 1.0, 2.0):
        settings.append(way("rays without skipping", f"step {step:g}", GRADIENT, step_voxels=step, skips=False))
    for step in (0.5,) if quick else (0.25, 0.5, 1.0):
        settings.append(way("rays through see-through bone", f"step {step:g}", SEE_THROUGH, step_voxels=step))
    for divisor in (2, 3, 4):
        settings.append(way("rays at lower resolution", f"1 / {divisor}", GRADIENT, divisor=divisor))
    for spacing in (1.0,) if quick else (0.5, 1.0, 2.0):
        settings.append(way("slices shaded by gradient", f"spacing {spacing:g}", GRADIENT, renderer="slices", step_voxels=spacing))
        settings.append(way("slices of surface voxels (published)", f"spacing {spacing:g}", SURFACE_VOXELS, renderer="slices",
                            step_voxels=spacing))
    return settings


def cases_of(bones: list[str], size_px: list[int], quick: bool) -> list[dict[str, Any]]:
    """The wall, and the settings of one look, which have a reference together, in each view of a bone."""
    walls: list[dict[str, Any]] = [{"part": "normals"}, *({"part": "wall", "px_per_voxel": px} for px in WALL_PX_PER_VOXEL)]
    looks: list[dict[str, Any]] = []
    for setting in settings_of(quick):
        if setting["look"] not in looks:
            looks.append(setting["look"])
    views = [{"part": "view", "bone": bone, "look": look, "view": view, "size_px": size_px, "quick": quick} for bone in bones
             for look in looks for view in (("overview",) if quick else ("overview", "close-up"))]
    return walls + views


def name_of(case: dict[str, Any]) -> str:
    if case["part"] == "view":
        return f"{case['bone']}, {case['view']}, {settings_in(case)[0]['family']}"
    return f"cut wall at {case['px_per_voxel']:g} pixels a voxel" if case["part"] == "wall" else "normals of a cut wall"


@functools.lru_cache(maxsize=1)
def _bone(name: str, scans: str, folder: pathlib.Path) -> _studies.TrialBone:
    return _studies.TrialBone(name, scans, folder)


def measure(gpu: int | None, out: pathlib.Path, case: dict[str, Any]) -> Any:
    if case["part"] == "normals":
        return _studies.cut_wall_normals_p95_deg()
    if case["part"] == "wall":
        return _studies.cut_wall_psnr_db(case["px_per_voxel"], gpu)
    bone = _bone(case["bone"], os.environ.get("OSTEOMILL_SCANS", ""), out)
    width, height = case["size_px"]
    picture = bone.picture(view=case["view"], size_px=(width, height), gpu=gpu, **case["look"])
    drawn = []
    for setting in settings_in(case):
        is_slow = setting["renderer"] == "slices" or not setting["skips"]  # takes seconds a frame, and is steady enough
        drawn.append(picture.draw(**{key: setting[key] for key in ("renderer", "step_voxels", "skips", "divisor")},
                                  times=0 if is_slow else 3 if case["quick"] else 7))
    return drawn


def settings_in(case: dict[str, Any]) -> list[dict[str, Any]]:
    return [setting for setting in settings_of(case["quick"]) if setting["look"] == case["look"]]


def run_accuracy(options: argparse.Namespace, study: StudyRun, renderer: str) -> None:
    size_px = [options.width_px, 3 * options.width_px // 4] if options.width_px else list(QUICK_SIZE_PX if options.quick else SIZE_PX)
    study.say(f"drawn by {renderer}")
    has_skull = bool(os.environ.get("OSTEOMILL_SCANS")) and not options.quick
    cases = cases_of([TOOTH, SKULL] if has_skull else [TOOTH], size_px, options.quick)
    p95_deg, *rest = study.sweep(functools.partial(measure, options.gpu, study.out), cases, name_of)
    walls, drawn = rest[: len(WALL_PX_PER_VOXEL)], rest[len(WALL_PX_PER_VOXEL) :]
    study.say(f"wall cut by a sphere: normals {p95_deg:.2f} degrees at the 95th percentile (goal: within 1)")
    for px_per_voxel, psnr_db in zip(WALL_PX_PER_VOXEL, walls):
        study.say(f"wall cut by a sphere, {px_per_voxel:g} pixels a voxel: {psnr_db:.1f} dB against the analytic picture (goal: 42)")
    table = table_of(cases[1 + len(WALL_PX_PER_VOXEL) :], drawn)
    for _, row in table[table["is_default"]].iterrows():
        study.say(f"{row['bone']}, {row['view']}: full quality {row['psnr_db']:.1f} dB (goal {FULL_QUALITY_GOAL_DB:g}), SSIM "
                  f"{row['ssim']:.4f}, {row['frame_ms']:.0f} ms a frame of {size_px[0]} x {size_px[1]}")
    if not has_skull:
        study.say("real CT skipped: " + ("--quick" if options.quick else "OSTEOMILL_SCANS does not name the folder of trial scans"))
    study.table("accuracy", table)
    study.json("render", {
        "gl_renderer": renderer,
        "cut_wall": {"p95_deg": p95_deg, "pictures": [{"px_per_voxel": px, "psnr_db": db} for px, db in zip(WALL_PX_PER_VOXEL, walls)]},
        "accuracy": table.to_dict("records")})
    from osteomill.studies.render_charts import accuracy

    study.chart("render_accuracy", accuracy(table, renderer))
    study.say(f"render.json, accuracy.csv and render_accuracy.svg are in {study.out}")


def table_of(cases: list[dict[str, Any]], drawn: list[list[dict[str, float]]]) -> pd.DataFrame:
    """A line a setting; those of the same bone and view together, in the order in which these first come: a panel."""
    told = ("family", "label", "step_voxels", "skips", "divisor")
    rows = [{"panel": f"{case['bone']} {case['view']}", "bone": case["bone"], "view": case["view"], **{key: setting[key] for key in told},
             **its, "is_default": setting["is_default"]}
            for case, of_case in zip(cases, drawn)
            for setting, its in zip(settings_in(case), of_case)]
    table = pd.DataFrame(rows)
    panels = list(dict.fromkeys(table["panel"]))
    table.insert(0, "panel_number", [panels.index(panel) + 1 for panel in table["panel"]])
    return table.sort_values("panel_number", kind="stable", ignore_index=True)
