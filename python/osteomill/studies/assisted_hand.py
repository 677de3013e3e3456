"""A recorded hand once more, in closed loop: it does what it did, and a spring and a damper draw it to where it was recorded.

    m d2e/dt2 = -K e - B de/dt + F - F_rec        e = x - x_rec        K |e| <= MOST_PUSH_N

x is the tip of the arm, m arm and hand together, F the force on the hand in the last tick and F_rec that of the recording there.
So as long as it feels what it felt, it stays where it was; a force that was not there moves it off, and the hand pushes back.
It waits for its tool: the recording's time passes at (3 mm - |e|) / 2 mm of its pace, at most at 1 and at least at 0.05, as
for the simulated hand (devices/simulated).
"""

import dataclasses
import pathlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from osteomill import Recording, Session

TICK_S = 0.001
SUBSTEPS = 5  # 0.2 ms: a hundredth of the fastest swing, arm and soft hand on 2.3 N/mm
ARM_KG = 0.045
MOST_PUSH_N = 2.6
FULL_PACE_WITHIN_MM, SLOWEST_PACE_FROM_MM, SLOWEST_PACE = 1.0, 3.0, 0.05
LONGEST = 4.0  # times the recording: a hand that is held off for good gives up


@dataclasses.dataclass(frozen=True)
class Grip:
    """A hand's mass, spring and damper: kg, N/mm, N s/mm. Published values spread by a factor of five (devices/simulated/hand_and_arm.h)."""

    mass_kg: float
    stiffness_n_per_mm: float
    damping_n_s_per_mm: float


GRIPS = {"soft": Grip(0.1, 0.1, 0.002), "firm": Grip(0.5, 0.3, 0.005), "stiff": Grip(1.0, 0.6, 0.01)}


@dataclasses.dataclass(frozen=True)
class RecordedHand:
    """A tick a row."""

    hand_mm: np.ndarray[Any, Any]  # (n, 3), patient LPS
    axis: np.ndarray[Any, Any]  # (n, 3)
    force_n: np.ndarray[Any, Any]  # (n, 3), on the hand, from its tick to the next
    pedal: np.ndarray[Any, Any]  # (n,)
    burr: np.ndarray[Any, Any]  # (n,)

    @staticmethod
    def of(recording: Recording) -> "RecordedHand":
        """RuntimeError for a recording without ticks."""
        ticks = recording.ticks
        if len(ticks["time_s"]) < 2:
            raise RuntimeError(f"{recording.file}: holds no ticks, so that its hand is not known; record with protocol 2.3 or later")
        return RecordedHand(ticks["hand_mm"], ticks["axis"], ticks["force_n"], ticks["pedal"].astype(bool), ticks["burr"])


@dataclasses.dataclass(frozen=True)
class Felt:
    """By the hand, from its first tick to its last."""

    time_s: float
    came_to_end: bool
    peak_force_n: float
    energy_to_hand_mj: float  # net, the most that it ever was: 0 where the force only took
    energy_from_hand_mj: float  # net, over the whole session
    fixture_s: float  # with a fixture's force on the burr
    force_off_s: float  # a fault had turned the force off


def play(session: Session, hand: RecordedHand, grip: Grip, burr: int | None = None) -> Felt:
    """Moves a session that begins where the hand does; `burr`: in place of those that were recorded."""
    mass = 1e-3 * (ARM_KG + grip.mass_kg)  # N s^2/mm
    dt = TICK_S / SUBSTEPS
    last = len(hand.hand_mm) - 1
    off: NDArray[np.float64] = np.zeros(3)
    speed: NDArray[np.float64] = np.zeros(3)
    force = session.now.force_n
    at, recorded = hand.hand_mm[0].astype(float), 0.0
    ticks = force_off = with_fixture = 0
    peak = given = most_given = 0.0
    while recorded < last and ticks < LONGEST * last:
        unlike = force - _between(hand.force_n, recorded)
        for _ in range(SUBSTEPS):
            spring = -grip.stiffness_n_per_mm * off
            length = float(np.sqrt(spring @ spring))
            if length > MOST_PUSH_N:
                spring *= MOST_PUSH_N / length
            speed = (mass * speed + dt * (spring + unlike)) / (mass + dt * grip.damping_n_s_per_mm)
            off = off + dt * speed
        recorded = min(float(last), recorded + _pace(float(np.sqrt(off @ off))))
        before, at = at, _between(hand.hand_mm, recorded) + off
        given += float(force @ (at - before))
        most_given = max(most_given, given)
        axis = _between(hand.axis, recorded)
        row = int(recorded)
        step = session.step(hand_mm=at, axis=axis / np.linalg.norm(axis), pedal=bool(hand.pedal[row]), burr=int(hand.burr[row]) if burr is None else burr)
        force = step.force_n
        peak = max(peak, float(np.sqrt(force @ force)))
        force_off += step.fault != ""
        with_fixture += bool(step.fixture_force_n.any())
        ticks += 1
    return Felt(TICK_S * ticks, recorded >= last, peak, most_given, -given, TICK_S * with_fixture, TICK_S * force_off)


def _pace(apart_mm: float) -> float:
    share = (SLOWEST_PACE_FROM_MM - apart_mm) / (SLOWEST_PACE_FROM_MM - FULL_PACE_WITHIN_MM)
    return min(1.0, max(SLOWEST_PACE, share))


def _between(rows: Any, place: float) -> Any:
    """The value between rows that are a tick apart."""
    first = int(place)
    share = place - first
    return rows[first] if share == 0.0 else (1.0 - share) * rows[first] + share * rows[first + 1]


def inline_tables(fixtures: list[dict[str, Any]]) -> str:
    """As the value of a scene's key `fixture`, on one line."""
    return "[" + ", ".join(_inline(one) for one in fixtures) + "]"


def _inline(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_inline(one)}" for key, one in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(_inline(one) for one in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return _quoted(value) if isinstance(value, str) else repr(value)


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def read_fixtures(file: pathlib.Path) -> list[dict[str, Any]]:
    """The fixtures of a TOML file that holds [[fixture]] and nothing else; their meaning is checked by the scene. RuntimeError in one line."""
    import tomllib

    try:
        found = tomllib.loads(file.read_text())
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise RuntimeError(f"{file}: is no TOML: {error}") from None
    fixtures = found.pop("fixture", None)
    if found or not isinstance(fixtures, list) or not fixtures or not all(isinstance(one, dict) for one in fixtures):
        raise RuntimeError(f"{file}: takes [[fixture]] tables and nothing else{_besides(found)}")
    return fixtures


def _besides(found: dict[str, Any]) -> str:
    return f"; it has '{next(iter(found))}'" if found else ""


def with_stiffness(fixtures: list[dict[str, Any]], n_per_mm: float | None) -> list[dict[str, Any]]:
    """That of those that have a spring; None: as they are."""
    if n_per_mm is None:
        return fixtures
    return [one if one.get("kind") == "slow" else one | {"stiffness_n_per_mm": n_per_mm} for one in fixtures]
