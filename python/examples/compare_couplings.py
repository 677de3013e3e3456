#!/usr/bin/env python3
"""Two couplings on one recorded motion of a hand.    python3 compare_couplings.py SESSION.pcap [implicit hold]

The recording has thirty poses a second; the hand goes in straight lines between them."""
import sys

import numpy as np

import osteomill as om

couplings = sys.argv[2:] or ["implicit", "hold"]
case = om.Case("tooth")
with om.Recording(sys.argv[1]) as recording:
    at_s, hand_mm, axis, pedal = recording.session_time_s, recording.hand_mm, recording.axis, recording.spindle_on
ticks_s = np.arange(1, int(at_s[-1] * 1000) + 1) / 1000.0
hands, axes = (np.column_stack([np.interp(ticks_s, at_s, column) for column in rows.T]) for rows in (hand_mm, axis))
pedals = pedal[np.searchsorted(at_s, ticks_s, side="right") - 1]
for coupling in couplings:
    session = om.Session(case, coupling=coupling, start_mm=hand_mm[0], start_axis=axis[0])
    out = session.rollout(hands, axes, pedals)
    force_n = np.linalg.norm(out["force_n"], axis=1)
    step_n = np.linalg.norm(np.diff(out["force_n"], axis=0), axis=1)
    print(f"{coupling}: peak {force_n.max():.3f} N, mean {force_n.mean():.3f} N, largest step {step_n.max():.3f} N/ms, "
          f"removed {out['removed_mm3']['total'][-1]:.3f} mm^3")
