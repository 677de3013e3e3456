"""Speed against accuracy of the link: the data sent, their rate, and the client's picture meanwhile.

A scene's simulated hand mills for some seconds of session time. The program's own messages send the removed bone to a client,
over a simulated link of a millisecond's latency, of sufficient bandwidth or less. The cost is bytes a second. The error is the
age of the client's picture, and the number of voxels in which the client's bone differs from the server's, both means over the
session; and the number that still differ when all has arrived.
"""

import functools
from typing import Any

import numpy as np
import pandas as pd

from osteomill import Session, _studies
from osteomill.studies.tables import on_front
from osteomill.studies.tradeoff_picture import TRIED_SCENE, case_named

LATENCY_S = 0.001
WIDE_BYTES_PER_S = 12.5e6  # 100 Mbit/s
DEFAULT_RATE_HZ = 30.0
RATES_HZ = (5.0, 10.0, 30.0, 60.0, 120.0, 1000.0)
SCENE_RATES_HZ = (5.0, 10.0, 15.0, 30.0, 60.0)
WIDTHS_KBIT_PER_S = (64.0, 256.0, 1000.0)
NEEDED_DELAY_MS = 40.0  # the target of a motion's way to the picture, benchmark of the link

# Choices by name, with their text in the chart.
FAMILIES = {
    "changes": "the voxels that changed",
    "bricks": "whole bricks that changed",
    "poses": "the tool alone: the client carves for itself",
}


def cases(scenes: "list[str]", quick: bool) -> list[dict[str, Any]]:
    def choice(scene: str, content: str, varied: str, rate_hz: float, bytes_per_s: float = WIDE_BYTES_PER_S) -> dict[str, Any]:
        return {"part": "link", "scene": scene, "content": content, "varied": varied, "frame_rate_hz": rate_hz,
                "link_bytes_per_s": bytes_per_s, "quick": quick}

    rates = RATES_HZ[1:-1] if quick else RATES_HZ
    made = [choice(TRIED_SCENE, content, "content", rate_hz) for content in FAMILIES for rate_hz in rates]
    made += [choice(TRIED_SCENE, "changes", "width", DEFAULT_RATE_HZ, 125.0 * kbit) for kbit in WIDTHS_KBIT_PER_S]
    for scene in scenes:
        made += [choice(scene, "changes", "scene", rate_hz) for rate_hz in SCENE_RATES_HZ[:: 2 if quick else 1]]
    return made


@functools.lru_cache(1)
def _path(scene: str, quick: bool) -> Any:
    """Path of the burr while it turns, by the millisecond: (n, 3)."""
    session = Session(case_named(scene), hand="firm")
    ran = session.run(3000 if quick else 10_000)
    session.close()
    return np.asarray(ran["burr_mm"])[np.asarray(ran["spindle_on"], dtype=bool)]


def measure(case: dict[str, Any]) -> dict[str, Any]:
    scene = case_named(case["scene"])
    return _studies.run_link(scene, scene.burrs[scene.start_burr], scene.start_axis, 0.001, _path(case["scene"], case["quick"]),
                             content=case["content"], frame_rate_hz=case["frame_rate_hz"], bytes_per_s=case["link_bytes_per_s"],
                             latency_s=LATENCY_S)


def table_of(choices: list[dict[str, Any]], outcomes: list[dict[str, Any]]) -> pd.DataFrame:
    """A line for each choice; on_front: no other sends less and shows newer bone that is as accurate in the end."""
    told = ("varied", "scene", "content", "frame_rate_hz", "link_bytes_per_s")
    table = pd.DataFrame([{key: case[key] for key in told} | outcome for case, outcome in zip(choices, outcomes)])
    table["is_default"] = (table["content"] == "changes") & (table["frame_rate_hz"] == DEFAULT_RATE_HZ)
    table["on_front"] = False
    among = table["varied"] == "content"
    table.loc[among, "on_front"] = on_front(table.loc[among, "bytes_per_s"], table.loc[among, "differing_voxels_mean"])
    return table


def needs_of(table: pd.DataFrame) -> pd.DataFrame:
    """For each scene the fewest frames a second that are new enough."""
    rows = []
    for scene, tried in table[table["varied"] == "scene"].groupby("scene", sort=False):
        tried = tried.sort_values("frame_rate_hz")
        enough = tried[tried["delay_mean_ms"] <= NEEDED_DELAY_MS]
        row = enough.iloc[0] if len(enough) else tried.iloc[-1]
        rows.append({"scene": scene, "is_held": bool(len(enough)),
                     **{key: row[key] for key in ("frame_rate_hz", "bytes_per_s", "delay_mean_ms", "differing_voxels_mean")}})
    return pd.DataFrame(rows)
