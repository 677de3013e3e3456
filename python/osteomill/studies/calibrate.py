"""The six coefficients of the milling law from runs on a dynamometer, or a choice of the runs that a lab should make.

The runs of each material are fitted by themselves (calibration/fit.py). `--design` reads none, but chooses the most informative
ones (calibration/design.py). docs/calibration.md has the lab's work in between.
"""

import argparse
import dataclasses
import math
import pathlib
from typing import Any

import numpy as np
import pandas as pd

from osteomill.studies.calibration import report
from osteomill.studies.calibration.design import Design, Lattice, candidates_of, efficiency, one_factor_at_a_time, optimal_design
from osteomill.studies.calibration.fit import Fit, fit_forces, refuse_one_feed
from osteomill.studies.calibration.forces import COEFFICIENTS, DRIFTS, forces_of
from osteomill.studies.calibration.runs import SENSES, read_runs, table_to_fill_in
from osteomill.studies.options import Parser, UsageError, listed, number_within, one_of, whole_within
from osteomill.studies.study_run import StudyRun

WRITES = ("calibration.json", "calibration_*.svg", "residuals.csv", "runs.csv", "scene.toml")

#: Lists of --design: bounds, and what their numbers are.
LISTS = {
    "diameters_mm": (0.2, 20.0, "burrs at hand"),
    "feeds_mm_per_s": (0.001, 1000.0, "feeds that can be set"),
    "rpm": (100.0, 500_000.0, "spindle speeds that can be set"),
    "depths_mm": (0.001, 10.0, "depths that can be set; none is taken that is deeper than a burr's radius"),
    "tilts_deg": (0.0, 85.0, "tilts of the spindle from upright"),
    "tilt_directions_deg": (-360.0, 360.0, "where the shank leans: 0 ahead along the feed, 90 to the left of it"),
}
OF_DESIGN = (*LISTS, "edges", "turns", "runs", "material", "spread_n", "seed")


def add_options(parser: Parser) -> None:
    parser.add_argument("data", nargs="?", type=pathlib.Path, help="table of runs (CSV): docs/calibration.md")
    parser.add_argument("--drift", type=one_of(*DRIFTS), default="none", metavar="WAY",
                        help="fit a drift of the dynamometer, too, by the order of the runs: none; slope, from a zero before the "
                        "first run; line, whose zero is fitted as well (%(default)s)")
    parser.add_argument("--robust", action="store_true",
                        help="give forces that are far from the law little weight, and take the intervals from the runs (jackknife)")
    parser.add_argument("--design", action="store_true",
                        help="choose the runs that tell most (D-optimal) and write OUT/design.csv to fill in; no table is read")
    for name, (low, high, what) in LISTS.items():
        usual = list(getattr(Lattice, name))
        parser.add_argument(f"--{name.replace('_', '-')}", type=listed(number_within(low, high)), default=usual, metavar="LIST",
                            help=f"{what}, separated by commas ({','.join(f'{value:g}' for value in usual)})")
    parser.add_argument("--edges", type=whole_within(1, 64), default=Lattice.edges, metavar="N", help="of the burrs (%(default)s)")
    parser.add_argument("--turns", type=one_of(*SENSES), default=Lattice.turns, metavar="SENSE",
                        help=f"{' or '.join(SENSES)}, seen from the handpiece (%(default)s)")
    parser.add_argument("--runs", type=whole_within(3, 1000), default=24, metavar="N", help="how many to choose (%(default)s)")
    parser.add_argument("--material", type=_material, default="bone", metavar="NAME",
                        help="for the column of that name; no comma (%(default)s)")
    parser.add_argument("--spread-n", type=number_within(1e-6, 100.0), default=0.05, metavar="N",
                        help="standard deviation of a mean force, for which the intervals to expect are printed (%(default)s)")
    parser.add_argument("--seed", type=whole_within(0, 2**63 - 1), default=1, metavar="N",
                        help="of the designs from which the search starts (%(default)s)")


def run(options: argparse.Namespace, study: StudyRun) -> None:
    _require_one_task(options)
    if options.design:
        choose_runs(options, study)
    else:
        calibrate(options, study)


def calibrate(options: argparse.Namespace, study: StudyRun) -> None:
    """Fits each material of the table, in the table's order."""
    tables = [table for _, table in read_runs(options.data).groupby("material", sort=False)]
    how = {"data": str(options.data), "drift": options.drift, "is_robust": options.robust}
    outcomes = study.sweep(
        fit_material,
        [how | {"runs": table.to_dict("list")} for table in tables],
        name=lambda case: f"material {case['runs']['material'][0]}",
    )
    calibrations = [
        report.Calibration(table.material.iloc[0], table, Fit(**{key: _array_or_same(value) for key, value in outcome.items()}))
        for table, outcome in zip(tables, outcomes)
    ]
    for calibration in calibrations:
        for line in report.lines_of(calibration):
            study.say(line)
    study.json("calibration", [report.json_of(calibration) for calibration in calibrations])
    study.table("residuals", report.residuals_of(calibrations))
    study.table("runs", report.runs_of(calibrations))
    study.text("scene.toml", report.scene_fragment(calibrations, options.data.name))
    study.chart("calibration_fit", report.chart_of_fit(calibrations))
    study.chart("calibration_residuals", report.chart_of_residuals(calibrations))
    study.say(f"calibration.json, residuals.csv, runs.csv, scene.toml and charts (SVG) are in {study.out}")


def fit_material(case: dict[str, Any]) -> dict[str, Any]:
    runs = pd.DataFrame(case["runs"])
    try:
        refuse_one_feed(runs)
        return dataclasses.asdict(fit_forces(forces_of(runs, case["drift"]), case["is_robust"]))
    except ValueError as error:
        raise ValueError(f"{case['data']}: {error}") from None


def choose_runs(options: argparse.Namespace, study: StudyRun) -> None:
    """Writes a table to fill in, and compares it with the obvious choice."""
    case = {name: getattr(options, name) for name in OF_DESIGN}
    [chosen] = study.sweep(designed, [case], name=lambda case: "design")
    study.text("design.csv", chosen["table"])
    for line in [*chosen["table"].splitlines(), *chosen["summary"]]:
        study.say(line)
    study.say(f"the table to fill in is {study.out / 'design.csv'}")


def designed(case: dict[str, Any]) -> dict[str, Any]:
    lattice = Lattice(**{name: case[name] for name in (*LISTS, "edges", "turns")})
    settings, regressors = candidates_of(lattice)
    design = optimal_design(settings, regressors, case["runs"], case["seed"])
    obvious = one_factor_at_a_time(lattice, case["runs"])
    ratio = efficiency(design, obvious)
    summary = [
        f"{case['runs']} runs of {len(settings)} candidates; 95 % intervals for spreads of {case['spread_n']:g} N:",
        _text_of("these runs:", design, case["spread_n"]),
        _text_of("one factor at a time:", obvious, case["spread_n"]),
        f"each of these runs tells as much as {ratio:.2f} of the other choice" if math.isfinite(ratio)
        else "the other choice does not tell the coefficients apart",
    ]
    return {"table": table_to_fill_in(design.settings, case["material"]), "summary": summary}


def _text_of(name: str, design: Design, spread_n: float) -> str:
    intervals = [f"{symbol} +- {1.96 * spread_n * uncertainty:.2g}" for symbol, uncertainty in zip(COEFFICIENTS, design.uncertainty)]
    return (f"{name:<26} determinant {design.determinant:9.3g}, condition {design.condition:5.3g}, intervals "
            f"{', '.join(intervals)}")


def _require_one_task(options: argparse.Namespace) -> None:
    if options.design and options.data:
        raise UsageError("--design excludes data")
    if not (options.design or options.data):
        raise UsageError("a table of runs, or --design is required")
    usual = Parser()
    add_options(usual)
    for name in () if options.design else OF_DESIGN:
        if getattr(options, name) != usual.get_default(name):
            raise UsageError(f"--{name.replace('_', '-')} requires --design")
    for name in ("drift", "robust") if options.design else ():
        if getattr(options, name) != usual.get_default(name):
            raise UsageError(f"--design excludes --{name}")


def _material(text: str) -> str:
    if "," in text:
        raise argparse.ArgumentTypeError("a name with a comma parts its column")
    return text


def _array_or_same(value: Any) -> Any:
    return np.array(value) if isinstance(value, list) and not isinstance(value[0], str) else value
