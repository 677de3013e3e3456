"""The page of the study `tradeoff`: its charts of cost against error, one beside the other."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from osteomill.studies import charts
from osteomill.studies.tradeoff_force import FAMILIES, NEEDED_ERROR_PERCENT, NEEDED_RIPPLE_PERCENT

# Colour and mark of each family.
LOOKS: dict[str, dict[str, Any]] = {
    "new smoothed": {"color": charts.BLUE, "marker": "o"},
    "new in part": {"color": charts.SKY, "marker": "X"},
    "new there or gone": {"color": charts.GREEN, "marker": "^", "markerfacecolor": "white"},
    "all smoothed": {"color": charts.RED, "marker": "s"},
    "published": {"color": charts.AMBER, "marker": "s", "markerfacecolor": "white"},
    "bins": {"color": charts.PINK, "marker": "v"},
    "map": {"color": charts.GREY, "marker": "P", "linestyle": "none"},
    "instants": {"color": charts.BLACK, "marker": "D", "linestyle": "none"},
}
DEFAULT_RING = {"marker": "o", "markersize": 13, "markerfacecolor": "none", "markeredgecolor": charts.BLACK,
                "markeredgewidth": 1.8, "linestyle": "none"}

SCENE_STAR = {"marker": "*", "markersize": 13, "color": charts.YELLOW, "markeredgecolor": charts.BLACK, "linestyle": "none"}
LABEL_PLACES = (((-9, -3), "right"), ((9, -3), "left"), ((4, 10), "left"), ((9, -3), "left"), ((-9, -3), "right"))
WHITE_GROUND = {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.5}


def page_of(force: pd.DataFrame, needs: pd.DataFrame) -> Figure:
    page = charts.figure(15.0, 15.0)
    page.suptitle("What a choice costs and what it is worth: the force of five motions at 6 mm/s, against the analytical reference")
    grid = page.add_gridspec(3, 2, height_ratios=(10, 2.6, 9))
    voxels_error, voxels_ripple = page.add_subplot(grid[0, 0]), page.add_subplot(grid[0, 1])
    _draw_voxels(voxels_error, force, needs, "error_percent", "error of the mean force, %", NEEDED_ERROR_PERCENT)
    _draw_voxels(voxels_ripple, force, needs, "ripple_percent", "largest ripple of means over 10 ms, %", NEEDED_RIPPLE_PERCENT)
    legend = page.add_subplot(grid[1, :])
    legend.set_axis_off()
    legend.legend(*voxels_error.get_legend_handles_labels(), loc="center", ncol=3)
    _draw_rates(page.add_subplot(grid[2, 0]), force)
    _draw_burrs(page.add_subplot(grid[2, 1]), force)
    return page


def _loglog(axes: Axes, x_label: str, y_label: str) -> None:
    axes.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label)
    axes.margins(x=0.12)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")


def _draw_voxels(axes: Axes, force: pd.DataFrame, needs: pd.DataFrame, column: str, y_label: str, needed: float) -> None:
    tried = force[force["varied"] == "voxels"]
    for family, title in FAMILIES.items():
        rows = tried[tried["family"] == family]
        if len(rows):
            axes.plot(rows["step_us"], rows[column], label=title, **LOOKS[family])
    front = tried[tried["on_front"]].sort_values("step_us")
    if column == "error_percent":
        axes.plot(front["step_us"], front[column], color=charts.BLACK, linewidth=6.0, alpha=0.15, zorder=0,
                  label="front of the best: none is both faster and truer")
    default = tried[tried["is_default"]]
    axes.plot(default["step_us"], default[column], label="the default, voxels of 0.1 mm", **DEFAULT_RING)
    axes.axhline(needed, color=charts.GREY, linestyle=":", label="what a hand needs")
    axes.plot(needs["step_us"], needs[column], label="coarsest voxels that the first burr of a built-in scene needs, at 1 kHz",
              **SCENE_STAR)
    # From the left to the right beside it or above it, so that neighbours do not meet.
    for (_, row), (offset, alignment) in zip(needs.sort_values("step_us").iterrows(), LABEL_PLACES):
        axes.annotate(f"{row['scene']}, {row['voxel_mm']:g} mm", (row["step_us"], row[column]), xytext=offset,
                      textcoords="offset points", fontsize=9, ha=alignment, bbox=WHITE_GROUND)
    _loglog(axes, "time of a step (median), us", y_label)
    axes.set_title("5 mm burr, 100 Hz; along a line the voxels shrink from left to right:\n"
                   + ", ".join(f"{mm:g}" for mm in sorted(set(tried["voxel_mm"]), reverse=True)) + " mm", fontsize=10)


def _draw_rates(axes: Axes, force: pd.DataFrame) -> None:
    tried = force[force["varied"] == "rate"]
    for family, rows in tried.groupby("family", sort=False):
        is_alone = len(rows) == 1
        axes.plot(rows["core_percent"], rows["ripple_percent"], label=FAMILIES[str(family)] if is_alone else "_", **LOOKS[str(family)])
        if is_alone:
            axes.legend(loc="lower right")
            continue
        for _, row in rows.iterrows():
            axes.annotate(row["label"], (row["core_percent"], row["ripple_percent"]), xytext=(7, 4),
                          textcoords="offset points", fontsize=9)
    _loglog(axes, "share of a core, %", "largest ripple of means over 10 ms, %")
    axes.set_title("Steps of 25 Hz to 10 kHz (ripple: of whole steps where they are longer): 5 mm burr, voxels of 0.1 mm",
                   fontsize=10)


def _draw_burrs(axes: Axes, force: pd.DataFrame) -> None:
    for (varied, family), rows in force[force["varied"].isin(["burr", "edges"])].groupby(["varied", "family"], sort=False):
        looks = LOOKS[str(family)] | ({"linestyle": "--", "markerfacecolor": "white"} if varied == "edges" else {})
        axes.plot(rows["step_us"], rows["error_percent"], label="new voxels only, smoothed, with edges that rub" if varied == "edges" else "_", **looks)
        for _, row in rows.iterrows():
            axes.annotate(row["label"], (row["step_us"], row["error_percent"]),
                          xytext=(4, -14) if varied == "edges" else (6, 4),
                          textcoords="offset points", fontsize=9)
    axes.legend(loc="center right")
    _loglog(axes, "time of a step (median), us", "error of the mean force, %")
    axes.set_title("Burrs of 1.5 to 5 mm, also with edges that rub: voxels of 0.1 mm, 100 Hz", fontsize=10)
