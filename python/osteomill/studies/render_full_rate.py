"""Full rate: frames a second that a graphics card draws in full quality, in a large window, with the cost of uploading a carve
and the memory of the textures.

Tooth and head, orbiting and carving, tool and panels drawn, each frame finished before the next begins; two eyes beside
one. On a software rasteriser less of everything, and it says so.
"""

import argparse
import functools
import pathlib
from typing import Any

import numpy as np
import pandas as pd

from osteomill import _studies
from osteomill.studies.study_run import StudyRun

PHANTOMS = ("tooth", "head")
FULL_SIZE_PX, SOFTWARE_SIZE_PX = (2560, 1440), (640, 360)
FULL_FRAMES, SOFTWARE_FRAMES = 600, 8
UPLOADS = 50
#: Keys of the drawn motions, and their names in table and chart.
MOTIONS = {"orbit": "orbit", "carve": "carve", "orbit_side_by_side": "orbit side by side", "orbit_both_whole": "orbit quad buffer"}


def measure(gpu: int | None, out: pathlib.Path, case: dict[str, Any]) -> dict[str, Any]:
    phantom = case["phantom"]
    if case["part"] == "uploads":
        return _studies.upload_carves(phantom, case["times"], gpu)
    width, height = case["size_px"]
    return _studies.draw_window(phantom, (width, height), case["frames"], out / f"window_{phantom}.png", gpu)


def run(options: argparse.Namespace, study: StudyRun, renderer: str, is_software: bool) -> None:
    size_px = options.size_px or list(SOFTWARE_SIZE_PX if is_software else FULL_SIZE_PX)
    frames = options.frames or (SOFTWARE_FRAMES if is_software else FULL_FRAMES)
    for line in lines_before(renderer, is_software, size_px, frames, bool(options.size_px and options.frames)):
        study.say(line)
    cases = [{"part": "uploads", "phantom": phantom, "times": UPLOADS} for phantom in PHANTOMS]
    cases += [{"part": "window", "phantom": phantom, "size_px": size_px, "frames": frames} for phantom in PHANTOMS]
    found = study.sweep(functools.partial(measure, options.gpu, study.out), cases, lambda case: f"{case['phantom']}, {case['part']}")
    uploads, drawn = (dict(zip(PHANTOMS, its)) for its in (found[: len(PHANTOMS)], found[len(PHANTOMS) :]))
    for phantom, upload in uploads.items():
        for line in lines_of_upload(phantom, upload, renderer):
            study.say(line)
    table = table_of(drawn, size_px, renderer)
    study.say("")
    study.say(f"{'bone':<7}{'motion':<21}{'frames/s':>10}{'p50 ms':>9}{'p99 ms':>9}{'GPU ms':>9}{'CPU ms':>9}  GL renderer")
    for _, row in table.iterrows():
        study.say(f"{row['bone']:<7}{row['motion']:<21}{row['frames_per_s']:>10.1f}{row['p50_ms']:>9.2f}{row['p99_ms']:>9.2f}"
                  f"{row['gpu_p50_ms']:>9.2f}{row['cpu_p50_ms']:>9.2f}  {renderer}")
    eyes = {phantom: two_eyes_to_one(table, phantom) for phantom in PHANTOMS}
    for phantom, times in eyes.items():
        study.say(f"{phantom}: two eyes take {times['side_by_side']:.2f} times one eye's time side by side, {times['quad_buffer']:.2f} "
                  "times in a quad buffer, where each has all pixels (goal: below 1.7)")
    study.table("full_rate", table)
    study.json("full_rate", {
        "gl_renderer": renderer, "is_software_renderer": is_software, "size_px": size_px, "frames_of_a_row": frames,
        "bones": {phantom: figures_of(upload) for phantom, upload in uploads.items()}, "rows": table.to_dict("records"),
        "two_eyes_to_one": eyes})
    from osteomill.studies import render_charts

    of_uploads = table_of_uploads(uploads)
    study.table("uploads", of_uploads)
    study.chart("render_full_rate", render_charts.full_rate(table, renderer))
    study.chart("render_uploads", render_charts.uploads(of_uploads, renderer))
    study.say(f"full_rate.json, full_rate.csv, uploads.csv, their charts and pictures (PNG) are in {study.out}")


def lines_before(renderer: str, is_software: bool, size_px: list[int], frames: int, is_told: bool) -> list[str]:
    lines = [f"drawn by {renderer}, {size_px[0]} x {size_px[1]}, {frames} frames a row, every pixel at full quality, each frame "
             "finished before the next"]
    if is_software:
        lines.append("no GPU: a software rasteriser draws, and the goals are not for it")
    if is_software and not is_told:
        width, height = FULL_SIZE_PX
        lines.append(f"reduced for it from {width} x {height} and {FULL_FRAMES} frames a row; for all pixels and frames: --size-px "
                     f"{width}x{height} --frames {FULL_FRAMES}")
    return lines


def lines_of_upload(phantom: str, upload: dict[str, Any], renderer: str) -> list[str]:
    parts = ", ".join(f"{name} {size / 2**20:.0f}" for name, size in upload["textures"].items())
    itself = ", of the bone itself" if upload["times_coarser"] == 1 else ""
    of_frame, of_ball = upload["upload_of_frame"]["wall_ms"], upload["upload_of_5_mm_ball"]["wall_ms"]
    return [f"{phantom}: {upload['description']}{itself} ({parts} MiB)",
            f"{phantom}: upload of what the 5 mm burr cuts in a frame {np.median(of_frame):.3f} ms, p99 {np.percentile(of_frame, 99):.3f}; "
            f"of a ball of 5 mm at once, {upload['bricks_of_5_mm_ball']} bricks, {np.median(of_ball):.3f} ms (goal on a GPU: below 0.2; "
            f"{renderer})"]


def figures_of(upload: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in upload.items() if key != "description"}


def table_of(drawn: dict[str, Any], size_px: list[int], renderer: str) -> pd.DataFrame:
    """A row a bone and motion."""
    rows = []
    for phantom, its in drawn.items():
        for key, motion in MOTIONS.items():
            wall, gpu, cpu = (its[key][clock] for clock in ("wall_ms", "gpu_ms", "cpu_ms"))
            rows.append({"bone": phantom, "motion": motion, "width_px": size_px[0], "height_px": size_px[1], "frames": len(wall),
                         "frames_per_s": 1e3 * len(wall) / sum(wall), "p50_ms": float(np.median(wall)),
                         "p99_ms": float(np.percentile(wall, 99)), "gpu_p50_ms": float(np.median(gpu)),
                         "gpu_p99_ms": float(np.percentile(gpu, 99)), "cpu_p50_ms": float(np.median(cpu)), "gl_renderer": renderer})
    return pd.DataFrame(rows)


def table_of_uploads(uploads: dict[str, Any]) -> pd.DataFrame:
    """A row an upload."""
    kinds = {"upload_of_frame": "what the 5 mm burr cuts in a frame", "upload_of_5_mm_ball": "a ball of 5 mm at once"}
    return pd.DataFrame([{"bone": phantom, "cut": cut, "upload_ms": ms}
                         for phantom, upload in uploads.items() for key, cut in kinds.items() for ms in upload[key]["wall_ms"]])


def two_eyes_to_one(table: pd.DataFrame, phantom: str) -> dict[str, float]:
    of_motion = table[table["bone"] == phantom].set_index("motion")["p50_ms"]
    one_ms = of_motion["orbit"]
    return {"side_by_side": float(of_motion["orbit side by side"] / one_ms), "quad_buffer": float(of_motion["orbit quad buffer"] / one_ms)}
