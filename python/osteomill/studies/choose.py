"""Choice of no more than a scene needs: the cheapest settings with which force and picture of a case are true enough, on this
machine.

choose_milling.py and choose_picture.py each say what they measure and what counts. `scene.toml` is the case's scene behind a
block with the settings, as the programs' options, and the loss by the next cheaper one.
"""

import argparse
import functools
import os
from typing import Any

from osteomill import Case, _studies
from osteomill.studies import choose_milling, choose_picture
from osteomill.studies.choose_milling import Choice, Errors, Way
from osteomill.studies.choose_picture import PictureChoice
from osteomill.studies.options import number_above_zero
from osteomill.studies.study_run import StudyRun
from osteomill.studies.text import printable

NAME = "choose"
HELP = "the cheapest settings that are true enough for a case, measured on this machine"
JOBS = 1  # it measures times
ONE_BY_ONE = True
IS_REPEATED = False  # its choice depends on times
WRITES = ("choice.json", "scene.toml")

IN_WORDS = {"voxel_mm": "voxels", "milling_rate_hz": "the milling rate", "force_model": "the force model", "coupling": "the coupling"}


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--case", required=True, metavar="NAME|DIR", help="a case that is built in, or the folder of one")
    parser.add_argument("--force-error", type=number_above_zero, default=5.0, metavar="PERCENT",
                        help="of the mean force, at most (%(default)s)")
    parser.add_argument("--peak-error", type=number_above_zero, default=10.0, metavar="PERCENT",
                        help="of the largest force over 10 ms, at most (%(default)s)")
    parser.add_argument("--frame-ms", type=number_above_zero, default=16.0, metavar="MS", help="of a frame, at most (%(default)s)")
    parser.add_argument("--quick", action="store_true", help="fewer choices, shorter runs: a minute or two")


@functools.lru_cache(1)
def _case(name: str) -> Case:
    """A folder by its whole path, so that the written scene finds its files from everywhere."""
    return Case(os.path.abspath(name) if os.path.isdir(name) else name)


def measure(asked: dict[str, Any]) -> dict[str, Any]:
    case = _case(asked["case"])
    if asked["part"] == "milling":
        return _told_of_milling(choose_milling.choose(case, Errors(asked["force_error"], asked["peak_error"]), asked["quick"]))
    return _told_of_picture(choose_picture.truest(choose_picture.measure(case, asked["quick"]), asked["frame_ms"]), asked["quick"])


def run(options: argparse.Namespace, study: StudyRun) -> None:
    shared = {"case": options.case, "quick": options.quick}
    milling, picture = study.sweep(
        measure,
        [shared | {"part": "milling", "force_error": options.force_error, "peak_error": options.peak_error},
         shared | {"part": "picture", "frame_ms": options.frame_ms}],
        lambda asked: f"{asked['case']}, {asked['part']}")
    case = _case(options.case)
    lines = lines_of(case, options, milling, picture)
    study.json("choice", {"case": options.case, "bone_voxel_mm": case.bone.spacing_mm, "milling": milling, "picture": picture})
    study.text("scene.toml", "".join(f"# {line}\n" if line else "#\n" for line in lines) + "\n" + _studies.scene_text(case))
    for line in lines:
        study.say(line)
    study.say(f"choice.json and scene.toml are in {study.out}")


def lines_of(case: Case, options: argparse.Namespace, milling: dict[str, Any], picture: dict[str, Any]) -> list[str]:
    """The block for the scene file."""
    way = milling["way"]
    held = "holds" if milling["is_held"] else "NONE holds; the truest tried misses"
    lines = [
        f"Chosen for {printable(options.case)}: {held} {options.force_error:g} % of the mean force and {options.peak_error:g} % "
        "of its peaks",
        f"({milling['error_percent']:.2g} and {milling['peak_percent']:.2g} %), at {milling['core_percent']:.2g} % of a core; "
        f"{milling['tried']} ways were tried, cheapest first.",
        "",
        f"  haptic_server --force-model {way['force_model']} --coupling {way['coupling']} --milling-rate-hz {way['milling_rate_hz']:g}",
        f"  bone_import ... --spacing-mm {way['voxel_mm']:g}    (this bone has {case.bone.spacing_mm:g})",
        f"  render_client {' '.join(picture['options'])}",
        ""]
    for setting, lost in milling["lost"].items():
        lines.append(f"Cheaper by {IN_WORDS[setting]}, {_value(setting, lost['value'])}: {lost['error_percent']:.2g} % of the mean, "
                     f"{lost['peak_percent']:.2g} % of the peaks.")
    lines.append(f"Picture: {picture['frame_ms']:.3g} ms a frame of {options.frame_ms:g}, {picture['psnr_db']:.3g} dB."
                 + ("" if picture["is_held"] else " NOT in time: the fastest that was tried."))
    if picture["next_faster"]:
        faster = picture["next_faster"]
        lines.append(f"The next faster, {' '.join(faster['options'])}: {faster['frame_ms']:.3g} ms, {faster['psnr_db']:.3g} dB.")
    return lines


def _value(setting: str, value: Any) -> str:
    return {"voxel_mm": f"{value} mm", "milling_rate_hz": f"{value} Hz"}.get(setting, str(value))


def _told_of_milling(choice: Choice) -> dict[str, Any]:
    def told(way: Way, errors: Errors) -> dict[str, Any]:
        return {"error_percent": errors.error_percent, "peak_percent": errors.peak_percent}

    return {"way": {"voxel_mm": choice.way.voxel_mm, "milling_rate_hz": choice.way.milling_rate_hz,
                    "force_model": choice.way.force_model, "coupling": choice.way.coupling},
            **told(choice.way, choice.errors), "core_percent": choice.core_percent, "is_held": choice.is_held, "tried": choice.tried,
            "lost": {setting: {"value": getattr(way, setting), **told(way, errors)} for setting, (way, errors) in choice.lost.items()}}


def _told_of_picture(choice: PictureChoice, quick: bool) -> dict[str, Any]:
    size_px = choose_picture.size_px(quick)
    faster = choice.next_faster
    return {"options": choice.drawing.options(size_px), "frame_ms": choice.drawn.frame_ms, "psnr_db": choice.drawn.psnr_db,
            "is_held": choice.is_held,
            "next_faster": faster and {"options": faster[0].options(size_px), "frame_ms": faster[1].frame_ms, "psnr_db": faster[1].psnr_db}}
