"""Pictures of sessions, drawn offscreen in the caller's process (docs/datasets.md)."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from osteomill._core import Case, Fault, Recording, Session

if TYPE_CHECKING:
    from osteomill import _render

_Path = str | os.PathLike[str]
KINDS = ("colour", "depth", "labels", "normals")
"""Kinds of images that are drawn unless others are named."""


class Rendering(Iterator[dict[str, Any]]):
    """Frames of a recording, one after the other, as render() returns them.

    A frame is its entry in the index of an image set (docs/datasets.md), with arrays in the place of lists of numbers and names
    of files: "recorded_s", "session_s", "tool" with its "pose", "hand_mm", "force_n", "removed_mm3", and under "images", by the
    camera's name, its "pose" and each kind of image. All is of one instant. Any thread may ask for the next frame.
    """

    def __init__(self, rendering: _render.Rendering | _OneFrame) -> None:
        self._rendering = rendering

    @property
    def cameras(self) -> dict[str, np.ndarray[Any, Any] | None]:
        """The intrinsics of each camera, (3, 3); None: each image has its own, "intrinsics"."""
        return {camera["name"]: _array(camera["intrinsics"]) for camera in self._rendering.cameras}

    @property
    def sessions(self) -> list[dict[str, Any]]:
        """The sessions that have begun so far; of each the scene and the table of labels. A frame's "session" says which is its
        own."""
        return self._rendering.sessions

    def __next__(self) -> dict[str, Any]:
        _require_own_drawing()
        frame = self._rendering.next()
        if frame is None:
            raise StopIteration
        return _with_arrays(frame)


class View:
    """Cameras on live sessions in this process: the drawing of osteomill.render, repeated quickly.

    session: the first one to draw; cameras, images, randomise as in osteomill.render. A camera without a place has the first view
    of that session. `draw` takes that session, its copies, and others of the same case, in any order; it copies only changes of
    the bone since the last picture. Any thread may draw. Errors as osteomill.render.
    """

    def __init__(
        self,
        session: Session,
        cameras: _Path | Sequence[Mapping[str, Any]] | None = None,
        *,
        images: Sequence[str] = KINDS,
        randomise: int | None = None,
    ) -> None:
        named, text = ("", "") if cameras is None else _cameras(cameras)
        self._view: _render.View = _drawing().View(session, named, text, list(images), randomise)

    @property
    def cameras(self) -> dict[str, np.ndarray[Any, Any] | None]:
        """As Rendering.cameras."""
        return {camera["name"]: _array(camera["intrinsics"]) for camera in self._view.cameras}

    @property
    def session(self) -> dict[str, Any]:
        """The scene and the table of labels, as one of Rendering.sessions."""
        return self._view.session

    def draw(self, session: Session) -> dict[str, Any]:
        """The frame of a session at present: to the bit that of its recording. BadInput: it is of another bone."""
        _require_own_drawing()
        return _with_arrays(self._view.draw(session))


class _OneFrame:
    """A frame in the form of a rendering."""

    def __init__(self, view: _render.View, frame: dict[str, Any]) -> None:
        self.cameras, self.sessions = view.cameras, [view.session]
        self._frames = iter([frame])

    def next(self) -> dict[str, Any] | None:
        return next(self._frames, None)


def _with_arrays(frame: dict[str, Any]) -> dict[str, Any]:
    for name in ("hand_mm", "force_n"):
        frame[name] = _array(frame[name])
    frame["tool"]["pose"] = _array(frame["tool"]["pose"])
    for view in frame["images"]:
        for name in {"pose", "intrinsics"} & view.keys():
            view[name] = _array(view[name])
    frame["images"] = {view.pop("camera"): view for view in frame["images"]}
    return frame


_drawing_process: int | None = None


def _require_own_drawing() -> None:
    """A driver's threads and memory are not copied into a forked process: drawing there would wait for ever."""
    global _drawing_process
    if _drawing_process is None:
        _drawing_process = os.getpid()
    if _drawing_process != os.getpid():
        raise Fault("osteomill.render: this process was forked from one that has drawn; start it with multiprocessing's \"spawn\" or "
                    "\"forkserver\", or draw here first")


def _drawing() -> ModuleType:
    _require_own_drawing()
    try:
        from osteomill import _render
    except ImportError as error:
        raise Fault(f"osteomill.render: {error}; install libepoxy0, libegl1 and libgl1-mesa-dri") from None
    return _render


def render(
    case_or_recording: Case | Recording | Session | _Path,
    cameras: _Path | Sequence[Mapping[str, Any]] | None = None,
    *,
    fps: float | None = None,
    from_s: float = 0.0,
    images: Sequence[str] = KINDS,
    randomise: int | None = None,
) -> Rendering:
    """Draw frames of a recording, or the one of a session at present or of a case before anything is milled, without a display.

    case_or_recording: a Recording or its file, a Session, or a Case.
    cameras: a file of cameras, or its contents, a mapping for each ("name", "eye_mm", "intrinsics", ...);
        "trainee": from the trainee's viewpoint; None: one of 640 x 480 at the first view.
    fps: frames a recorded second, the first state at or behind each; None: every recorded state.
    from_s: recorded time of the earliest frame.
    images: of "colour", "depth", "ray-depth", "labels", "normals".
    randomise: the seed of domain randomisation; None: as in the window.

    Images are to the bit those of render_client --dataset: "colour" uint8 (height, width, 3), "depth" and "ray_depth" float32
    (height, width) in mm, "labels" uint8 (height, width), "normals" float16 (height, width, 3).
    Raises BadInput for bad cameras and images, and Fault for a recording that cannot be read, without OpenGL 3.3, and in a process
    that was forked from one that has drawn.
    """
    drawing = _drawing()
    named, text = ("", "") if cameras is None else _cameras(cameras)
    if isinstance(case_or_recording, Case | Session):
        session = case_or_recording if isinstance(case_or_recording, Session) else Session(case_or_recording)
        view = drawing.View(session, named, text, list(images), randomise)
        return Rendering(_OneFrame(view, view.draw(session)))
    file = case_or_recording.file if isinstance(case_or_recording, Recording) else case_or_recording
    return Rendering(drawing.Rendering(file, named, text, fps, from_s, list(images), randomise))


def _cameras(cameras: _Path | Sequence[Mapping[str, Any]]) -> tuple[str, str]:
    """Cameras for the core: a name, or the text of a file. A number, text or list of JSON is one of TOML."""
    if isinstance(cameras, str | os.PathLike):
        return os.fspath(cameras), ""
    lines: list[str] = []
    for camera in cameras:
        lines.append("[[cameras]]")
        for key, value in camera.items():
            written = json.dumps(value, ensure_ascii=False, default=_plain)
            lines.append(f"{json.dumps(key)} = {written}")
    return "", "\n".join(lines) + "\n"


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    return os.fspath(value)


def _array(numbers: Any) -> Any:
    return None if numbers is None else np.array(numbers, float)
