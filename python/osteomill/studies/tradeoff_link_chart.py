"""The charts of the link: bytes a second against the voxels in which the client's bone differs, and against its age."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes

from osteomill.studies import charts
from osteomill.studies.tradeoff_link import FAMILIES, NEEDED_DELAY_MS, WIDE_BYTES_PER_S
from osteomill.studies.tradeoff_marks import DEFAULT_RING, FRONT_LINE, NEEDED_LINE, SCENE_STAR, WHITE_GROUND, label_points, loglog

LOOKS: dict[str, dict[str, Any]] = {
    "changes": {"color": charts.BLUE, "marker": "o"},
    "bricks": {"color": charts.RED, "marker": "s"},
    "poses": {"color": charts.GREEN, "marker": "^", "markerfacecolor": "white"},
}


def draw_links(voxels: Axes, delay: Axes, link: pd.DataFrame, needs: pd.DataFrame) -> None:
    draw_contents(voxels, link)
    voxels.legend(loc="upper right", fontsize=9)
    _draw_delays(delay, link, needs)


def draw_contents(axes: Axes, link: pd.DataFrame) -> None:
    tried = link[link["varied"] == "content"]
    for content, title in FAMILIES.items():
        rows = tried[tried["content"] == content].sort_values("frame_rate_hz")
        left = int(rows["differing_voxels_left"].max())
        its = f"{title}; {'none' if left == 0 else f'up to {left}'} differ in the end"
        axes.plot(rows["bytes_per_s"] / 1000.0, rows["differing_voxels_mean"], label=its, **LOOKS[content])
        if content == "changes":
            for _, row in rows.iterrows():
                axes.annotate(f"{row['frame_rate_hz']:g}", (row["bytes_per_s"] / 1000.0, row["differing_voxels_mean"]), xytext=(2, -15),
                              textcoords="offset points", fontsize=9, bbox=WHITE_GROUND)
    front = tried[tried["on_front"]].sort_values("bytes_per_s")
    axes.plot(front["bytes_per_s"] / 1000.0, front["differing_voxels_mean"], **FRONT_LINE)
    default = tried[tried["is_default"]]
    axes.plot(default["bytes_per_s"] / 1000.0, default["differing_voxels_mean"], label="the default", **DEFAULT_RING)
    loglog(axes, "sent, kB/s", "voxels that differ at the client, mean")
    axes.margins(y=0.3)
    rates = ", ".join(f"{rate:g}" for rate in sorted(set(tried["frame_rate_hz"])))
    axes.set_title(f"Link: milling the tooth, {rates} frames a second", fontsize=10)


def _draw_delays(axes: Axes, link: pd.DataFrame, needs: pd.DataFrame) -> None:
    for content, rows in link[link["varied"] == "content"].groupby("content", sort=False):
        axes.plot(rows["bytes_per_s"] / 1000.0, rows["delay_mean_ms"], **LOOKS[str(content)])
    narrow = link[link["varied"] == "width"]
    axes.plot(narrow["bytes_per_s"] / 1000.0, narrow["delay_mean_ms"], color=charts.PINK, marker="v", linestyle="none",
              label=f"the default over a link of {', '.join(f'{0.008 * width:g}' for width in narrow['link_bytes_per_s'])} kbit/s")
    for scene, rows in link[link["varied"] == "scene"].groupby("scene", sort=False):
        axes.plot(rows["bytes_per_s"] / 1000.0, rows["delay_mean_ms"], color=charts.GREY, linewidth=0.8, zorder=1)
    default = link[link["is_default"] & (link["varied"] == "content")]
    axes.plot(default["bytes_per_s"] / 1000.0, default["delay_mean_ms"], label="the default", **DEFAULT_RING)
    axes.axhline(NEEDED_DELAY_MS, **NEEDED_LINE)
    axes.plot(needs["bytes_per_s"] / 1000.0, needs["delay_mean_ms"], label="fewest frames that a built-in scene needs", **SCENE_STAR)
    loglog(axes, "sent, kB/s", "age of what the client shows, mean, ms")
    label_points(axes, needs["bytes_per_s"] / 1000.0, needs["delay_mean_ms"],
                 [f"{row['scene']}, {row['frame_rate_hz']:g} Hz" for _, row in needs.iterrows()])
    axes.legend(loc="upper right", fontsize=9)
    axes.set_title(f"Link: age of the picture's bone, {0.008 * WIDE_BYTES_PER_S / 1000.0:g} Mbit/s and 1 ms away unless said", fontsize=10)
