"""Speed against accuracy of the picture: renderer, distance of the samples, resolution, and source of normals.

A choice draws one view of a bone, offscreen, on this machine's GPU or, without one, by Mesa's software rasteriser. Its error is
the peak signal-to-noise ratio against the reference image of the same look, rays in steps of a tenth of a voxel in double
precision; both without the cues that stand in tradeoff_cues.py. Its time is the median of several frames; of a frame that takes
seconds, only the first counts.
"""

import functools
from typing import Any

import pandas as pd

from osteomill import Case, _studies
from osteomill.studies.tables import on_front

TRIED_SCENE = "tooth"
SIZE_PX, QUICK_SIZE_PX = (640, 480), (200, 150)
DEFAULT_STEP_VOXELS = 0.5
NEEDED_PSNR_DB = 40.0  # as the documents promise of the default

# Choices by name, with their text in the chart.
FAMILIES = {
    "rays": "rays, a normal from 8 smoothed samples",
    "raw normals": "rays, a normal from 64 samples",
    "surface voxels": "rays to surface voxels, lit once each",
    "every sample": "rays that skip nothing",
    "coarser": "rays at a lower resolution",
    "slices": "slices, lit in every pixel",
    "published": "slices of surface voxels (published)",
}
WAYS: dict[str, dict[str, Any]] = {
    "rays": {},
    "raw normals": {"smoothed_normals": False},
    "surface voxels": {"shading": "surface-voxels"},
    "every sample": {"skips": False},
    "coarser": {},
    "slices": {"renderer": "slices"},
    "published": {"renderer": "slices", "shading": "surface-voxels"},
}
# Options of render_client: --renderer and --shading; and its own measures when time is short, or one sample a voxel.
SCENE_WAYS: tuple[dict[str, Any], ...] = ({}, {"step_voxels": 1.0}, {"step_voxels": 2.0}, {"divisor": 2})


def _choice(scene: str, family: str, label: str, quick: bool, **changes: Any) -> dict[str, Any]:
    return {"part": "picture", "scene": scene, "family": family, "label": label, "varied": "way", "quick": quick,
            "view": "overview", "shading": "gradient", "smoothed_normals": True, "renderer": "raycast",
            "step_voxels": DEFAULT_STEP_VOXELS, "skips": True, "divisor": 1} | WAYS[family] | changes


def cases(scenes: "list[str]", quick: bool) -> list[dict[str, Any]]:
    """Cases of one look follow one another: they share textures and a reference image."""
    def steps(family: str, *voxels: float) -> list[dict[str, Any]]:
        return [_choice(TRIED_SCENE, family, f"{step:g}", quick, step_voxels=step) for step in voxels]

    made = steps("rays", 0.5, 1.0, 2.0) if quick else steps("rays", 0.25, 0.5, 1.0, 2.0)
    made += [_choice(TRIED_SCENE, "coarser", f"1/{divisor}", quick, divisor=divisor) for divisor in (2, 3, 4)]
    made += steps("every sample", *([2.0] if quick else [0.5, 1.0, 2.0]))
    made += steps("slices", *([2.0] if quick else [0.5, 1.0, 2.0]))
    made += steps("surface voxels", *([0.5] if quick else [0.25, 0.5, 1.0, 2.0]))
    made += steps("published", *([2.0] if quick else [0.5, 1.0, 2.0]))
    made += steps("raw normals", *([0.5] if quick else [0.25, 0.5, 1.0, 2.0]))
    for scene in scenes:
        if scene in TOO_LARGE:
            continue
        for view in ("overview",) if quick else ("overview", "close-up"):
            for way in SCENE_WAYS:
                label = f"1/{way['divisor']}" if "divisor" in way else f"{way.get('step_voxels', DEFAULT_STEP_VOXELS):g}"
                made.append(_choice(scene, "coarser" if "divisor" in way else "rays", label, quick, varied="scene", view=view, **way))
    return made


# The reference picture of this bone takes more memory than a desk has, over 20 GB.
TOO_LARGE = ("head",)


@functools.lru_cache(1)
def case_named(scene: str) -> Case:
    """The last one stays: a bone may take a gigabyte."""
    return Case(scene)


@functools.lru_cache(1)
def trial_of(scene: str, view: str, shading: str, size_px: tuple[int, int], smoothed_normals: bool) -> _studies.PictureTrial:
    return _studies.PictureTrial(case_named(scene), view=view, shading=shading, size_px=size_px, smoothed_normals=smoothed_normals)


def measure(case: dict[str, Any]) -> dict[str, Any]:
    trial = trial_of(case["scene"], case["view"], case["shading"], QUICK_SIZE_PX if case["quick"] else SIZE_PX, case["smoothed_normals"])
    is_slow = case["renderer"] == "slices" or not case["skips"]
    drawn = trial.draw(renderer=case["renderer"], step_voxels=case["step_voxels"], skips=case["skips"], divisor=case["divisor"],
                       times=0 if is_slow else 3 if case["quick"] else 9)
    return {key: drawn[key] for key in ("frame_ms", "psnr_db", "ssim")} | {"gl_renderer": trial.gl_renderer}


def table_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    """A line for each choice; on_front: no other of the same view is both faster and more accurate."""
    told = ("varied", "scene", "view", "family", "label", "step_voxels", "divisor")
    table = pd.DataFrame([{key: case[key] for key in told} | outcome for case, outcome in zip(choices, outcomes)])
    table["width_px"], table["height_px"] = QUICK_SIZE_PX if choices[0]["quick"] else SIZE_PX
    table["is_default"] = (table["family"] == "rays") & (table["step_voxels"] == DEFAULT_STEP_VOXELS)
    table["is_published"] = table["family"] == "published"
    table["on_front"] = False
    among = table["varied"] == "way"
    table.loc[among, "on_front"] = on_front(table.loc[among, "frame_ms"], -table.loc[among, "psnr_db"])
    return table


def needs_of(table: pd.DataFrame) -> pd.DataFrame:
    """For each scene the fastest way that is accurate enough in every view."""
    rows = []
    tried = table[table["varied"] == "scene"]
    for scene, of_scene in tried.groupby("scene", sort=False):
        ways = of_scene.groupby(["family", "step_voxels", "divisor"], sort=False).agg({"frame_ms": "max", "psnr_db": "min"}).reset_index()
        ways = ways.sort_values("frame_ms")
        enough = ways[ways["psnr_db"] >= NEEDED_PSNR_DB]
        best = enough.iloc[0] if len(enough) else ways.loc[ways["psnr_db"].idxmax()]
        rows.append({"scene": scene, "is_held": bool(len(enough)), **best.to_dict()})
    return pd.DataFrame(rows)
