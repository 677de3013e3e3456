"""Cost of a whole frame at full quality, against the voxels of the bone and the pixels of the window.

By voxels: a cube of bone, seen whole at 640 x 480, of so many voxels along an edge. By pixels: the tooth. Times are medians of
several frames; with slices, of one.
"""

from typing import TYPE_CHECKING, Any

import pandas as pd

from osteomill import _studies
from osteomill.studies.tradeoff_picture import TRIED_SCENE, case_named

if TYPE_CHECKING:
    from matplotlib.figure import Figure

EDGES_VOXELS = (64, 96, 128, 192, 256, 384)
CUBE_MM = 20.0
WINDOWS_PX = ((160, 120), (320, 240), (640, 480), (960, 720), (1280, 960))
SIZE_PX, QUICK_SIZE_PX = (640, 480), (160, 120)

# Drawings by name, with their text.
DRAWN = {
    "rays": ("raycast", "gradient", "rays shaded by gradient (default)"),
    "surface voxels": ("raycast", "surface-voxels", "rays to surface voxels"),
    "slices": ("slices", "surface-voxels", "slices of surface voxels (published)"),
}


def cases(quick: bool) -> list[dict[str, Any]]:
    """Belong to the scene whose bone they draw, if any, so that it is made once."""
    edges, windows = (EDGES_VOXELS[::3], WINDOWS_PX[:2]) if quick else (EDGES_VOXELS, WINDOWS_PX)
    made = []
    for drawn in list(DRAWN)[: 2 if quick else None]:
        shared = {"part": "scaling", "scene": TRIED_SCENE, "drawn": drawn, "quick": quick}
        made += [shared | {"window_px": list(window)} for window in windows]
        made += [shared | {"edge_voxels": edge} for edge in edges]
    return made


def measure(case: dict[str, Any]) -> dict[str, Any]:
    renderer, shading, _ = DRAWN[case["drawn"]]
    times = 0 if renderer == "slices" else 3 if case["quick"] else 7
    if "window_px" in case:
        width_px, height_px = case["window_px"]
        frame_ms = _studies.frame_ms(case_named(case["scene"]), shading=shading, renderer=renderer, size_px=(width_px, height_px),
                                     times=times)
    else:
        block = _studies.Block.cube(case["edge_voxels"], CUBE_MM / case["edge_voxels"])
        size_px = QUICK_SIZE_PX if case["quick"] else SIZE_PX
        frame_ms = _studies.frame_ms(block, shading=shading, renderer=renderer, size_px=size_px, times=times)
    return {"frame_ms": frame_ms}


def table_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    return pd.DataFrame([{"drawn": case["drawn"], "edge_voxels": case.get("edge_voxels"),
                          "thousand_px": case["window_px"][0] * case["window_px"][1] / 1000.0 if "window_px" in case else None} | found
                         for case, found in zip(choices, outcomes)])


def chart_of(table: pd.DataFrame) -> "Figure":
    from osteomill.studies import charts
    from osteomill.studies.tradeoff_marks import plain_decades

    looks = {"rays": (charts.BLUE, "o"), "surface voxels": (charts.GREEN, "^"), "slices": (charts.AMBER, "s")}
    figure = charts.figure(10.0, 4.8)
    figure.suptitle("A whole frame at full quality, against what it shows and where")
    for axes, column, label in zip(figure.subplots(1, 2), ("edge_voxels", "thousand_px"),
                                   ("a cube of bone: voxels an edge", "the tooth: thousands of pixels")):
        for drawn, (_, _, title) in DRAWN.items():
            colour, marker = looks[drawn]
            rows = table[(table["drawn"] == drawn) & table[column].notna()]
            if len(rows):
                axes.plot(rows[column], rows["frame_ms"], color=colour, marker=marker, label=title)
        axes.set(xscale="log", yscale="log", xlabel=label, ylabel="time of a frame (median), ms")
        at = sorted(set(table[column].dropna()))
        axes.set_xticks(at, [f"{value:.3g}" if value < 1000 else f"{value:.0f}" for value in at])
        axes.set_xticks([], minor=True)
        plain_decades(axes.yaxis)
    axes.legend()
    return figure
