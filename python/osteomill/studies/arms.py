"""Effects of an arm on the force: its encoder's steps, the coupling's spring, and speed and grip of the published slide.

- Encoders: the tooth scene, drilled by a firm hand with arms that differ in their encoder's step alone. Noise: rms of the
  force above 5 Hz, over the ticks with a force. A jump: more than 0.03 N between two ticks.
- Response: a hand on rails whose feed swings, through a slot; the force on it over that on a burr that is rigidly the hand.
- Springs: each shipped arm with its own spring and with softer and stiffer ones: the frequency up to which 0.71 of the force is
  passed, the share of the peak when a firm hand plunges into bone (stability_onset.py), and the noise in the tooth scene.
- Slide: the published experiment in strokes of 8 mm, by spindle speed and grip: the limit cycle of the force on the hand. It is
  the rms, below which nine tenths of half-second windows stay, of the force less its mean over 0.1 s; with the arm as it is, and
  without friction and encoder steps, which hide limit cycles.
"""

import argparse
import functools
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from osteomill import Case, _studies
from osteomill.studies import stability_onset
from osteomill.studies.study_run import StudyRun

NAME = "arms"
HELP = "what an arm makes of the force: encoder steps, springs, grips"

TICK_S = 0.001
LEAST_NOISE_HZ, LEAST_FORCE_N, FELT_JUMP_N = 5.0, 0.005, 0.03
HALF_POWER = 0.71
STEPS_MM = (0.0, 0.003, 0.006, 0.0125, 0.025, 0.055, 0.1)
FREQUENCIES_HZ = (0.3, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 30.0)
# Springs that the simulated arm can render, and softer and stiffer ones.
RESPONSES = (("implicit", 0.5), ("implicit", 1.5), ("implicit", 5.0), ("implicit", 15.0), ("sample-estimate-hold", 1.5),
             ("interpolate", 1.5))
SPRINGS_N_PER_MM = (0.5, 1.0, 1.5, 2.0, 3.0, 4.5)
UNSPRUNG = ("interpolate", "sample-estimate-interpolate")  # the published ones, which pass all of the force where they hold
# kg, N/mm, N s/mm: the simulator's two hands, one between them, one twice as stiff and heavy as the firm.
GRIPS = {"light": (0.1, 0.1, 0.002), "medium": (0.3, 0.2, 0.0035), "firm": (0.5, 0.3, 0.005), "braced": (1.0, 0.6, 0.01)}
SLIDE_RPM = (10_000.0, 20_000.0, 40_000.0, 80_000.0, 160_000.0, 320_000.0)
# Coupling and milling rate by name in the chart.
SLIDE_WAYS = {"interpolate, 100 Hz (as published)": ("interpolate", 100.0),
              "sample-estimate-hold, 100 Hz": ("sample-estimate-hold", 100.0), "implicit, 1 kHz (default)": ("implicit", 1000.0)}
WINDOW_S, SLOW_PART_S, CHATTER_N = 0.5, 0.1, 0.2

Forces = NDArray[np.float64]  # (n, 3), a line a tick


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--quick", action="store_true", help="fewer arms, springs, speeds and grips, shorter runs: a minute")


def cases(quick: bool) -> list[dict[str, Any]]:
    def thin(values: Any, by: int) -> list[Any]:
        return list(values)[::by] if quick else list(values)

    longest_s = 3.0 if quick else 60.0
    arms = {name: arm.stiffness_n_per_mm for name, arm in _studies.shipped_arms()}
    made: list[dict[str, Any]] = [{"part": "encoder", "step_mm": step, "longest_s": longest_s} for step in thin(STEPS_MM, 3)]
    made += [{"part": "response", "coupling": coupling, "stiffness_n_per_mm": stiffness, "hz": hz}
             for coupling, stiffness in thin(RESPONSES, 3) for hz in thin(FREQUENCIES_HZ, 3)]
    springs = thin(SPRINGS_N_PER_MM, 3)
    chosen = thin(arms.items(), 4)
    made += [{"part": "bandwidth", "stiffness_n_per_mm": spring} for spring in sorted({*springs, *(get for _, get in chosen)})]
    for arm, gets in chosen:
        wanted = [("implicit", spring, False) for spring in springs] + [("implicit", gets, True)] + [(c, gets, False) for c in UNSPRUNG]
        made += [{"part": "spring", "arm": arm, "coupling": coupling, "stiffness_n_per_mm": spring, "is_chosen": is_chosen,
                  "longest_s": longest_s} for coupling, spring, is_chosen in wanted]
    made += [{"part": "slide", "way": way, "grip": grip, "rpm": rpm, "is_ideal": ideal, "longest_s": 4.0 if quick else 45.0}
             for way in SLIDE_WAYS for grip in thin(GRIPS, 3) for rpm in thin(SLIDE_RPM, 3) for ideal in (False, True)]
    return made


@functools.lru_cache(2)
def _case(name: str, rpm: float | None = None) -> Case:
    return Case(name) if rpm is None else Case(name, rpm=rpm, set=["trajectory.width_mm=8"])


def measure(case: dict[str, Any]) -> dict[str, float]:
    if case["part"] == "encoder":
        arm = _studies.ArmModel(resolution_mm=case["step_mm"])
        return noise_of(_studies.forces_on_hand(_case("tooth"), arm, longest_s=case["longest_s"]))
    if case["part"] == "response":
        response, rigid_n_s_per_m = _studies.force_response(case["coupling"], case["stiffness_n_per_mm"], case["hz"])
        return {"gain": abs(response), "phase_deg": float(np.degrees(np.angle(response))), "rigid_n_s_per_m": rigid_n_s_per_m}
    if case["part"] == "bandwidth":
        return {"bandwidth_hz": _bandwidth_hz(case["stiffness_n_per_mm"]),
                "share_of_peak": stability_onset.share_of_peak(case["stiffness_n_per_mm"])}
    if case["part"] == "spring":
        arm = dict(_studies.shipped_arms())[case["arm"]]
        return noise_of(_studies.forces_on_hand(_case("tooth"), arm, coupling=case["coupling"], longest_s=case["longest_s"],
                                                stiffness_n_per_mm=case["stiffness_n_per_mm"]))
    return _slide(case)


def _slide(case: dict[str, Any]) -> dict[str, float]:
    coupling, rate_hz = SLIDE_WAYS[case["way"]]
    arm = _studies.ArmModel(coulomb_friction_n=0.0, resolution_mm=0.0) if case["is_ideal"] else _studies.ArmModel()
    force_n = _studies.forces_on_hand(_case("cube", case["rpm"]), arm, hand=GRIPS[case["grip"]], coupling=coupling,
                                      milling_rate_hz=rate_hz, longest_s=case["longest_s"])
    return {"limit_cycle_n": limit_cycle_n(force_n), "lasted_s": TICK_S * len(force_n)}


def noise_of(force_n: Forces) -> dict[str, float]:
    """Noise of a force; all 0 without a force."""
    from scipy import signal

    jumps_n = np.linalg.norm(np.diff(force_n, axis=0), axis=1)
    felt = np.linalg.norm(force_n, axis=1) >= LEAST_FORCE_N
    if not felt.any():
        return {"mean_force_n": 0.0, "noise_n": 0.0, "largest_jump_n": float(jumps_n.max(initial=0.0)), "jumps_per_s": 0.0}
    # The filter starts as if all values before the first had been equal to it.
    high_pass = signal.butter(2, LEAST_NOISE_HZ, "highpass", fs=1.0 / TICK_S, output="sos")
    before = signal.sosfilt_zi(high_pass)[:, :, None] * force_n[0]
    above_n, _ = signal.sosfilt(high_pass, force_n, axis=0, zi=before)
    return {"mean_force_n": float(np.linalg.norm(force_n[felt], axis=1).mean()),
            "noise_n": float(np.sqrt((above_n[felt] ** 2).sum(axis=1).mean())),
            "largest_jump_n": float(jumps_n.max(initial=0.0)),
            "jumps_per_s": float((jumps_n > FELT_JUMP_N).sum() / (felt.sum() * TICK_S))}


def limit_cycle_n(force_n: Forces) -> float:
    from scipy import ndimage

    fast_n = force_n - ndimage.uniform_filter1d(force_n, round(SLOW_PART_S / TICK_S), axis=0, mode="nearest")
    window = round(WINDOW_S / TICK_S)
    whole = len(fast_n) // window * window
    if whole == 0:
        return 0.0
    by_window = np.sqrt((fast_n[:whole].reshape(-1, window, 3) ** 2).sum(axis=2).mean(axis=1))
    return float(np.percentile(by_window, 90))


def _bandwidth_hz(stiffness_n_per_mm: float) -> float:
    low_hz, high_hz = 0.1, 100.0
    for _ in range(7):
        hz = float(np.sqrt(low_hz * high_hz))
        passes = abs(_studies.force_response("implicit", stiffness_n_per_mm, hz)[0]) > HALF_POWER
        low_hz, high_hz = (hz, high_hz) if passes else (low_hz, hz)
    return float(np.sqrt(low_hz * high_hz))


def _name_of(case: dict[str, Any]) -> str:
    return ", ".join(f"{value:g}" if isinstance(value, float) else str(value) for key, value in case.items() if key != "longest_s")


def tables_of(choices: list[dict[str, Any]], outcomes: list[dict[str, float]]) -> dict[str, pd.DataFrame]:
    """Tables by name, each of NAME.csv."""
    def of(part: str) -> pd.DataFrame:
        return pd.DataFrame([{key: value for key, value in case.items() if key not in ("part", "longest_s")} | found
                             for case, found in zip(choices, outcomes) if case["part"] == part])

    encoder, springs = of("encoder"), of("spring")
    encoder.insert(3, "noise_percent", 100.0 * encoder["noise_n"] / encoder["mean_force_n"])
    passed = of("bandwidth").set_index("stiffness_n_per_mm")
    for number in ("bandwidth_hz", "share_of_peak"):
        springs[number] = springs["stiffness_n_per_mm"].map(passed[number]).where(springs["coupling"] == "implicit")
    limited_by = {name: arm.limited_by for name, arm in _studies.shipped_arms()}
    springs["limited_by"] = springs["arm"].map(limited_by).where(springs["is_chosen"], "")
    return {"encoder": encoder, "response": of("response"), "springs": springs, "slide": of("slide")}


def run(options: argparse.Namespace, study: StudyRun) -> None:
    choices = cases(options.quick)
    tables = tables_of(choices, study.sweep(measure, choices, _name_of))
    from osteomill.studies import arms_charts

    for name, table in tables.items():
        study.table(name, table)
        study.chart(name, getattr(arms_charts, name)(table))
    study.say(f"{', '.join(tables)}: tables (CSV) and charts (SVG) are in {study.out}")
