"""The study `tradeoff` at a glance: a panel a part, with the published method, the default and the front of the best."""

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from osteomill.studies import charts
from osteomill.studies.tradeoff_force import NEEDED_ERROR_PERCENT
from osteomill.studies.tradeoff_link import FAMILIES as CONTENTS
from osteomill.studies.tradeoff_link_chart import LOOKS as CONTENT_LOOKS
from osteomill.studies.tradeoff_marks import DEFAULT_RING, FRONT_LINE, NEEDED_LINE, SCENE_STAR, loglog, plain_decades
from osteomill.studies.tradeoff_page import LOOKS as FORCE_LOOKS
from osteomill.studies.tradeoff_picture import NEEDED_PSNR_DB
from osteomill.studies.tradeoff_picture_chart import LOOKS as PICTURE_LOOKS


def overview_of(tables: dict[str, pd.DataFrame]) -> Figure:
    """Wide enough for a page that shows it 800 pixels wide."""
    page = charts.figure(11.0, 9.6)
    page.suptitle("Cost against error of each choice: the best is at the lower left")
    (force, coupling), (picture, link) = page.subplots(2, 2)
    _draw_force(force, tables["force"], tables["needs"])
    _draw_coupling(coupling, tables["coupling"])
    _draw_picture(picture, tables["picture"], tables["picture_needs"])
    _draw_link(link, tables["link"])
    return page


def _draw_force(axes: Axes, table: pd.DataFrame, needs: pd.DataFrame) -> None:
    tried = table[table["varied"] == "voxels"]
    for family, title in (("published", "published"), ("all smoothed", "smoothed"), ("new smoothed", "smoothed, new voxels only")):
        rows = tried[tried["family"] == family]
        axes.plot(rows["step_us"], rows["error_percent"], label=title, **FORCE_LOOKS[family])
    axes.plot(needs["step_us"], needs["error_percent"], label="what a built-in scene needs", **SCENE_STAR)
    _mark(axes, tried, "step_us", "error_percent")
    axes.axhline(NEEDED_ERROR_PERCENT, **NEEDED_LINE)
    loglog(axes, "time of a milling step, us", "error of the mean force, %")
    axes.set_ylim(top=200.0)
    axes.legend(loc="upper right", fontsize=10)
    axes.set_title("Force: voxels of 0.27 to 0.05 mm")


def _draw_coupling(axes: Axes, table: pd.DataFrame) -> None:
    tried = table.dropna(subset=["rms_error_percent"])
    others = tried[~tried["is_published"] & ~tried["is_default"]]
    axes.plot(others["tick_us"], others["rms_error_percent"], color=charts.GREY, marker="o", linestyle="none", label="others")
    for mark, colour, name in (("is_published", charts.AMBER, "published"), ("is_default", charts.BLUE, "default")):
        for _, row in tried[tried[mark]].iterrows():
            axes.plot([row["tick_us"]], [row["rms_error_percent"]], color=colour, marker="s" if mark == "is_published" else "o",
                      linestyle="none", label=f"{name}: {row['method']}, stable in {row['stable_percent']:.0f} % of the range")
    _mark(axes, tried, "tick_us", "rms_error_percent")
    loglog(axes, "time of a haptic tick, us", "error of the force in time, %")
    axes.set_ylim(top=100.0)
    axes.legend(loc="upper right", fontsize=10)
    axes.set_title("Coupling between model and hand")


def _draw_picture(axes: Axes, table: pd.DataFrame, needs: pd.DataFrame) -> None:
    tried = table[table["varied"] == "way"]
    for family, title in (("published", "published"), ("coarser", "lower resolution"), ("rays", "rays, 0.25 to 2 voxels a sample")):
        rows = tried[tried["family"] == family]
        axes.plot(rows["frame_ms"], rows["psnr_db"], label=title, **PICTURE_LOOKS[family])
    axes.plot(needs["frame_ms"], needs["psnr_db"], label="what a built-in scene needs", **SCENE_STAR)
    _mark(axes, tried, "frame_ms", "psnr_db")
    axes.axhline(NEEDED_PSNR_DB, **NEEDED_LINE)
    axes.set(xscale="log", xlabel="time of a frame, ms", ylabel="PSNR, dB: better below")
    plain_decades(axes.xaxis)
    axes.set_ylim(tried["psnr_db"].max() + 5.0, tried["psnr_db"].min() - 30.0)
    axes.legend(loc="upper right", fontsize=10)
    axes.set_title(f"Picture, {tried['width_px'].iloc[0]} x {tried['height_px'].iloc[0]}, on the CPU")


def _draw_link(axes: Axes, table: pd.DataFrame) -> None:
    tried = table[table["varied"] == "content"]
    for content, title in CONTENTS.items():
        rows = tried[tried["content"] == content].sort_values("frame_rate_hz")
        left = int(rows["differing_voxels_left"].max())
        axes.plot(rows["bytes_per_s"] / 1000.0, rows["differing_voxels_mean"],
                  label=title.partition(":")[0] + (f": {left} stay wrong" if left else ""), **CONTENT_LOOKS[content])
    _mark(axes, tried.assign(kB_per_s=tried["bytes_per_s"] / 1000.0), "kB_per_s", "differing_voxels_mean")
    loglog(axes, "sent, kB/s", "voxels that differ at the client")
    axes.set_ylim(top=20.0 * float(tried["differing_voxels_mean"].max()))
    axes.legend(loc="upper right", fontsize=10)
    rates = tried["frame_rate_hz"]
    axes.set_title(f"Link, {rates.min():g} to {rates.max():g} frames a second")


def _mark(axes: Axes, tried: pd.DataFrame, cost: str, error: str) -> None:
    """The front, where there is one, and the default."""
    if "on_front" in tried:
        front = tried[tried["on_front"]].sort_values(cost)
        axes.plot(front[cost], front[error], label="front of the best", **FRONT_LINE)
    default = tried[tried["is_default"]]
    axes.plot(default[cost], default[error], label="default", **DEFAULT_RING)
