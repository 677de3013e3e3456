"""The spaces of gymnasium if it is installed, else spaces of the same form."""

from __future__ import annotations

import importlib.util
from typing import TYPE_CHECKING

HAS_GYMNASIUM = importlib.util.find_spec("gymnasium") is not None
if TYPE_CHECKING or not HAS_GYMNASIUM:
    from osteomill import fallback_spaces as spaces
else:
    from gymnasium import spaces

__all__ = ["HAS_GYMNASIUM", "spaces"]
