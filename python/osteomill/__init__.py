"""Bone milling, step by step: sessions, recordings and bones of Osteomill.

Units are mm, s, N, N mm; positions are in patient LPS (x to the patient's left, y to the back, z up).
"""

from osteomill._core import (
    FAULTS,
    Bone,
    Burr,
    Case,
    Motion,
    Recording,
    Session,
    State,
    Step,
    __version__,
    reference_force,
)
from osteomill.env import Box, Env
from osteomill.render import Rendering, render
from osteomill.sweep import sweep

__all__ = [
    "FAULTS",
    "Bone",
    "Box",
    "Burr",
    "Case",
    "Env",
    "Motion",
    "Recording",
    "Rendering",
    "Session",
    "State",
    "Step",
    "__version__",
    "reference_force",
    "render",
    "sweep",
]
