#!/usr/bin/env python3
"""A recording as a table of pandas, and a summary second by second. python3 recording_to_pandas.py SESSION.pcap"""
import sys

import numpy as np
import pandas as pd

import osteomill as om

with om.Recording(sys.argv[1]) as recording:
    table = pd.DataFrame(
        {
            "force_n": np.linalg.norm(recording.force_n, axis=1),
            "depth_mm": recording.depth_mm,
            "removed_mm3": recording.removed_mm3,
            "spindle_on": recording.spindle_on,
        },
        index=pd.Index(recording.time_s, name="time_s"),
    )
by_second = table.groupby(np.floor(table.index).astype(int))
print(by_second.agg({"force_n": "max", "depth_mm": "max", "removed_mm3": "last", "spindle_on": "mean"}).round(3).to_string())
