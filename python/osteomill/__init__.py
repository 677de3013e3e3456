"""Bone milling, step by step: sessions, recordings and bones of Osteomill.

Units are mm, s, N, N mm; positions are in patient LPS (x to the patient's left, y to the back, z up).
"""

from osteomill._core import FAULTS, Bone, Burr, Case, Session, State, Step, __version__

__all__ = ["FAULTS", "Bone", "Burr", "Case", "Session", "State", "Step", "__version__"]
