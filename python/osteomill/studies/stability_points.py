"""The points of the stability map: every coupling against every resistance, grip, milling rate and delay that a surgeon
or an arm may bring.

Two scenes: `cutting`, a 5 mm burr at the end of the slot that it has cut, fed on along it; `wall`, the spindle is off
and the burr is pressed on the bone. Three grips: the bare arm under a steady push, a light and a firm hand. Three parts:

    map          an ideal device, without the encoder steps and Coulomb friction that hide limit cycles: the source of
                 regions and shares;
    bars         `implicit` over the range that it must hold, denser in depth and speed: bone of K_t = 230 N/mm^2, up
                 to the burr fully immersed, up to one tick of delay;
    real-device  a sample of the map on a device with encoder steps and friction.

Always the same list in the same order; the study takes its length times the CPU time of a point (0.1 s).
"""

import functools
import itertools
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from osteomill import Burr, _studies

Point = dict[str, Any]

#: The couplings that are compared, names as of --coupling; the first is the one that the bars are for.
METHODS = ("implicit", "virtual-coupling", "hold", "interpolate", "sample-estimate-hold", "sample-estimate-interpolate",
           "corrected-sample-estimate-hold", "hold+damper", "interpolate+damper", "hold+passivity", "interpolate+passivity")
SCENES = ("cutting", "wall")
GRIPS = ("bare-arm", "light", "firm")
MILLING_RATES_HZ = (100.0, 300.0, 1000.0)
DELAYS_TICKS = (0, 1, 2, 3)  # haptic ticks from a reading of the device to its force, beyond the loop's own

#: A burr in a slot: spindle in rpm, depth in mm, stiffness of the bone (1: K_t = 230 N/mm^2). In ascending order of
#: resistance, about as far apart on a logarithmic scale: 4 to 3500 N s/m. Neighbours reach their resistance in different
#: ways: the resistance alone must decide.
CONDITIONS = (
    (80e3, 0.1, 1.0), (40e3, 0.1, 0.7), (80e3, 0.25, 0.7), (80e3, 0.25, 1.0), (10e3, 0.1, 0.4), (20e3, 0.1, 1.0),
    (10e3, 0.1, 0.7), (80e3, 0.75, 1.0), (20e3, 0.25, 1.0), (80e3, 3.5, 0.4), (80e3, 2.5, 0.7), (10e3, 0.75, 0.4),
    (5e3, 0.5, 0.4), (10e3, 0.75, 0.7), (20e3, 1.5, 1.0), (10e3, 2.5, 0.4), (40e3, 5.0, 1.0), (10e3, 2.5, 0.7),
    (20e3, 5.0, 1.0), (5e3, 1.5, 1.0), (5e3, 5.0, 0.4), (10e3, 5.0, 1.0), (5e3, 3.5, 1.0), (5e3, 5.0, 1.0))
QUICK_CONDITIONS = ((80e3, 0.1, 1.0), (20e3, 0.1, 1.0), (80e3, 3.5, 0.4), (20e3, 1.5, 1.0), (20e3, 5.0, 1.0), (5e3, 5.0, 1.0))
WALLS_N_PER_MM = (0.1, 0.15, 0.22, 0.32, 0.47, 0.69, 1.0, 1.7)  # stiffest spring that the device claims to render
QUICK_WALLS_N_PER_MM = (0.1, 1.7)

EDGE_N_PER_MM = 0.3  # as the tooth scene's burrs rub
GETS_ON_WITH_N = 1.0  # two thirds of the force that the scene's hand gives


def map_points(quick: bool, edge_forces: bool) -> list[Point]:
    """`quick`: a coarser grid of every axis; `edge_forces`: cutting alone, by burrs whose edges rub, where a hand that
    may press with 1.5 N still gets on."""
    conditions = QUICK_CONDITIONS if quick else CONDITIONS
    walls = QUICK_WALLS_N_PER_MM if quick else WALLS_N_PER_MM
    rates, delays = ((100.0, 1000.0), (0, 1)) if quick else (MILLING_RATES_HZ, DELAYS_TICKS)
    scenes = [*map(cutting, conditions), *map(wall, walls)]
    points = [point for method in METHODS for point in _every("map", method, scenes, rates, delays)]
    speeds, depths_mm = ((5e3, 80e3), (0.25, 5.0)) if quick else ((5e3, 10e3, 20e3, 40e3, 80e3), (0.25, 1.0, 2.5, 5.0))
    slots = [cutting((rpm, depth_mm, 1.0)) for rpm in speeds for depth_mm in depths_mm]
    points += _every("bars", METHODS[0], slots, rates, (0, 1))
    sample = [*map(cutting, conditions[::2]), wall(WALLS_N_PER_MM[-1])]
    points += [point for method in METHODS for point in _every("real-device", method, sample, (100.0, 1000.0), (0,))]
    if edge_forces:
        points = [point | {"edge_n_per_mm": EDGE_N_PER_MM} for point in points if point["scene"] == "cutting"]
        points = [point for point in points if hand_gets_on(point)]
    return points


def cutting(condition: tuple[float, float, float]) -> Point:
    spindle_rpm, depth_mm, stiffness = condition
    return {"scene": "cutting", "spindle_rpm": spindle_rpm, "depth_mm": depth_mm, "relative_stiffness": stiffness,
            "wall_n_per_mm": 1.5, "edge_n_per_mm": 0.0}


def wall(n_per_mm: float) -> Point:
    return cutting((10e3, 1.0, 1.0)) | {"scene": "wall", "wall_n_per_mm": n_per_mm}


def _every(part: str, method: str, scenes: Iterable[Point], rates: Sequence[float], delays: Sequence[int]) -> list[Point]:
    """Every scene with every grip, rate and delay."""
    return [{"part": part, "method": method, **scene, "grip": grip, "milling_rate_hz": rate, "delay_ticks": delay,
             "is_ideal_device": part != "real-device"}
            for scene, grip, rate, delay in itertools.product(scenes, GRIPS, rates, delays)]


def hand_gets_on(point: Point) -> bool:
    """Whether edges alone take no more than two thirds of the force that the scene's hand gives."""
    return bool(point["relative_stiffness"] * _force_of_edges_n(point["edge_n_per_mm"], point["depth_mm"]) <= GETS_ON_WITH_N)


@functools.cache
def _force_of_edges_n(edge_n_per_mm: float, depth_mm: float) -> float:
    burr = Burr(diameter_mm=5.0, cutting_coefficients_n_per_mm2=(0.0, 0.0, 0.0),
                edge_coefficients_n_per_mm=(edge_n_per_mm, edge_n_per_mm, 0.0))
    return float(np.linalg.norm(_studies.reference_force(burr, (0.0, 0.0, 2.5 - depth_mm), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))))


def text_of(point: Point) -> str:
    scene = (f"cutting {point['depth_mm']:g} mm deep at {point['spindle_rpm']:g} rpm in bone of stiffness "
             f"{point['relative_stiffness']:g}" if point["scene"] == "cutting" else f"wall of {point['wall_n_per_mm']:g} N/mm")
    return (f"{point['method']}, {scene}, {point['grip']}, {point['milling_rate_hz']:g} Hz, {point['delay_ticks']} ticks late, "
            f"{'ideal' if point['is_ideal_device'] else 'real'} device")
