"""A motion of the study `states`, worked out: its samples, which a file of HDF5 holds, and features of windows of 0.1 s."""

import dataclasses
import pathlib
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from osteomill import Burr, Case, _studies
from osteomill.studies import states_sensor
from osteomill.studies.states_motions import Motion, Path, bone_name, case_of_motion, path_of
from osteomill.studies.states_sensor import RATE_HZ, ForceSensor, finer, held
from osteomill.studies.states_truth import STATES, Truth, has_ct, state_of, time_to_breakthrough_s, truth_of

Array = NDArray[np.float64]

WINDOW_S = 0.1
BANDS_HZ = ((20, 200), (200, 800), (800, 1500), (1500, 2500), (2500, 5000))

# Column of the samples: unit, what it is. Vectors are in patient LPS, forces those of the bone on the burr.
COLUMNS = {
    "time_s": ("s", "since the motion began"),
    "position_mm": ("mm", "centre of the burr"),
    "force_n": ("N", "force within the tooth period, exact"),
    "measured_force_n": ("N", "the same as the sensor reads it"),
    "vibration_n": ("N", "the handpiece's vibration as the simulator renders it to a hand, up to 300 Hz"),
    "sound": ("1", "the simulator's sound of the burr, -1 to 1; 48 kHz of it is in /sound"),
    "engaged_mm2": ("mm^2", "surface of the burr that touches bone"),
    "engaged_share": ("1", "the same of the whole ball's surface"),
    "removed_mm3_per_s": ("mm^3/s", "bone that is removed"),
    "ct_hu": ("HU", "CT number in the middle of the cut; nan where nothing is cut"),
    "relative_stiffness": ("1", "of what is cut, 1: cortical bone; 0 where nothing is cut"),
    "tissue": ("1", "label in the middle of the cut, as the attribute tissues of the file names it; 0: none"),
    "wall_mm": ("mm", "shortest way from the ball to the far side or a protected structure; nan: over 6 mm"),
    "thickness_mm": ("mm", "the same along the feed; nan: over 6 mm, or the burr stands"),
    "state": ("1", "number in the attribute states of the file"),
    "time_to_breakthrough_s": ("s", "0 from breakthrough on; nan: the motion has none"),
}
SIGNALS = ("force_n", "measured_force_n", "vibration_n", "sound")  # filtered where rows are left out


@dataclasses.dataclass(frozen=True)
class Samples:
    columns: dict[str, NDArray[Any]]  # by COLUMNS, at RATE_HZ
    sound: NDArray[np.float32]  # at 48 kHz
    sensor: ForceSensor
    about: dict[str, Any]


def samples_of(motion: Motion) -> Samples:
    case = case_of_motion(motion)
    path = path_of(motion, case)
    burr = case.burrs[path.burr]
    if not _studies.is_ball(burr):
        raise ValueError(f"the burr '{burr.name}' is no ball: the study takes balls alone")
    rng = np.random.default_rng([motion["seed"], 5, motion["number"]])
    sensor = ForceSensor.drawn(rng)
    has_scan = "plate" not in motion and has_ct(case)
    found = labelled(case, path, has_scan)
    columns = columns_of(found, path, burr, sensor, rng)
    about = {"bone": bone_name(motion), "kind": motion["kind"], "number": motion["number"], "seed": motion["seed"],
             "split_by_case": motion["split_by_case"], "split_by_motion": motion["split_by_motion"],
             "burr": burr.name, "diameter_mm": burr.diameter_mm, "edges": burr.edges, "rpm": burr.rpm,
             "axis": path.axes.mean(axis=0), "bone_checksum": case.bone.checksum(), "scene": _studies.scene_text(case),
             "states": list(STATES), "tissues": [f"{label} {name}" for name, label in case.tissues.items()],
             "ct_hu_from": "the scan" if has_scan else "the stiffness, by Keyak's relation",
             "rate_hz": RATE_HZ, **{f"sensor_{key}": value for key, value in dataclasses.asdict(sensor).items()}}
    return Samples(columns, found.milled["sound"], sensor, about)


@dataclasses.dataclass(frozen=True)
class Labelled:
    """A path, milled: an entry a millisecond, from the second pose on."""

    milled: dict[str, NDArray[Any]]
    truth: Truth
    state: NDArray[np.uint8]


def labelled(case: Case, path: Path, has_scan: bool) -> Labelled:
    """The path's first row is where the burr is put down; each further row is a step."""
    milled = _studies.mill_path(case, path.burr, path.positions_mm, path.axes, path.spindle_on)
    radius_mm = 0.5 * case.burrs[path.burr].diameter_mm
    truth = truth_of(case, path.positions_mm[1:], path.axes[1:], milled["normal"], milled["relative_stiffness"], radius_mm, has_scan)
    return Labelled(milled, truth, state_of(np.asarray(milled["normal"].any(axis=1)), truth.wall_mm, truth.stiffness))


def columns_of(found: Labelled, path: Path, burr: Burr, sensor: ForceSensor, rng: np.random.Generator) -> dict[str, NDArray[Any]]:
    from scipy import signal

    milled, truth = found.milled, found.truth
    force_n = states_sensor.force_within_tooth_n(milled, burr, rng.uniform(0.0, 2.0 * np.pi))
    rows = len(force_n)
    state_rows = held(found.state)
    return {
        "time_s": (1 + np.arange(rows)) / RATE_HZ,
        "position_mm": finer(path.positions_mm[1:]),
        "force_n": force_n,
        "measured_force_n": sensor.read(force_n, rng),
        "vibration_n": finer(milled["vibration_n"]),
        "sound": signal.resample_poly(milled["sound"], RATE_HZ, _studies.SOUND_HZ)[:rows],
        "engaged_mm2": held(milled["engaged_mm2"]),
        "engaged_share": held(milled["engaged_mm2"] / (np.pi * burr.diameter_mm**2)),
        "removed_mm3_per_s": held(1000.0 * milled["removed_mm3"]),
        "ct_hu": held(truth.ct_hu),
        "relative_stiffness": held(milled["relative_stiffness"]),
        "tissue": held(truth.tissue),
        "wall_mm": finer(truth.wall_mm),
        "thickness_mm": finer(truth.thickness_mm),
        "state": state_rows,
        "time_to_breakthrough_s": time_to_breakthrough_s(state_rows, 1.0 / RATE_HZ),
    }


def write_hdf5(file: pathlib.Path, samples: Samples, every: int) -> None:
    """The same samples, the same bytes. Beside, then renamed. `every`: one row in so many."""
    import h5py

    part = file.with_suffix(".part")
    with h5py.File(part, "w", libver=("earliest", "v110")) as out:
        out.attrs.update({"program": "osteomill_study states", "version": _studies.VERSION, "commit": _studies.COMMIT, **samples.about})
        out.attrs["rate_hz"] = RATE_HZ / every
        group = out.create_group("samples")
        for name, (unit, what) in COLUMNS.items():
            rows = samples.columns[name]
            rows = states_sensor.thinned(rows, every) if name in SIGNALS else rows[::every]
            kind = np.uint8 if rows.dtype == np.uint8 else np.float64 if name == "time_s" else np.float32
            group.create_dataset(name, data=rows.astype(kind), compression="gzip", compression_opts=1, shuffle=True)
            group[name].attrs.update({"unit": unit, "what": what})
        out.create_dataset("sound", data=samples.sound, compression="gzip", compression_opts=1, shuffle=True)
        out["sound"].attrs.update({"unit": "1", "what": COLUMNS["sound"][1].partition(";")[0], "rate_hz": _studies.SOUND_HZ})
    part.replace(file)


def windows_of(samples: Samples) -> list[dict[str, Any]]:
    """Features of whole windows, from what is measured; beside them the truth at the window's end."""
    columns = samples.columns
    size = round(WINDOW_S * RATE_HZ)
    windows = []
    for end in range(size, len(columns["time_s"]) + 1, size):
        here, last = slice(end - size, end), end - 1
        measured_n = columns["measured_force_n"][here]
        mean_n = measured_n.mean(axis=0)
        features = {f"force_{axis}_n": float(value) for axis, value in zip("xyz", mean_n)}
        features |= {"force_n": float(np.linalg.norm(mean_n)), "force_rms_n": _rms(measured_n - mean_n)}
        features |= {f"force_{low}_{high}_hz_n": value for (low, high), value in zip(BANDS_HZ, band_rms(measured_n - mean_n))}
        sound = columns["sound"][here]
        features |= {"vibration_rms_n": _rms(columns["vibration_n"][here]), "sound_rms": _rms(sound)}
        features |= {f"sound_{low}_{high}_hz": value for (low, high), value in zip(BANDS_HZ, band_rms(sound[:, None]))}
        windows.append({"time_s": float(columns["time_s"][last])} | features
                       | {name: _number(columns[name][last]) for name in ("engaged_share", "ct_hu", "wall_mm", "thickness_mm",
                                                                          "time_to_breakthrough_s")}
                       | {"state": STATES[int(columns["state"][last])]})
    return windows


def band_rms(signal_rows: NDArray[Any]) -> list[float]:
    """Root mean square within each of BANDS_HZ, of all axes together, by Parseval's theorem."""
    power = (np.abs(np.fft.rfft(signal_rows, axis=0)) ** 2).sum(axis=1) * 2.0 / len(signal_rows) ** 2
    hz = np.fft.rfftfreq(len(signal_rows), 1.0 / RATE_HZ)
    return [float(np.sqrt(power[(hz >= low) & (hz < high)].sum())) for low, high in BANDS_HZ]


def _rms(rows: NDArray[Any]) -> float:
    return float(np.sqrt((rows.reshape(len(rows), -1) ** 2).sum(axis=1).mean()))


def _number(value: Any) -> float | None:
    return float(value) if np.isfinite(value) else None


def windows_table(motions: list[Motion], outcomes: list[list[dict[str, Any]]]) -> pd.DataFrame:
    """A line a window, behind whose it is."""
    return pd.DataFrame([
        {"motion": motion["number"], "bone": bone_name(motion), "kind": motion["kind"], "split_by_case": motion["split_by_case"],
         "split_by_motion": motion["split_by_motion"]} | window
        for motion, windows in zip(motions, outcomes) for window in windows])
