"""The chart of entries into bone: the share of the exact answer's peak that a hand feels with and without the feed-forward of
bone's change, and how much later half of that peak is there."""

import pandas as pd
from matplotlib.figure import Figure

from osteomill.studies import charts

STIFFEST_DRAWN_N_PER_MM = 5.0  # that an arm renders
COLOURS = (charts.BLACK, charts.RED)


def chart_of(table: pd.DataFrame) -> Figure:
    """A column for each way in and hand, above the share, below the delay; a line for each spring, dashed the softest, and method; of the
    first burr."""
    drawn = table[(table["stiffness_n_per_mm"] < STIFFEST_DRAWN_N_PER_MM) & (table["burr_mm"] == table["burr_mm"].iloc[0])]
    drawn = drawn.assign(way=drawn["kind"].str.split().str[0] + ", " + drawn["hand"])
    ways = list(dict.fromkeys(drawn["way"]))
    figure = charts.figure(2.6 * len(ways) + 0.6, 5.4)
    rows = figure.subplots(2, len(ways), sharex=True, sharey="row", squeeze=False)
    methods = list(dict.fromkeys(drawn["method"]))
    stiffnesses = sorted(set(drawn["stiffness_n_per_mm"]))
    for column, way in enumerate(ways):
        of_way = drawn[drawn["way"] == way]
        for method, colour in zip(methods, COLOURS):
            for stiffness, style in zip(stiffnesses, ("--", "-.", ":", "-")):
                means = of_way[(of_way["method"] == method) & (of_way["stiffness_n_per_mm"] == stiffness)].groupby("speed_mm_per_s")[
                    ["felt_share", "felt_late_ms"]].mean()
                for axes, number in zip(rows[:, column], ("felt_share", "felt_late_ms")):
                    axes.plot(means.index, means[number], style, marker="o", markersize=3, color=colour,
                              label=f"{stiffness:g} N/mm {method.partition(' ')[2]}")
        rows[0, column].set(title=way, ylim=(0.0, 1.15))
        rows[0, column].axhline(1.0, color=charts.BLACK, linewidth=0.6)
        rows[1, column].set(xlabel="speed of the hand, mm/s", xscale="log")
        rows[1, column].set_xticks(sorted(set(drawn["speed_mm_per_s"])), [f"{speed:g}" for speed in sorted(set(drawn["speed_mm_per_s"]))])
        rows[1, column].minorticks_off()
    rows[0, 0].set_ylabel("share of the exact peak")
    rows[1, 0].set_ylabel("half of it, ms later")
    rows[0, min(1, len(ways) - 1)].legend(loc="lower left", fontsize="x-small")
    return figure
