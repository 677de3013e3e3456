"""The page of the study `tradeoff`: its charts of cost against error, one beside the other."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from osteomill.studies import charts
from osteomill.studies.tradeoff_cues import draw_cues
from osteomill.studies.tradeoff_link_chart import draw_links
from osteomill.studies.tradeoff_marks import DEFAULT_RING, SCENE_STAR, label_points, loglog
from osteomill.studies.tradeoff_picture_chart import draw_pictures
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
def page_of(tables: dict[str, pd.DataFrame]) -> Figure:
    """The page of the study's tables, given by their names."""
    force, needs, coupling = tables["force"], tables["needs"], tables["coupling"]
    page = charts.figure(15.0, 41.0)
    page.suptitle("What a choice costs and what it is worth: the best is at the lower left, but for the shares")
    grid = page.add_gridspec(7, 2, height_ratios=(10, 2.6, 9, 9, 9, 6, 9))
    voxels_error, voxels_ripple = page.add_subplot(grid[0, 0]), page.add_subplot(grid[0, 1])
    _draw_voxels(voxels_error, force, needs, "error_percent", "error of the mean force, %", NEEDED_ERROR_PERCENT)
    _draw_voxels(voxels_ripple, force, needs, "ripple_percent", "largest ripple of means over 10 ms, %", NEEDED_RIPPLE_PERCENT)
    legend = page.add_subplot(grid[1, :])
    legend.set_axis_off()
    legend.legend(*voxels_error.get_legend_handles_labels(), loc="center", ncol=3)
    _draw_rates(page.add_subplot(grid[2, 0]), force)
    _draw_burrs(page.add_subplot(grid[2, 1]), force)
    coupling_error, coupling_share = page.add_subplot(grid[3, 0]), page.add_subplot(grid[3, 1])
    _draw_couplings(coupling_error, coupling, "rms_error_percent", "error of the force in time, %")
    _draw_couplings(coupling_share, coupling, "stable_percent", "share of the range that is stable, %")
    draw_pictures(page.add_subplot(grid[4, 0]), page.add_subplot(grid[4, 1]), tables["picture"], tables["picture_needs"])
    draw_cues(page.add_subplot(grid[5, 0]), page.add_subplot(grid[5, 1]), tables["picture_cues"])
    draw_links(page.add_subplot(grid[6, 0]), page.add_subplot(grid[6, 1]), tables["link"], tables["link_needs"])
    return page


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
    loglog(axes, "time of a step (median), us", y_label)
    label_points(axes, needs["step_us"], needs[column], [f"{row['scene']}, {row['voxel_mm']:g} mm" for _, row in needs.iterrows()])
    axes.set_title("Force of a 5 mm burr, 100 Hz: along a line the voxels shrink from left to right,\n"
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
    loglog(axes, "share of a core, %", "largest ripple of means over 10 ms, %")
    axes.set_title("Force: steps of 25 Hz to 10 kHz, 5 mm burr, voxels of 0.1 mm\n(ripple: of whole steps where they are longer)",
                   fontsize=10)


def _draw_burrs(axes: Axes, force: pd.DataFrame) -> None:
    for (varied, family), rows in force[force["varied"].isin(["burr", "edges"])].groupby(["varied", "family"], sort=False):
        looks = LOOKS[str(family)] | ({"linestyle": "--", "markerfacecolor": "white"} if varied == "edges" else {})
        axes.plot(rows["step_us"], rows["error_percent"], label="with edges that rub" if varied == "edges" else "_", **looks)
        for _, row in rows.iterrows():
            axes.annotate(row["label"], (row["step_us"], row["error_percent"]),
                          xytext=(4, -14) if varied == "edges" else (6, 4),
                          textcoords="offset points", fontsize=9)
    axes.legend(loc="center right")
    loglog(axes, "time of a step (median), us", "error of the mean force, %")
    axes.set_title("Force: burrs of 1.5 to 5 mm, also with edges that rub: voxels of 0.1 mm, 100 Hz", fontsize=10)


def _draw_couplings(axes: Axes, coupling: pd.DataFrame, column: str, y_label: str) -> None:
    tried = coupling.dropna(subset=[column]).sort_values(column, ignore_index=True)
    for _, row in tried.iterrows():
        colour = charts.AMBER if row["is_published"] else charts.BLUE if row["is_default"] else charts.GREY
        axes.plot(row["tick_us"], row[column], marker="s" if row["is_published"] else "o", color=colour, linestyle="none")
    default = tried[tried["is_default"]]
    axes.plot(default["tick_us"], default[column], label="the default", **DEFAULT_RING)
    axes.set(xscale="log", xlabel="time of a haptic tick (median), us", ylabel=y_label)
    axes.set_xlim(0.01, 1000.0)
    axes.margins(y=0.15)
    axes.xaxis.set_major_formatter("{x:g}")
    if column == "rms_error_percent":
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter("{x:g}")
    else:
        axes.set_ylim(0.0, 110.0)
    for quick in (True, False):  # those that only remember, and those that solve
        rows = tried[(tried["tick_us"] < 1.0) == quick]
        label_points(axes, rows["tick_us"], rows[column],
               [row["method"] + (" (published)" if row["is_published"] else "") for _, row in rows.iterrows()])
    axes.legend(loc="upper center")
    axes.set_title(f"Couplings: {coupling['range'].iloc[0]}", fontsize=10)
