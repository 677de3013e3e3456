"""Recorded hands once more, with and without a virtual fixture: what it saves, and what it costs.

Each recording is played in closed loop on the virtual clock (assisted_hand.py), for each grip without the fixture and with it
at each stiffness. So a hand is its own control: all else is equal to the bit. Differences are paired by recording, averaged by
trainee, and their mean over trainees has Student's interval of 95 %.
"""

import argparse
import functools
import pathlib
import tempfile
from typing import Any

import pandas as pd

from osteomill import Case, Recording, Session, _studies
from osteomill.studies.assisted_hand import GRIPS, RecordedHand, inline_tables, play, read_fixtures, with_stiffness
from osteomill.studies.options import existing_file, listed, number_above_zero, number_within, one_of
from osteomill.studies.study_run import StudyRun

NAME = "assist"
HELP = "recorded hands once more, with and without a virtual fixture: damage, time, force"
WRITES = ("*.csv", "*.json", "*.svg", "assist.html")

# Column, as people are told of it, its unit.
OUTCOMES = (("structure_mm3", "milled of protected structures", "mm³"), ("structure_touches", "touches of them", ""),
            ("plan_removed_share", "share of the plan removed", ""), ("time_s", "time", "s"),
            ("energy_to_hand_mj", "energy to the hand", "mJ"), ("peak_force_n", "peak force on the hand", "N"))
RECORDED, WITHOUT, WITH = "as recorded", "without", "with"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--recordings", type=pathlib.Path, required=True, metavar="DIR",
                        help="a folder of recordings, or of folders of haptic_server --report")
    parser.add_argument("--fixture", type=existing_file, required=True, metavar="FILE.toml", help="[[fixture]] tables of a scene (docs/scenes.md)")
    parser.add_argument("--stiffness", type=listed(number_within(0.01, 20.0)), metavar="N/MM,...",
                        help="of the fixtures' springs, one after the other (default: as the file says)")
    parser.add_argument("--grips", type=listed(one_of(*GRIPS)), default=list(GRIPS), metavar="GRIP,...",
                        help=f"of {', '.join(GRIPS)} (default: all)")
    parser.add_argument("--case", metavar="NAME|DIR", help="that was recorded (default: the built-in one that the recordings name)")
    parser.add_argument("--burr", metavar="NAME", help="of the case's burrs, in place of those that were recorded")
    parser.add_argument("--rpm", type=number_above_zero, help="of the spindle (default: the burr's own)")


def measure(asked: dict[str, Any]) -> dict[str, Any]:
    """One recording, played once; with neither grip nor fixture, as it was recorded."""
    recording = Recording(asked["recording"])
    if asked["grip"] is None:
        return _damage(recording, recording.metrics()) | {"time_s": recording.metrics()["time_s"]}
    hand = RecordedHand.of(recording)
    case = _case(asked["case"] or recording.info()["case"], asked["burr"], asked["rpm"], tuple(asked["set"]))
    with tempfile.TemporaryDirectory(prefix="osteomill-assist-") as folder:
        file = pathlib.Path(folder, "played.pcap")
        with Session(case, start_mm=hand.hand_mm[0], start_axis=hand.axis[0], record=file) as session:
            felt = play(session, hand, GRIPS[asked["grip"]], burr=None if asked["burr"] is None else case.start_burr)
        played = Recording(file)
        _require_same_bone(recording, played)
        return _damage(played, played.metrics()) | {
            "time_s": felt.time_s, "came_to_end": felt.came_to_end, "peak_force_n": felt.peak_force_n,
            "energy_to_hand_mj": felt.energy_to_hand_mj, "energy_from_hand_mj": felt.energy_from_hand_mj,
            "fixture_s": felt.fixture_s, "force_off_s": felt.force_off_s}


@functools.lru_cache(4)
def _case(name: str, burr: str | None, rpm: float | None, changes: tuple[str, ...]) -> Case:
    return Case(name, burr=burr, rpm=rpm, set=list(changes))


def _require_same_bone(recording: Recording, played: Recording) -> None:
    bones = [one.info()["settings"].get("bone_digest") for one in (recording, played)]
    if bones[0] != bones[1]:
        raise RuntimeError(f"{recording.file}: began with another bone than its case has; name its case with --case")


def _damage(recording: Recording, metrics: dict[str, Any]) -> dict[str, Any]:
    def sum_of(key: str) -> float:
        return float(sum(value or 0.0 for value in metrics.get(key, {}).values()))

    return {"structure_mm3": sum_of("structure_dose_mm3_of"), "structure_touches": sum_of("structure_touches_of"),
            "structure_entered_mm3": sum_of("structure_entered_mm3_of"), "removed_mm3": metrics["removed_mm3"],
            "plan_removed_share": metrics.get("plan_removed_share"), "peak_force_n": metrics["peak_force_n"]}


def cases_of(options: argparse.Namespace) -> list[dict[str, Any]]:
    from osteomill.studies.sessions.records import recordings_in

    fixtures = read_fixtures(options.fixture)
    made: list[dict[str, Any]] = []
    for file in recordings_in([options.recordings]):
        shared = {"recording": str(file), "case": options.case, "burr": options.burr, "rpm": options.rpm}
        made.append(shared | {"grip": None, "fixture": RECORDED, "stiffness_n_per_mm": None, "set": []})
        for grip in options.grips:
            made.append(shared | {"grip": grip, "fixture": WITHOUT, "stiffness_n_per_mm": None, "set": []})
            made += [shared | {"grip": grip, "fixture": WITH, "stiffness_n_per_mm": stiffness,
                               "set": ["fixture=" + inline_tables(with_stiffness(fixtures, stiffness))]}
                     for stiffness in options.stiffness or [None]]
    return made


def _name_of(case: dict[str, Any]) -> str:
    how = [case["grip"], case["fixture"]] if case["grip"] else [case["fixture"]]
    if case["stiffness_n_per_mm"] is not None:
        how.append(f"{case['stiffness_n_per_mm']:g} N/mm")
    return ", ".join([case["recording"], *how])


def table_of(cases: list[dict[str, Any]], outcomes: list[dict[str, Any]], trainees: dict[str, str]) -> pd.DataFrame:
    rows = [{"recording": case["recording"], "trainee": trainees[case["recording"]], "grip": case["grip"], "fixture": case["fixture"],
             "stiffness_n_per_mm": case["stiffness_n_per_mm"]} | found for case, found in zip(cases, outcomes)]
    table = pd.DataFrame(rows)
    for key in ("stiffness_n_per_mm", *(key for key, _, _ in OUTCOMES)):
        table[key] = pd.to_numeric(table[key])  # all None is no number
    return table


def effects_of(table: pd.DataFrame) -> pd.DataFrame:
    """With less without, of each grip and stiffness: paired by recording, averaged by trainee."""
    from osteomill.studies.sessions.statistics import mean_of

    rows = []
    played = table[table["fixture"] != RECORDED]
    for grip, of_grip in played.groupby("grip", sort=False):
        without = of_grip[of_grip["fixture"] == WITHOUT].set_index("recording")
        for stiffness, helped in of_grip[of_grip["fixture"] == WITH].groupby("stiffness_n_per_mm", sort=False, dropna=False):
            helped = helped.set_index("recording")
            for key, _, unit in OUTCOMES:
                pairs = pd.DataFrame({"trainee": helped["trainee"], WITH: helped[key], WITHOUT: without[key]}).dropna()
                by_trainee = pairs.groupby("trainee")[[WITH, WITHOUT]].mean()
                differences = (by_trainee[WITH] - by_trainee[WITHOUT]).tolist()
                mean = mean_of(differences)
                if mean is None:
                    continue
                low, high = mean.interval or (None, None)
                rows.append({"grip": grip, "stiffness_n_per_mm": stiffness, "outcome": key, "unit": unit, "trainees": mean.n,
                             "recordings": len(pairs), "mean_without": float(by_trainee[WITHOUT].mean()),
                             "mean_with": float(by_trainee[WITH].mean()), "difference": mean.mean, "low": low, "high": high})
    return pd.DataFrame(rows)


def run(options: argparse.Namespace, study: StudyRun) -> None:
    cases = cases_of(options)
    outcomes = study.sweep(measure, cases, _name_of)
    trainees = {case["recording"]: _studies.read_session(case["recording"])["trainee"] for case in cases if case["grip"] is None}
    table = table_of(cases, outcomes, trainees)
    effects = effects_of(table)
    from osteomill.studies import assist_charts, assist_page

    drawn = {"assist": assist_charts.outcomes(table), "effects": assist_charts.effects(effects)}
    study.table("assist", table)
    study.table("effects", effects)
    for name, figure in drawn.items():
        study.chart(name, figure)
    study.text("assist.html", assist_page.page(table, effects, drawn, options.fixture.read_text(), _tools_text(options)))
    for _, row in effects.iterrows():
        if row["outcome"] == "structure_mm3":
            interval = "" if pd.isna(row["low"]) else f" ({row['low']:.3g} to {row['high']:.3g})"
            study.say(f"{row['grip']} grip{_stiffness_text(row['stiffness_n_per_mm'])}: milled of protected structures {row['mean_without']:.3g} -> "
                      f"{row['mean_with']:.3g} mm3, {row['difference']:+.3g}{interval}, {row['trainees']} trainees")
    study.say(f"assist and effects: tables (CSV), charts (SVG) and a page with both (assist.html) are in {study.out}")


def _tools_text(options: argparse.Namespace) -> str:
    """In place of what was recorded; empty: nothing is."""
    return ", ".join([*([f"burr {options.burr}"] if options.burr else []), *([f"{options.rpm:g} rpm"] if options.rpm else [])])


def _stiffness_text(n_per_mm: Any) -> str:
    return "" if pd.isna(n_per_mm) else f", {n_per_mm:g} N/mm"
