"""Charts of the study `polishing`: figures 6, 7 and 8 of the paper."""

from collections.abc import Sequence

import pandas as pd
from matplotlib.figure import Figure

from osteomill.studies import charts

Series = dict[str, pd.DataFrame]  # by FORCE-MODEL_COUPLING

#: Couplings: colour, and name in the legend.
COUPLINGS = {
    "interpolate": (charts.RED, "interpolate, 100 Hz"),
    "sample-estimate-interpolate": (charts.AMBER, "sample-estimate-interpolate, 100 Hz"),
    "sample-estimate-hold": (charts.SKY, "sample-estimate-hold, 100 Hz"),
    "implicit": (charts.BLACK, "implicit, 1 kHz"),
}
COMPONENTS = {"x": "along the strokes", "y": "across", "z": "out of the bone"}


def depth(series: Series, meant: pd.DataFrame) -> Figure:
    """Figure 6: cutting depth against time."""
    figure = charts.figure(13.0, 5.8)
    figure.suptitle("Polishing a cube of bone: cutting depth against time (figure 6 of the paper)")
    grid = figure.add_gridspec(2, 2, height_ratios=(7, 1))
    for column, (model, title) in enumerate((("milling", "milling, 80 000 rpm"), ("point-spring", "point spring"))):
        axes = figure.add_subplot(grid[0, column])
        for coupling, (colour, name) in COUPLINGS.items():
            if (run := series.get(f"{model}_{coupling}")) is not None:
                axes.plot(run["t_s"], run["depth_mm"], color=colour, label=name, linewidth=3.0 if coupling == "implicit" else 1.0)
        axes.plot(meant["t_s"], meant["depth_mm"], color=charts.GREEN, linestyle="--", linewidth=2.0, label="as the hand means it")
        axes.set(title=title, xlabel="time since first contact, s", xlim=(0.0, None), ylim=(-0.5, 4.5))
    figure.axes[0].set_ylabel("depth of the burr's lowest point, mm")
    legend = figure.add_subplot(grid[1, :])
    legend.set_axis_off()
    legend.legend(*figure.axes[0].get_legend_handles_labels(), loc="center", ncol=3)
    return figure


def milling(series: Series) -> Figure:
    """Figure 7: force of the milling model against time."""
    return _forces(series, "milling", tuple(COUPLINGS), (3.5, 3.5, 3.5, 0.9),
                   "Polishing, milling model, 80 000 rpm, firm grip: force on the hand against time (figure 7 of the paper)")


def point_spring(series: Series) -> Figure:
    """Figure 8: force of the point spring against time."""
    return _forces(series, "point-spring", tuple(COUPLINGS)[:3], (1.2, 1.2, 1.2),
                   "Polishing, point spring, firm grip: force on the hand against time (figure 8 of the paper)")


def _forces(series: Series, model: str, couplings: Sequence[str], largest_n: Sequence[float], title: str) -> Figure:
    """A column a coupling, a row a component."""
    figure = charts.figure(3.7 * len(couplings) + 0.6, 8.6)
    figure.suptitle(title)
    grid = figure.subplots(3, len(couplings), sharex="col", squeeze=False)
    for column, (coupling, limit_n) in enumerate(zip(couplings, largest_n)):
        colour, name = COUPLINGS[coupling]
        run = series[f"{model}_{coupling}"]
        for row, (component, direction) in enumerate(COMPONENTS.items()):
            axes = grid[row, column]
            axes.plot(run["t_s"], run[f"force_{component}_n"], color=colour, linewidth=0.8)
            axes.set(ylim=(-limit_n, limit_n), xlim=(0.0, None))
            if column == 0:
                axes.set_ylabel(f"{direction}, F_{component}, N")
        grid[0, column].set_title(_heading(coupling, name), fontsize=11)
        grid[2, column].set_xlabel("time since first contact, s")
    return figure


def _heading(coupling: str, name: str) -> str:
    return {"interpolate": f"{name} (without s.-e.-h.)", "implicit": f"{name} (mind the scale)"}.get(coupling, name)
