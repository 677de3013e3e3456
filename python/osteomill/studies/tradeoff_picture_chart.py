"""The charts of pictures: milliseconds of a frame against the peak signal-to-noise ratio, which grows downwards."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes

from osteomill.studies import charts
from osteomill.studies.tradeoff_marks import DEFAULT_RING, FRONT_LINE, NEEDED_LINE, SCENE_STAR, label_points, plain_decades
from osteomill.studies.tradeoff_picture import FAMILIES, NEEDED_PSNR_DB

LOOKS: dict[str, dict[str, Any]] = {
    "rays": {"color": charts.BLUE, "marker": "o"},
    "raw normals": {"color": charts.SKY, "marker": "X"},
    "surface voxels": {"color": charts.GREEN, "marker": "^", "markerfacecolor": "white"},
    "every sample": {"color": charts.RED, "marker": "s"},
    "coarser": {"color": charts.PINK, "marker": "v"},
    "slices": {"color": charts.GREY, "marker": "P"},
    "published": {"color": charts.AMBER, "marker": "s", "markerfacecolor": "white"},
}


def draw_pictures(ways: Axes, scenes: Axes, picture: pd.DataFrame, needs: pd.DataFrame) -> None:
    draw_ways(ways, picture)
    ways.legend(loc="upper right", fontsize=9)
    _draw_scenes(scenes, picture, needs)


def draw_ways(axes: Axes, picture: pd.DataFrame) -> None:
    tried = picture[picture["varied"] == "way"]
    for family, title in FAMILIES.items():
        rows = tried[tried["family"] == family]
        if len(rows):
            axes.plot(rows["frame_ms"], rows["psnr_db"], label=title, **LOOKS[family])
    front = tried[tried["on_front"]].sort_values("frame_ms")
    axes.plot(front["frame_ms"], front["psnr_db"], **FRONT_LINE)
    default = tried[tried["is_default"]]
    axes.plot(default["frame_ms"], default["psnr_db"], label="the default", **DEFAULT_RING)
    _finish(axes)
    size_px = f"{tried['width_px'].iloc[0]} x {tried['height_px'].iloc[0]}"
    axes.set_title(f"Picture of the tooth, {size_px}: along a line samples lie {_steps_of(tried)} voxels apart, or\n"
                   "the picture is a half, a third, a quarter as wide", fontsize=10)


def _steps_of(tried: pd.DataFrame) -> str:
    return ", ".join(f"{step:g}" for step in sorted(set(tried["step_voxels"])))


def _draw_scenes(axes: Axes, picture: pd.DataFrame, needs: pd.DataFrame) -> None:
    tried = picture[picture["varied"] == "scene"]
    for (scene, view), rows in tried.groupby(["scene", "view"], sort=False):
        rows = rows[rows["family"] == "rays"].sort_values("frame_ms")
        axes.plot(rows["frame_ms"], rows["psnr_db"], color=charts.BLUE if view == "overview" else charts.SKY,
                  marker="o" if view == "overview" else "X", label=view if scene == tried["scene"].iloc[0] else "_")
    default = tried[tried["is_default"]]
    axes.plot(default["frame_ms"], default["psnr_db"], label="the default", **DEFAULT_RING)
    axes.plot(needs["frame_ms"], needs["psnr_db"], label="fastest that a scene needs, its dearer view", **SCENE_STAR)
    _finish(axes)
    worst_db, best_db = axes.get_ylim()[::-1]
    axes.set_ylim(best_db, worst_db - 0.35 * (best_db - worst_db))  # free of points, for the legend
    label_points(axes, needs["frame_ms"], needs["psnr_db"], [f"{row['scene']}, {way_in_words(row)}" for _, row in needs.iterrows()])
    axes.legend(loc="upper right", fontsize=9)
    axes.set_title("Pictures of the built-in scenes: rays, samples 0.5, 1 and 2 voxels apart", fontsize=10)


def way_in_words(row: Any) -> str:
    """Text for a row of needs."""
    return f"1/{row['divisor']:.0f} as wide" if row["divisor"] > 1 else f"samples {row['step_voxels']:g} apart"


def _finish(axes: Axes) -> None:
    axes.axhline(NEEDED_PSNR_DB, **NEEDED_LINE)
    axes.set(xscale="log", xlabel="time of a frame (median), ms", ylabel="PSNR against the reference image, dB")
    plain_decades(axes.xaxis)
    axes.margins(x=0.12, y=0.12)
    axes.invert_yaxis()
