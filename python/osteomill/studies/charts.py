"""Charts in one style (osteomill.mplstyle): the colours of Okabe and Ito, text as text, the same bytes twice.

    figure = charts.figure()
    axes = figure.subplots()
    axes.plot(depth_mm, force_n, color=charts.BLUE, label="measured")
    study.chart("depth", figure)

Importing this sets the style of the process.
"""

import io
import pathlib
from typing import Any

import matplotlib
from matplotlib.figure import Figure

BLACK, BLUE, RED, GREEN = "#000000", "#0072b2", "#d55e00", "#009e73"
PINK, AMBER, SKY, YELLOW, GREY = "#cc79a7", "#e69f00", "#56b4e9", "#f0e442", "#888888"

matplotlib.rcParams.update(matplotlib.rc_params_from_file(
    str(pathlib.Path(__file__).with_name("osteomill.mplstyle")), use_default_template=False))


def figure(width_in: float = 10.0, height_in: float = 6.8, **settings: Any) -> Figure:
    """An empty one, which belongs to no window; `settings` of matplotlib's."""
    return Figure(figsize=(width_in, height_in), **settings)


def svg_of(figure: Figure) -> str:
    """The same text for the same figure, whenever it is drawn."""
    drawn = io.StringIO()
    figure.savefig(drawn, format="svg", metadata={"Date": None, "Creator": "osteomill_study"})
    return drawn.getvalue()
