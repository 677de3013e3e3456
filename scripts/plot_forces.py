#!/usr/bin/python3
"""Force and depth against time from a --log-csv file.

scripts/plot_forces.py out/demo/forces.csv out/demo/forces.png
"""

import pathlib
import sys

import matplotlib.style
import pandas as pd
from matplotlib.figure import Figure

STYLE = pathlib.Path(__file__).parents[1] / "python" / "osteomill" / "studies" / "osteomill.mplstyle"

log, picture = sys.argv[1:]
matplotlib.style.use(str(STYLE))
forces = pd.read_csv(log)
figure = Figure(figsize=(12.0, 8.0), dpi=100)
force, depth = figure.subplots(2, 1, sharex=True)
for axis in "xyz":
    force.plot(forces["t_s"], forces[f"force_{axis}_n"], linewidth=1.2, label=f"F_{axis}")
force.set(title="Force on the hand", ylabel="N")
force.legend(loc="upper left", ncol=3)
depth.plot(forces["t_s"], forces["depth_mm"], color="#000000", label="depth")
depth.set(title="Depth of the burr and bone removed", ylabel="depth, mm", xlabel="time, s")
removed = depth.twinx()
removed.plot(forces["t_s"], forces["removed_mm3"], color="#cc79a7", label="removed (right axis)")
removed.set_ylabel("removed, mm^3")
removed.grid(False)
depth.legend(handles=[*depth.get_lines(), *removed.get_lines()], loc="upper left", ncol=2)
figure.savefig(picture)
