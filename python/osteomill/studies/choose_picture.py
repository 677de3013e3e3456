"""The truest way to draw a case's bone within a frame's time, full size: settings of render_client.

A way is tried in the overview and from near; its slower frame and its less accurate picture count (tradeoff_picture.py says how
they are measured). If none is fast enough in full, the picture is drawn at a lower resolution, as render_client does by itself
while something moves; the window in which every pixel is drawn in time is smaller by as much.
"""

import dataclasses
import functools
from typing import Any

from osteomill import Case, _studies

SIZE_PX, QUICK_SIZE_PX = (1280, 800), (320, 200)
VIEWS, QUICK_VIEWS = ("overview", "close-up"), ("overview",)
DIVISORS = (1, 2, 3, 4, 6, 8)


@dataclasses.dataclass(frozen=True)
class Drawing:
    renderer: str
    shading: str
    divisor: int

    def options(self, size_px: tuple[int, int]) -> list[str]:
        """Options of render_client, with the window in which every pixel is drawn in time."""
        width_px, height_px = (edge // self.divisor for edge in size_px)
        return ["--renderer", self.renderer, "--shading", self.shading, "--window-size", f"{width_px}x{height_px}"]


@dataclasses.dataclass(frozen=True)
class Drawn:
    frame_ms: float
    psnr_db: float


@dataclasses.dataclass(frozen=True)
class PictureChoice:
    drawing: Drawing
    drawn: Drawn
    is_held: bool  # none is fast enough: it is the fastest of those tried
    next_faster: tuple[Drawing, Drawn] | None


def drawings(quick: bool) -> list[Drawing]:
    """Slices take seconds on a CPU, so quick leaves them out."""
    ways = [("raycast", "gradient"), ("raycast", "surface-voxels")] + ([] if quick else [("slices", "surface-voxels")])
    return [Drawing(renderer, shading, divisor) for renderer, shading in ways for divisor in DIVISORS]


def size_px(quick: bool) -> tuple[int, int]:
    return QUICK_SIZE_PX if quick else SIZE_PX


def measure(case: Case, quick: bool) -> dict[Drawing, Drawn]:
    """Measurement of each drawing. One trial at a time: a bone may fill a graphics card."""
    found: dict[Drawing, Drawn] = {}
    for shading in ("gradient", "surface-voxels"):
        for view in QUICK_VIEWS if quick else VIEWS:
            trial = _studies.PictureTrial(case, view=view, shading=shading, size_px=size_px(quick))
            for drawing in drawings(quick):
                if drawing.shading == shading:
                    found[drawing] = _worse(found.get(drawing), _draw(trial, drawing))
            del trial
    return found


def _draw(trial: _studies.PictureTrial, drawing: Drawing) -> Drawn:
    drawn: dict[str, Any] = trial.draw(renderer=drawing.renderer, divisor=drawing.divisor, times=0 if drawing.renderer == "slices" else 5)
    return Drawn(drawn["frame_ms"], drawn["psnr_db"])


def _worse(one: Drawn | None, other: Drawn) -> Drawn:
    return other if one is None else Drawn(max(one.frame_ms, other.frame_ms), min(one.psnr_db, other.psnr_db))


def truest(found: dict[Drawing, Drawn], frame_ms: float) -> PictureChoice:
    """The truest drawing within the time; surface voxels look different, and are chosen only if light in every pixel is too
    slow."""
    by_worth = sorted(found, key=functools.partial(_worth, found))
    in_time = [drawing for drawing in by_worth if found[drawing].frame_ms <= frame_ms]
    chosen = in_time[0] if in_time else min(found, key=lambda drawing: found[drawing].frame_ms)
    faster = [drawing for drawing in by_worth if found[drawing].frame_ms < found[chosen].frame_ms]
    next_faster = faster[0] if faster else None
    return PictureChoice(chosen, found[chosen], bool(in_time), (next_faster, found[next_faster]) if next_faster else None)


def _worth(found: dict[Drawing, Drawn], drawing: Drawing) -> tuple[int, bool, float]:
    """Best first: more pixels, light in every pixel, nearer to the reference."""
    return drawing.divisor, drawing.shading != "gradient", -found[drawing].psnr_db
