"""Bone milling, step by step: sessions, recordings and bones of Osteomill.

Units are mm, s, N, N mm; positions are in patient LPS (x to the patient's left, y to the back, z up).
"""

try:
    from osteomill._core import (
        FAULTS,
        Arm,
        BadInput,
        Bone,
        Burr,
        Case,
        Fault,
        Motion,
        Recording,
        Session,
        State,
        Step,
        __version__,
        reference_force,
    )
except ModuleNotFoundError as error:
    if error.name != "osteomill._core":
        raise
    raise ModuleNotFoundError(
        "osteomill: its compiled core is not built for this Python; with python3-dev, python3-numpy and pybind11-dev installed, "
        "cmake --preset release && cmake --build --preset release --target osteomill_python builds it for /usr/bin/python3",
        name=error.name) from None
from osteomill.env import Env
from osteomill.render import Rendering, View, render
from osteomill.repeat_recording import Repeated, repeat
from osteomill.fallback_spaces import Box
from osteomill.sweep import sweep
from osteomill.vector_env import VectorEnv

__all__ = [
    "FAULTS",
    "Arm",
    "BadInput",
    "Bone",
    "Box",
    "Burr",
    "Case",
    "Env",
    "Fault",
    "Motion",
    "Recording",
    "Rendering",
    "Repeated",
    "Session",
    "State",
    "Step",
    "VectorEnv",
    "View",
    "__version__",
    "reference_force",
    "render",
    "repeat",
    "sweep",
]
