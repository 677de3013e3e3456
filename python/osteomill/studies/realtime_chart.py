"""The chart of the study `realtime`: latencies without load and under it, as shares of bins and as shares that take longer."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from osteomill.studies import charts

#: Rows of the table: colour, and name in the legend.
WHATS = {
    "wakeup": (charts.BLUE, "wake-up of the haptic loop"),
    "cyclictest": (charts.RED, "wake-up of cyclictest"),
    "haptic tick": (charts.GREEN, "duration of a haptic tick"),
    "milling step": (charts.AMBER, "duration of a milling step"),
}


def chart_of(table: pd.DataFrame) -> Figure:
    loads = list(dict.fromkeys(table["load"]))
    figure = charts.figure(6.4 * len(loads) + 0.6, 9.0)
    in_turns = "; cyclictest in turns with it" if (table["what"] == "cyclictest").any() else ""
    figure.suptitle(f"The haptic loop at 1 kHz: milling, recording, two clients{in_turns}")
    grid = figure.subplots(2, len(loads), sharex=True, squeeze=False)
    for column, load in enumerate(loads):
        shares, longer = grid[:, column]
        for what, (colour, title) in WHATS.items():
            rows = table[(table["load"] == load) & (table["what"] == what)]
            if rows.empty:
                continue
            shares.stairs(100.0 * rows["share"], np.append(rows["from_us"], rows["up_to_us"].iloc[-1]), color=colour,
                          linewidth=1.6, label=title)
            above = rows[rows["share_above"] > 0.0]
            longer.plot(above["up_to_us"], above["share_above"], color=colour)
        longer.axhline(1e-3, color=charts.BLACK, linestyle="--", linewidth=1.0, label="p99.9")
        for axes in (shares, longer):
            axes.set(xscale="log", xlim=(0.05, 20_000.0))
            axes.axvline(1000.0, color=charts.GREY, linestyle=":", linewidth=1.2)
            axes.legend(fontsize=9)
        shares.set_title("no load besides its own" if load == "no load" else f"under {load}")
        longer.set(xlabel="microseconds", yscale="log", ylim=(1e-6, 1.0))
        longer.xaxis.set_major_formatter("{x:g}")
        longer.yaxis.set_major_formatter("{x:g}")
        if column == 0:
            shares.set_ylabel("share of a bin (a sixth of an octave), %")
            longer.set_ylabel("share that takes longer")
    return figure
