"""Speed against accuracy of the milling force: the bone that a step visits, the contents of a voxel, the rate, the size of
voxels.

A choice is run through the five motions of studied_motions.py. Its error is that of the mean force against the
analytical reference, mean over motions and over three places of the lattice; its ripple the largest of means over
10 ms. Its time is the median over the steps of one motion, beside the published full scan of the same voxels, the two
in turns in one run.
"""

from typing import Any

import numpy as np
import pandas as pd

from osteomill import _studies
from osteomill.studies.tables import on_front
from osteomill.studies.studied_motions import LATTICE_SHIFTS, error_and_ripple, run_motion, studied_motions

PUBLISHED: dict[str, Any] = {"summation": "bins", "coverage": "binary", "search": "full_scan"}
VOXELS_MM = (0.27, 0.2, 0.16, 0.1, 0.08, 0.05)
DEFAULT_VOXEL_MM = 0.1
RATES_HZ = (25.0, 100.0, 1000.0, 10_000.0)
BURRS_MM = (1.5, 2.0, 3.0, 4.0, 5.0)
EDGES_N_PER_MM = (0.3, 0.3, 0.0)  # as the built-in scenes have them
INSTANTS_RUN_IN_S = 0.03  # thirty tooth periods: they leave e^-30 of the bone that a burr, put into solid bone, removed at once

# Start of each built-in scene: the burr in mm, its speed, and whether its edges rub.
SCENES = {
    "cube": (5.0, 10_000.0, False),
    "tooth": (2.0, 40_000.0, True),
    "head": (3.0, 40_000.0, True),
    "jaw": (1.5, 40_000.0, True),
    "mastoid": (5.0, 60_000.0, True),
}
# Needs of a hand: a change of less than a tenth of a force is not felt (Weber's fraction of force is 7 to 10 %), and the mean is
# to be twice as accurate.
NEEDED_ERROR_PERCENT = 5.0
NEEDED_RIPPLE_PERCENT = 10.0

# Choices by name, and their text in the chart.
FAMILIES = {
    "new smoothed": "new voxels only, smoothed at the surface",
    "new in part": "new voxels only, filled in part",
    "new there or gone": "new voxels only, there or gone",
    "all smoothed": "all voxels of the burr, smoothed",
    "published": "all voxels, there or gone, in bins (published)",
    "bins": "new voxels, smoothed, sorted into bins",
    "map": "new voxels, smoothed, and the map that the hand feels",
    "instants": "new voxels, 10 kHz, edge by edge within the tooth period",
}
MODELS: dict[str, dict[str, Any]] = {
    "new smoothed": {},
    "new in part": {"coverage": "linear"},
    "new there or gone": {"coverage": "binary"},
    "all smoothed": {"search": "full_scan"},
    "published": PUBLISHED,
    "bins": {"summation": "bins"},
    "map": {"map": True},
    "instants": {"summation": "instants"},
}


def _choice(family: str, label: str, **changes: Any) -> dict[str, Any]:
    return {"part": "force", "family": family, "label": label, "model": MODELS[family], "voxel_mm": DEFAULT_VOXEL_MM,
            "milling_rate_hz": 100.0, "burr_mm": 5.0, "rpm": 10_000.0, "edges": False, "varied": "voxels"} | changes


def cases(quick: bool) -> list[dict[str, Any]]:
    """Every choice; quick: the coarser voxels, of fewer burrs."""
    voxels = [mm for mm in VOXELS_MM if not quick or mm >= DEFAULT_VOXEL_MM]
    made = []
    for voxel_mm in voxels:
        for family in ("new smoothed", "new in part", "new there or gone", "all smoothed", "published"):
            made.append(_choice(family, f"{voxel_mm:g} mm", voxel_mm=voxel_mm))
    made.append(_choice("map", "0.1 mm"))
    for psi, z in ((18, 12), (36, 25), (72, 50), (144, 100)):
        made.append(_choice("bins", f"{psi} x {z}", model={"summation": "bins", "bins": (psi, z)}))
    for family in ("new smoothed", "published"):
        for rate_hz in RATES_HZ:
            if not (quick and rate_hz > 1000.0):
                made.append(_choice(family, _hertz(rate_hz), milling_rate_hz=rate_hz, varied="rate"))
    if not quick:
        made.append(_choice("instants", "10 kHz", milling_rate_hz=10_000.0, varied="rate"))
    for family in ("new smoothed", "published"):
        for burr_mm in BURRS_MM[:: 2 if quick else 1]:
            made.append(_choice(family, f"{burr_mm:g} mm", burr_mm=burr_mm, varied="burr"))
    for burr_mm in BURRS_MM[:: 2 if quick else 1]:
        made.append(_choice("new smoothed", f"{burr_mm:g} mm", burr_mm=burr_mm, edges=True, varied="edges"))
    for scene, (burr_mm, rpm, edges) in SCENES.items():
        for voxel_mm in (0.27, 0.2, 0.16, 0.1) if not quick else (0.2, 0.1):
            made.append(_choice("new smoothed", scene, burr_mm=burr_mm, rpm=rpm, edges=edges, voxel_mm=voxel_mm,
                                milling_rate_hz=1000.0, varied="scene"))
    for case in made:
        case["quick"] = quick
    return made


def _hertz(rate_hz: float) -> str:
    return f"{rate_hz / 1000.0:g} kHz" if rate_hz >= 1000.0 else f"{rate_hz:g} Hz"


def measure(case: dict[str, Any]) -> dict[str, float]:
    """Error and ripple in percent; microseconds of a step and of the published one in the same run; share of a core."""
    edges = EDGES_N_PER_MM if case["edges"] else (0.0, 0.0, 0.0)
    motions = studied_motions(0.9 if case["quick"] else 2.4, case["burr_mm"], edges, case["rpm"])
    model = _studies.Milling(**case["model"] | {"bins": tuple(case["model"].get("bins", (72, 50)))})
    # At ten thousand steps a second the force is steady: one offset of the lattice is enough.
    shifts = LATTICE_SHIFTS[:1] if case["quick"] or case["milling_rate_hz"] > 1000.0 else LATTICE_SHIFTS
    error, ripple = error_and_ripple(motions, model, voxel_mm=case["voxel_mm"], milling_rate_hz=case["milling_rate_hz"],
                                     shifts=shifts, run_in_s=INSTANTS_RUN_IN_S if case["family"] == "instants" else 0.0)
    own, scan = run_motion(motions[0], [model, _studies.Milling(**PUBLISHED)], voxel_mm=case["voxel_mm"],
                           milling_rate_hz=case["milling_rate_hz"],
                           lattice_shift_mm=np.multiply(LATTICE_SHIFTS[0], case["voxel_mm"]),
                           most_steps=30 if case["quick"] else 120)
    return {"error_percent": 100.0 * error, "ripple_percent": 100.0 * ripple,
            "step_us": float(np.median(own.step_us)), "published_us": float(np.median(scan.step_us)),
            # A model may wait for some steps and make up for them in others; steps that others interrupted are left out.
            "core_percent": 1e-4 * case["milling_rate_hz"] * float(np.sort(own.step_us)[: -(-49 * len(own.step_us) // 50)].mean())}


def table_of(choices: list[dict[str, Any]], outcomes: list[dict[str, float]]) -> pd.DataFrame:
    """A line a choice. times_faster: than the published step of the same voxels, in the same run; on_front: none of
    the same burr, rate and law is both faster and truer."""
    told = ("varied", "family", "label", "voxel_mm", "milling_rate_hz", "burr_mm", "edges")
    table = pd.DataFrame([{key: case[key] for key in told} | outcome for case, outcome in zip(choices, outcomes)])
    table["times_faster"] = table["published_us"] / table["step_us"]
    table["is_default"] = (table["family"] == "new smoothed") & (table["voxel_mm"] == DEFAULT_VOXEL_MM)
    table["is_published"] = (table["family"] == "published") & (table["voxel_mm"] == DEFAULT_VOXEL_MM)
    table["on_front"] = False
    among = table["varied"] == "voxels"
    table.loc[among, "on_front"] = on_front(table.loc[among, "step_us"], table.loc[among, "error_percent"])
    return table


def needs_of(table: pd.DataFrame) -> pd.DataFrame:
    """For each built-in scene the coarsest voxels that are accurate enough for a hand, with the loss by the next coarser ones."""
    rows = []
    for scene in SCENES:
        tried = table[(table["varied"] == "scene") & (table["label"] == scene)].sort_values("step_us")
        enough = tried[(tried["error_percent"] <= NEEDED_ERROR_PERCENT) & (tried["ripple_percent"] <= NEEDED_RIPPLE_PERCENT)]
        row = (enough if len(enough) else tried).iloc[0 if len(enough) else -1]
        rows.append({"scene": scene, "is_held": bool(len(enough)),
                     **{key: row[key] for key in ("burr_mm", "edges", "voxel_mm", "error_percent", "ripple_percent", "step_us")}})
    return pd.DataFrame(rows)
