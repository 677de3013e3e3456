"""Charts of the study `render`."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator

from osteomill.studies import charts

#: Families of pictures: a line's legend and looks.
FAMILIES: dict[str, tuple[str, dict[str, Any]]] = {
    "rays shaded by gradient": ("rays, lit by the gradient", {"color": charts.BLUE, "marker": "o"}),
    "rays to surface voxels": ("rays to surface voxels", {"color": charts.SKY, "marker": "o", "markerfacecolor": "white"}),
    "rays without skipping": ("rays that skip no empty bricks", {"color": charts.GREY, "marker": "x"}),
    "rays at lower resolution": ("rays at lower resolution", {"color": charts.GREEN, "marker": "^"}),
    "slices shaded by gradient": ("slices, lit by the gradient", {"color": charts.RED, "marker": "s"}),
    "slices of surface voxels (published)": ("slices of surface voxels (published)", {"color": charts.AMBER, "marker": "s", "markerfacecolor": "white"}),
    "rays through see-through bone": ("rays through see-through bone", {"color": charts.BLACK, "marker": "v"}),
}
GOAL_DB = 40.0
#: On a data-centre GPU, of what the 5 mm burr cuts in a frame.
GOAL_UPLOAD_MS = 0.2


def accuracy(table: pd.DataFrame, renderer: str) -> Figure:
    """Frame time against accuracy, a panel for each bone and view."""
    panels = list(dict.fromkeys(table["panel"]))
    columns = min(2, len(panels))
    lines = -(-len(panels) // columns)
    figure = charts.figure(9.0 * columns + (2.0 if columns == 1 else 0.0), 6.0 * lines + 2.2)
    figure.suptitle(f"What a picture costs and what it is worth; steps and spacings in voxels, along each line from above\n{renderer}")
    grid = figure.add_gridspec(lines + 1, columns, height_ratios=(*(6.0 for _ in range(lines)), 1.4))
    for place, panel in enumerate(panels):
        axes = figure.add_subplot(grid[place // columns, place % columns])
        here = table[table["panel"] == panel]
        for family, (title, looks) in FAMILIES.items():
            rows = here[here["family"] == family]
            if len(rows):
                axes.plot(rows["frame_ms"], rows["psnr_db"], label=f"{title}: {_settings(rows)}", **looks)
        default = here[here["is_default"]]
        axes.plot(default["frame_ms"], default["psnr_db"], marker="o", markersize=13, markerfacecolor="none", markeredgewidth=1.8,
                  color=charts.BLACK, linestyle="none", label="the default")
        axes.axhline(GOAL_DB, color=charts.BLACK, linestyle="--", linewidth=1.2, label=f"goal of full quality, {GOAL_DB:g} dB")
        axes.set(title=panel, xscale="log", xlabel="time of a frame (median), ms", ylabel="PSNR against the reference image, dB")
        axes.xaxis.set_major_formatter("{x:g}")
    legend = figure.add_subplot(grid[lines, :])
    legend.set_axis_off()
    legend.legend(*figure.axes[0].get_legend_handles_labels(), loc="center", ncol=2)
    return figure


def _settings(rows: pd.DataFrame) -> str:
    """"step 0.5, 1, 2": the value that changes along a line."""
    first, *rest = rows["label"]
    return ", ".join([first, *(label.removeprefix("step ").removeprefix("spacing ") for label in rest)])


def full_rate(table: pd.DataFrame, renderer: str) -> Figure:
    figure = charts.figure()
    axes = figure.subplots()
    names = [f"{row['bone']}: {row['motion']}" for _, row in table.iterrows()]
    bars = axes.bar(range(len(table)), table["frames_per_s"], 0.7, color=charts.BLUE, alpha=0.8, label="window: bone, tool and panels")
    axes.bar_label(bars, fmt="%.4g", fontsize=10)
    axes.axhline(240.0, color=charts.BLACK, linestyle="--", linewidth=1.2, label="goal on a data-centre GPU")
    axes.set_xticks(range(len(table)), names, rotation=30, ha="right")
    axes.set(yscale="log", ylabel="frames a second", title=f"Frames a second at full quality, each finished before the next\n{renderer}")
    axes.set_ylim(bottom=0.1)
    axes.yaxis.set_major_formatter("{x:g}")
    axes.grid(False, axis="x")
    axes.legend(loc="upper left")
    return figure


def uploads(table: pd.DataFrame, renderer: str) -> Figure:
    """Milliseconds of each upload, a line for each bone and kind of cut."""
    figure = charts.figure()
    axes = figure.subplots()
    lines = list(dict.fromkeys(zip(table["bone"], table["cut"])))
    spread = np.random.default_rng(0)
    for place, (bone, cut) in enumerate(lines):
        ms = table[(table["bone"] == bone) & (table["cut"] == cut)]["upload_ms"].to_numpy()
        axes.plot(ms, place + spread.uniform(-0.15, 0.15, len(ms)), "o", markersize=4, alpha=0.5, color=charts.BLUE)
        axes.plot([np.median(ms)] * 2, [place - 0.3, place + 0.3], color=charts.BLACK, linewidth=2.0)
        axes.annotate(f"{np.median(ms):.2g}", (np.median(ms), place + 0.32), ha="center", va="bottom", fontsize=10)
    axes.axvline(GOAL_UPLOAD_MS, color=charts.BLACK, linestyle="--", linewidth=1.2, label="goal on a data-centre GPU")
    axes.set_yticks(range(len(lines)), [f"{bone}: {cut}" for bone, cut in lines])
    axes.set_ylim(-0.6, len(lines) - 0.2)
    axes.set(xscale="log", xlabel="time until OpenGL has finished, ms; the bar is the median",
             title=f"What a carve costs to upload\n{renderer}")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.grid(False, axis="y")
    axes.legend(loc="lower right")
    return figure
