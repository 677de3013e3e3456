"""Charts of the stability map: regions, errors against resistance, share against error."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from osteomill.studies import charts
from osteomill.studies.stability_points import GRIPS, METHODS

SHADES = ("#0b2a4a", "#2f7fb8", "#8cc4e8")  # of the grips
GRIP_NAMES = ("bare arm", "light grip", "firm grip")
UNSTABLE = "#c8c8c8"
PANELS_A_LINE = 4
RESISTANCES = (5, 20, 100, 500, 3000)
REGIONS = {  # title, name of x, its ends, its ticks
    "cutting": ("Where cutting is stable: bar where it is, thin line where it is not", "resistance of the bone, N s/m",
                (3.0, 6000.0), RESISTANCES),
    "wall": ("Where pressing on bone with the spindle off is stable: bar where it is, thin line where it is not",
             "stiffness that the arm claims, N/mm", (0.06, 2.7), (0.1, 0.2, 0.4, 0.8, 1.7)),
}
# Families share a colour: couplings on a hold are red, on interpolation blue, on an estimate green.
POINTS: dict[str, dict[str, Any]] = {method: {"color": colour, "marker": marker, "markerfacecolor": "white" if is_open else colour}
                                     for method, colour, marker, is_open in (
    ("implicit", charts.BLACK, "o", False), ("virtual-coupling", charts.PINK, "s", False), ("hold", charts.RED, "o", False),
    ("interpolate", charts.BLUE, "o", False), ("sample-estimate-hold", charts.GREEN, "^", False),
    ("sample-estimate-interpolate", charts.GREEN, "^", True), ("corrected-sample-estimate-hold", charts.GREEN, "v", False),
    ("hold+damper", charts.RED, "s", False), ("interpolate+damper", charts.BLUE, "s", False),
    ("hold+passivity", charts.RED, "o", True), ("interpolate+passivity", charts.BLUE, "o", True))}
# Methods may be equal in their errors, above all without a delay. Plain couplings are drawn first and widest, so that they show
# on both sides of those drawn on them, with a damper or passivity; within these hold comes first, then interpolate.
CURVES: dict[str, dict[str, Any]] = {method: {"color": colour, "linewidth": width, "marker": marker, "markersize": size}
                                     for method, colour, width, marker, size in (
    ("hold", "#f2a477", 8.0, "o", 11), ("interpolate", "#7fb3d9", 5.5, "o", 9), ("sample-estimate-hold", "#66c5ab", 4.5, "^", 9),
    ("sample-estimate-interpolate", "#00664b", 1.8, "^", 5), ("corrected-sample-estimate-hold", charts.GREEN, 1.5, "v", 5),
    ("hold+damper", "#f2a477", 4.5, "s", 9), ("interpolate+damper", "#00507f", 1.8, "s", 5),
    ("hold+passivity", "#a34400", 2.6, "o", 6), ("interpolate+passivity", "#00304d", 1.0, "o", 3),
    ("virtual-coupling", charts.PINK, 1.5, "s", 5), ("implicit", charts.BLACK, 1.5, "o", 5))}
SMALLEST_DRAWN_PERCENT = 0.01


def regions(table: pd.DataFrame, rows: pd.DataFrame, scene: str) -> Figure:
    """A panel a method, a row a rate and delay, a strip a grip."""
    title, x_label, ends, ticks = REGIONS[scene]
    methods = [method for method in METHODS if (table["method"] == method).any()]
    columns = max(1, min(PANELS_A_LINE, len(methods)))
    lines = max(1, -(-len(methods) // columns))
    figure = charts.figure(13.0, 1.6 + 2.4 * lines)
    figure.suptitle(title)
    grid = figure.subplots(lines, columns, sharex=True, sharey=True, squeeze=False).flat
    for method, axes in zip(methods, grid):  # in this order, so that the rest of the grid stays in it
        for _, box in table[table["method"] == method].iterrows():
            if box["stable"]:
                axes.barh(box["y"], box["x_high"] - box["x_low"], 0.26, box["x_low"], color=SHADES[box["grip"] - 1], linewidth=0)
            else:
                axes.hlines(box["y"], box["x_low"], box["x_high"], color=UNSTABLE, linewidth=1.0)
        axes.set_title(method)
        axes.set(xscale="log", xlim=ends)
        axes.set_xticks(list(ticks), [f"{tick:g}" for tick in ticks])
        axes.set_xticks([], minor=True)
        axes.grid(False, axis="y")
    for axes in list(grid):
        axes.set_axis_off()
    first = figure.axes[0]
    if len(rows):
        first.set_yticks(rows["y"].tolist(), rows["label"].tolist())
        first.set_ylim(rows["y"].min() - 0.6, rows["y"].max() + 0.6)
    figure.supxlabel(x_label, fontsize=11)
    figure.supylabel("rate of milling, delay in ticks of 1 ms", fontsize=11)
    figure.legend(handles=[Patch(color=shade, label=name) for shade, name in zip(SHADES, GRIP_NAMES)], fontsize=10, ncol=3,
                  loc="lower right")
    return figure


def errors(table: pd.DataFrame) -> Figure:
    """Error of the force against resistance, a panel a grip."""
    figure = charts.figure(13.0, 6.6)
    figure.suptitle("Error of the force in cutting, milling at 1000 Hz, no delay. Each line ends where its method stops being stable;\n"
                    "lines within one another are methods that are equal there")
    grid = figure.add_gridspec(2, 3, height_ratios=(6, 1.3))
    panels: list[Axes] = []
    for column, (grip, name) in enumerate(zip(GRIPS, GRIP_NAMES)):
        panels.append(figure.add_subplot(grid[0, column], sharey=panels[0] if panels else None))
        for method, looks in CURVES.items():
            curve = table[(table["method"] == method) & (table["grip"] == grip)]
            if len(curve):
                percent = curve["rms_error_percent"].clip(lower=SMALLEST_DRAWN_PERCENT).where(curve["stable"].astype(bool))
                panels[-1].plot(curve["resistance_n_s_per_m"], percent, label=method, **looks)
        panels[-1].set(xscale="log", yscale="log", xlim=(3.0, 6000.0), xlabel=REGIONS["cutting"][1], title=name)
        panels[-1].set_xticks(list(RESISTANCES), [str(tick) for tick in RESISTANCES])
        panels[-1].set_xticks([], minor=True)
        panels[-1].yaxis.set_major_formatter("{x:g}")
    panels[0].set_ylabel("rms error, % of the mean force")
    legend = figure.add_subplot(grid[1, :])
    legend.set_axis_off()
    named = next((panel for panel in panels if panel.get_legend_handles_labels()[1]), panels[0])
    legend.legend(*named.get_legend_handles_labels(), loc="center", ncol=4)
    return figure


def pareto(cutting: pd.DataFrame, wall: pd.DataFrame) -> Figure:
    """Share of the range that each coupling holds, and the error of its force there."""
    figure = charts.figure(15.0, 6.4)
    figure.suptitle("How much of the range each coupling holds, and how true its force is there")
    for axes, table, title in zip(figure.subplots(1, 2), (cutting, wall), ("cutting", "pressing on a wall")):
        drawn = table.dropna(subset=["rms_error_percent"])
        for _, row in drawn.iterrows():
            axes.plot(row["stable_percent"], row["rms_error_percent"], linestyle="none", markersize=8, **POINTS[row["method"]])
        axes.set(yscale="log", xlim=(-2.0, 175.0), xlabel="stable share of the range, %", title=title)
        axes.set_xticks(range(0, 101, 20))
        axes.margins(y=0.15)
        axes.yaxis.set_major_formatter("{x:g}")
        _name_in_a_column(axes, drawn)
    figure.axes[0].set_ylabel("rms error of the force where stable (median), % of its mean")
    return figure


def _name_in_a_column(axes: Axes, drawn: pd.DataFrame) -> None:
    """Names stand one above another on the right of the range, in the order of the errors, each joined to its point."""
    ordered = drawn.sort_values("rms_error_percent", kind="stable")
    for place, (_, row) in enumerate(ordered.iterrows()):
        height = (place + 0.5) / len(ordered)
        axes.annotate(row["method"], (row["stable_percent"], row["rms_error_percent"]), xytext=(0.61, height),
                      textcoords="axes fraction", va="center", fontsize=10, color=POINTS[row["method"]]["color"],
                      arrowprops={"arrowstyle": "-", "color": "#bbbbbb", "linewidth": 0.8})
