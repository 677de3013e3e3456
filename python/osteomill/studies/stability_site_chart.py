"""The chart of sites: the faults that a hand would feel, a panel for each kind of site, each number as a share of its
bar."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from osteomill.studies import charts

NUMBERS = {"energy": "share_energy_over_rigid_mj", "stuck": "share_stuck_ms", "error": "share_error_percent",
           "jump": "share_largest_jump_n"}
SMALLEST_DRAWN = 0.005  # a logarithmic axis has no zero
PANELS_A_LINE = 4
GOLDEN = 0.618034


def chart_of(sites: pd.DataFrame) -> Figure:
    kinds = list(dict.fromkeys(sites["kind"]))
    columns = min(PANELS_A_LINE, len(kinds))
    lines = -(-len(kinds) // columns)
    figure = charts.figure(3.4 * columns + 0.4, 3.0 * lines + 0.6)
    figure.suptitle("Where bone ends: each case as a share of its bar; below the line it is met")
    grid = figure.subplots(lines, columns, sharex=True, sharey=True, squeeze=False).flat
    for kind, axes in zip(kinds, grid):  # in this order, so that the rest of the grid stays in it
        of_kind = sites[sites["kind"] == kind]
        beside = 0.5 * (np.arange(len(of_kind)) * GOLDEN % 1.0) - 0.25  # points of a column lie beside one another
        for place, column in enumerate(NUMBERS.values()):
            share = of_kind[column].clip(lower=SMALLEST_DRAWN)
            for is_missed, colour in ((False, charts.BLUE), (True, charts.RED)):
                these = (share > 1.0).to_numpy() == is_missed
                axes.plot(place + beside[these], share[these], linestyle="none", marker="o", markersize=2.2, color=colour)
        axes.axhline(1.0, color=charts.BLACK, linewidth=1.2)
        axes.set(title=kind, yscale="log", xlim=(-0.6, 3.6), ylim=(0.003, 300.0))
        axes.set_xticks(range(len(NUMBERS)), list(NUMBERS))
        axes.yaxis.set_major_formatter("{x:g}")
    for axes in list(grid):
        axes.set_axis_off()
    return figure
