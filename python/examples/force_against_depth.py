#!/usr/bin/env python3
"""Force against depth of a burr that is pushed into a tooth, as a picture.    python3 force_against_depth.py [OUT.svg]"""
import sys

import matplotlib
import numpy as np

import osteomill as om

matplotlib.use("Agg")
from matplotlib import pyplot

case = om.Case("tooth")
hands = case.start_mm - np.linspace(0.0, 4.0, 4000)[:, None] * case.start_axis
out = om.Session(case).rollout(hands, pedals=True)
pyplot.plot(out["depth_mm"], np.linalg.norm(out["milling_force_n"], axis=1))
pyplot.xlabel("depth / mm")
pyplot.ylabel("milling force / N")
pyplot.savefig(sys.argv[1] if len(sys.argv) > 1 else "force_against_depth.svg")
