"""Marks that all charts of the study `tradeoff` share: the default, a scene's need, names beside points."""

import math
from typing import Any

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import LogLocator, NullFormatter

from osteomill.studies import charts

DEFAULT_RING: dict[str, Any] = {"marker": "o", "markersize": 13, "markerfacecolor": "none", "markeredgecolor": charts.BLACK,
                                "markeredgewidth": 1.8, "linestyle": "none", "zorder": 6}
SCENE_STAR: dict[str, Any] = {"marker": "*", "markersize": 13, "color": charts.YELLOW, "markeredgecolor": charts.BLACK,
                              "linestyle": "none", "zorder": 5}
FRONT_LINE: dict[str, Any] = {"color": charts.BLACK, "linewidth": 6.0, "alpha": 0.15, "zorder": 0}
NEEDED_LINE: dict[str, Any] = {"color": charts.GREY, "linestyle": ":"}
WHITE_GROUND = {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.5}


def loglog(axes: Axes, x_label: str, y_label: str) -> None:
    axes.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label)
    axes.margins(x=0.12)
    plain_decades(axes.xaxis)
    plain_decades(axes.yaxis)


def plain_decades(axis: Axis) -> None:
    """Plain numbers along a logarithmic axis, whose values are drawn already; more of them along a short one."""
    low, high = axis.get_view_interval()
    axis.set_major_formatter("{x:g}")
    if math.log10(high / low) < 2.0:
        axis.set_minor_locator(LogLocator(subs=(2.0, 5.0)))
        axis.set_minor_formatter("{x:g}")
    else:
        axis.set_minor_formatter(NullFormatter())


def label_points(axes: Axes, x: Any, y: Any, texts: list[str], fontsize: float = 9.0) -> None:
    """Names points on their right; names that would meet are pushed apart. The axes have their ranges by now."""
    gap_pt = 1.35 * fontsize
    points_per_pixel = 72.0 / axes.figure.dpi
    axes.autoscale_view()
    heights_pt = [points_per_pixel * axes.transData.transform(point)[1] for point in zip(x, y)]
    placed_pt: list[float] = []
    order = sorted(range(len(texts)), key=heights_pt.__getitem__)
    for i in order:
        placed_pt.append(max(heights_pt[i], placed_pt[-1] + gap_pt) if placed_pt else heights_pt[i])
    # Back towards their points by half of the topmost's shift.
    back_pt = 0.5 * (placed_pt[-1] - heights_pt[order[-1]]) if placed_pt else 0.0
    for i, place_pt in zip(order, placed_pt):
        axes.annotate(texts[i], (list(x)[i], list(y)[i]), xytext=(11, place_pt - back_pt - heights_pt[i] - 3),
                      textcoords="offset points", fontsize=fontsize, bbox=WHITE_GROUND)
