"""Tables and JSON of a study's results, as text."""

import json
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from osteomill.studies.text import csv_cell

if TYPE_CHECKING:
    import pandas as pd


def csv_of(frame: "pd.DataFrame", digits: int = 6) -> str:
    """A header and a line for each row: numbers with so many digits, truths as 1 and 0, nothing for a missing
    value."""
    columns = [frame[name].tolist() for name in frame.columns]
    lines = [",".join(csv_cell(str(name)) for name in frame.columns)]
    lines += [",".join(cell_of(value, digits) for value in row) for row in zip(*columns)]
    return "\n".join(lines) + "\n"


def cell_of(value: Any, digits: int = 6) -> str:
    if hasattr(value, "item"):
        value = value.item()
    if value is None or value != value or type(value).__name__ in ("NAType", "NaTType"):
        return ""
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, float):
        return f"{value:.{digits}g}"
    return str(value) if isinstance(value, int) else csv_cell(str(value))


def json_of(data: Any) -> str:
    """JSON with a line for each value; numbers that are not finite are null."""
    return json.dumps(_finite(data), indent=1, ensure_ascii=False) + "\n"


def _finite(data: Any) -> Any:
    if hasattr(data, "tolist"):
        data = data.tolist()
    if isinstance(data, dict):
        return {key: _finite(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_finite(value) for value in data]
    return None if isinstance(data, float) and not math.isfinite(data) else data


def on_front(cost: Iterable[float], error: Iterable[float]) -> list[bool]:
    """Whether each of some choices that cost and err is on the front of the best: no other is at most as costly and as
    wrong, and less so in one of both."""
    points = list(zip(cost, error))
    return [not any(c <= cost_of and e <= error_of and (c, e) != (cost_of, error_of) for c, e in points)
            for cost_of, error_of in points]
