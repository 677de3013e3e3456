# Types of the compiled drawing; osteomill.render says what it does.
import os
from collections.abc import Sequence
from typing import Any

from osteomill._core import Session

class View:
    def __init__(
        self, session: Session, cameras: str, cameras_text: str, images: Sequence[str], randomise: int | None
    ) -> None: ...
    def draw(self, session: Session) -> dict[str, Any]: ...
    @property
    def cameras(self) -> list[dict[str, Any]]: ...
    @property
    def session(self) -> dict[str, Any]: ...

class Rendering:
    def __init__(
        self,
        recording: str | os.PathLike[str],
        cameras: str,
        cameras_text: str,
        fps: float | None,
        from_s: float,
        images: Sequence[str],
        randomise: int | None,
    ) -> None: ...
    def next(self) -> dict[str, Any] | None: ...
    @property
    def cameras(self) -> list[dict[str, Any]]: ...
    @property
    def sessions(self) -> list[dict[str, Any]]: ...
