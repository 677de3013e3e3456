"""Charts of the study `force`."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from osteomill.studies import charts
from osteomill.studies.force_curves import CONVERGING

AXES = {"x": charts.BLUE, "y": charts.RED, "z": charts.GREEN}


def _logarithmic(axes: Axes, which: str = "xy") -> None:
    for letter, axis in (("x", axes.xaxis), ("y", axes.yaxis)):
        if letter in which:
            getattr(axes, f"set_{letter}scale")("log")
            axis.set_major_formatter("{x:g}")


def _ticks(axes: Axes, at: Any) -> None:
    axes.set_xticks(list(at), [f"{value:.2g}" if value < 100 else f"{value:g}" for value in at])
    axes.set_xticks([], minor=True)


def curves(tables: dict[str, pd.DataFrame]) -> Figure:
    figure = charts.figure(13.0, 5.2)
    figure.suptitle("Force of the bone on an upright 5 mm burr: voxel model (points) on the reference (lines)")
    titles = {"depth_mm": "depth, mm (6 mm/s, 10 000 rpm)", "feed_mm_per_s": "feed, mm/s (1 mm deep, 10 000 rpm)",
              "thousand_rpm": "spindle, 1000 rpm (1 mm deep, 6 mm/s)"}
    for axes, (varied, table) in zip(figure.subplots(1, 3), tables.items()):
        for axis, colour in AXES.items():
            axes.plot(table[varied], table[f"reference_{axis}_n"], color=colour, label=f"F_{axis}")
            axes.plot(table[varied], table[f"voxels_{axis}_n"], color=colour, linestyle="none", marker="o")
        axes.set(xlabel=titles[varied], ylabel="force, N")
        axes.legend()
    return figure


def contact(table: pd.DataFrame) -> Figure:
    figure = charts.figure()
    axes = figure.subplots()
    for name, line in (("milling 6 mm/s", "-"), ("milling 2 mm/s", "--")):
        axes.plot(table["depth_mm"], table[name], color=charts.BLACK, linestyle=line, linewidth=2.6, label=f"{name} (reference)")
    models = [name for name in table.columns if name != "depth_mm" and not name.startswith("milling")]
    for name, colour, marker in zip(models, (charts.BLUE, charts.RED, charts.GREEN, charts.PINK), "os^v"):
        is_first = marker == "o"  # petersik lies on it
        axes.plot(table["depth_mm"], table[name], color=colour, marker=marker, label=name, markersize=9 if is_first else 5,
                  markerfacecolor="none" if is_first else colour)
    axes.set(xlabel="depth, mm", ylabel="length of the force, N", xlim=(0.0, 2.5), ylim=(0.0, 10.0),
             title="Force of the bone on an upright 5 mm burr: contact models at rest, milling on its way")
    axes.legend()
    return figure


def convergence(table: pd.DataFrame) -> Figure:
    figure = charts.figure()
    axes = figure.subplots()
    looks = {"there_or_gone": (charts.RED, "s"), "in_part": (charts.SKY, "X"), "smoothed": (charts.BLUE, "o")}
    for name, (colour, marker) in looks.items():
        axes.plot(table["voxel_mm"], table[f"{name}_fit_percent"], color=colour, linestyle="--", label="_")
        axes.plot(table["voxel_mm"], table[f"{name}_error_percent"], color=colour, marker=marker, linestyle="none",
                  label=f"voxels {name.replace('_', ' ')}, slope {table[f'{name}_slope'].iloc[0]:.2f}")
    default = table[(table["voxel_mm"] - 0.1).abs() < 1e-9]
    axes.plot(default["voxel_mm"], default["smoothed_error_percent"], marker="o", markersize=12, markerfacecolor="none",
              color=charts.BLACK, markeredgewidth=1.8, linestyle="none", label="the default")
    _logarithmic(axes)
    _ticks(axes, table["voxel_mm"])
    axes.set(xlabel="edge of a voxel, mm", ylabel="error of the mean force, %",
             title="Error against the size of voxels: five motions, several places of the lattice")
    axes.legend(loc="upper left")
    return figure


def scaling(tables: dict[str, pd.DataFrame]) -> Figure:
    figure = charts.figure(15.0, 5.6)
    figure.suptitle("A step of a half immersed burr at 6 mm/s, voxels of 0.1 mm: new voxels only, and the published scan")
    titles = {"diameter_mm": "burr diameter, mm", "edge_voxels": "edge of the volume, voxels (5 mm burr)",
              "thousand_rpm": "spindle, 1000 rpm (5 mm burr)"}
    looks = {"published_100_hz_us": (charts.RED, "s", "published, 100 Hz"), "published_1_khz_us": (charts.AMBER, "D", "published, 1 kHz"),
             "new_100_hz_us": (charts.BLUE, "o", "new voxels, 100 Hz"), "new_1_khz_us": (charts.SKY, "v", "new voxels, 1 kHz")}
    for axes, (varied, table) in zip(figure.subplots(1, 3, sharey=True), tables.items()):
        for column, (colour, marker, title) in looks.items():
            axes.plot(table[varied], table[column], color=colour, marker=marker, label=title)
        _logarithmic(axes)
        _ticks(axes, table[varied])
        axes.set(xlabel=titles[varied])
    figure.axes[0].set_ylabel("time of a step (median), us")
    figure.axes[1].legend(loc="lower center")
    return figure


def memory(table: pd.DataFrame) -> Figure:
    figure = charts.figure()
    axes = figure.subplots()
    cubes, boxes, scenes = (table[table["of"] == of] for of in ("bone", "box", "scene"))
    axes.plot(cubes["bone_mm3"], cubes["mebibytes"], color=charts.BLUE, marker="o", label="solid cubes of 3 to 51 mm")
    axes.plot(boxes["bone_mm3"], boxes["mebibytes"], color=charts.RED, marker="o", markersize=12, markerfacecolor="none",
              linestyle="none", label="a cube of 13 mm in boxes of 13 to 102 mm")
    bytes_per_voxel, voxels_per_mm3 = 1.0, 1000.0
    axes.plot(boxes["bone_mm3"], boxes["box_mm3"] * voxels_per_mm3 * bytes_per_voxel / 2**20, color=charts.GREY, marker="x",
              linestyle="none", label="what a byte for each voxel of those boxes would take")
    axes.plot(scenes["bone_mm3"], scenes["mebibytes"], color=charts.GREEN, marker="^", linestyle="none", label="built-in scenes")
    # From the smallest to the largest, beside it or below, so that neighbours do not meet.
    places = (((-9, -4), "right"), ((-9, -4), "right"), ((4, -16), "left"), ((9, -4), "left"), ((-9, -4), "right"))
    for (_, row), (offset, alignment) in zip(scenes.sort_values("bone_mm3").iterrows(), places):
        axes.annotate(f"{row['name']}, {row['bytes_per_mm3']:.0f} B/mm^3", (row["bone_mm3"], row["mebibytes"]), xytext=offset,
                      textcoords="offset points", fontsize=9, color=charts.GREEN, ha=alignment)
    _logarithmic(axes)
    axes.set(xlabel="bone, mm^3", ylabel="memory, MiB", title="Memory follows the bone, not the box around it (voxels of 0.1 mm; scenes have their own)")
    axes.legend(loc="lower right")
    return figure
