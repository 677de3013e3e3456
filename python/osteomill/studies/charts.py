"""Charts in one style (osteomill.mplstyle): the colours of Okabe and Ito, text as text, the same bytes twice.

    figure = charts.figure()
    axes = figure.subplots()
    axes.plot(depth_mm, force_n, color=charts.BLUE, label="measured")
    study.chart("depth", figure)

Importing this sets the style of the process.
"""

import io
import logging
import pathlib
import re
from typing import Any

logging.getLogger("matplotlib").setLevel(logging.ERROR)  # it prints lines about its caches

import matplotlib  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

BLACK, BLUE, RED, GREEN = "#000000", "#0072b2", "#d55e00", "#009e73"
PINK, AMBER, SKY, YELLOW, GREY = "#cc79a7", "#e69f00", "#56b4e9", "#f0e442", "#888888"

matplotlib.rcdefaults()  # whatever the user's own settings are
matplotlib.rcParams.update(matplotlib.rc_params_from_file(
    str(pathlib.Path(__file__).with_name("osteomill.mplstyle")), use_default_template=False))


def figure(width_in: float = 10.0, height_in: float = 6.8, **settings: Any) -> Figure:
    """An empty figure, which belongs to no window; `settings` of matplotlib's."""
    return Figure(figsize=(width_in, height_in), **settings)


def svg_of(figure: Figure) -> str:
    """The figure as SVG: the same text for the same figure, at any time."""
    drawn = io.StringIO()
    figure.savefig(drawn, format="svg", metadata={"Date": None, "Creator": "osteomill_study"})
    return drawn.getvalue()


def inline_svg(svg: str) -> str:
    """The element alone, for a page that holds several: without names that would occur twice."""
    element = svg[svg.index("<svg") :]
    element = re.sub(r"<metadata>.*?</metadata>", "", element, flags=re.DOTALL)
    return re.sub(r'(<g) id="[^"]*"', r"\1", element)
