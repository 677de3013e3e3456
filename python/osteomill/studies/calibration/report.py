"""Report of a calibration: its numbers, its residuals, the runs to distrust, a scene fragment, charts."""

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from osteomill.studies import charts
from osteomill.studies.calibration.fit import Fit
from osteomill.studies.calibration.forces import AXES, COEFFICIENTS, FORCES_OF_A_RUN
from osteomill.studies.calibration.runs import FORCES, SPREADS

#: A run is named if chance would put any run of a table so far off in one table of twenty.
SURPRISING = 0.05


@dataclasses.dataclass(frozen=True)
class Calibration:
    """The runs of one material and their results."""

    material: str
    runs: pd.DataFrame
    fit: Fit

    def distrusted(self) -> list[tuple[str, float]]:
        """Runs that are too far from the prediction by the others, with the probability of it for any run of the table."""
        of_any = np.minimum(1.0, len(self.runs) * self.fit.outlying)
        return [(run, float(p)) for run, p in zip(self.runs.run, of_any) if p < SURPRISING]


def cross_validation_of(c: Calibration) -> dict[str, Any]:
    """Root mean square error of the predictions of runs by the others."""
    errors_n = c.runs[FORCES].to_numpy(float) - c.fit.predicted_n
    is_predicted = ~np.isnan(errors_n).any(axis=1)
    in_spreads = errors_n / c.runs[SPREADS].to_numpy(float)
    forces = max(1, FORCES_OF_A_RUN * int(is_predicted.sum()))
    return {
        "rms_n": float(np.sqrt(np.nansum(errors_n**2) / forces)),
        "rms_in_spreads": float(np.sqrt(np.nansum(in_spreads**2) / forces)),
        "runs": int(is_predicted.sum()),
        "indispensable_runs": int((~is_predicted).sum()),
    }


def warnings_of(c: Calibration) -> list[str]:
    """Warnings for a reader of the numbers, each in one sentence."""
    fit = c.fit
    warnings = []
    if fit.widened_by > 1.0:
        warnings.append(
            f"the forces scatter more than their spreads say (chi^2 {fit.chi_squared:.3g} of {fit.degrees_of_freedom} degrees of "
            f"freedom): intervals are widened {fit.widened_by:.2g} times; look for drift, run-out or a law that does not hold in "
            "the residuals")
    for name, value, half_width in zip(COEFFICIENTS, fit.value, fit.half_width):
        if value + half_width < 0.0:
            warnings.append(f"{name} is below 0 with its whole interval: check the signs of the axes, that the force is the "
                            "bone's on the burr, and which way the burr turns")
        elif value - half_width <= 0.0:
            warnings.append(f"{name} may be 0: its interval holds it")
    warnings += [f"without run {run} coefficients cannot be told apart: it alone carries one; repeat it"
                 for run, predicted in zip(c.runs.run, fit.predicted_n) if np.isnan(predicted).any()]
    warnings += [f"run {run} is farther from what the others say than chance puts any run in {p:.2g} of tables: look at its "
                 "record, repeat it" for run, p in c.distrusted()]
    return warnings


def lines_of(c: Calibration) -> list[str]:
    fit = c.fit
    lines = [f"{c.material}: {len(c.runs)} runs, reduced chi^2 {fit.chi_squared / fit.degrees_of_freedom:.2f}, condition "
             f"{fit.condition:.1f}"]
    lines += [f"  {name:<5}{value:10.4g} +- {half_width:<9.2g} {unit}"
              for (name, unit), value, half_width in zip(COEFFICIENTS.items(), fit.value, fit.half_width)]
    lines += [f"  {name:<13}{value:8.2g} +- {half_width:<6.2g} N" for name, value, half_width in _drift(fit)]
    validation = cross_validation_of(c)
    if validation["runs"] > 0:
        lines.append(f"  a run is predicted by the others to {validation['rms_n']:.3g} N rms "
                     f"({validation['rms_in_spreads']:.2f} spreads)")
    return lines + ["  note: " + warning for warning in warnings_of(c)]


def json_of(c: Calibration) -> dict[str, Any]:
    fit = c.fit
    units = COEFFICIENTS | {name: "N" for name, *_ in _drift(fit)}
    unknowns = [
        {"name": name, "unit": units[name], "value": value, "interval_95": [value - half_width, value + half_width],
         "standard_uncertainty": uncertainty}
        for name, value, half_width, uncertainty in zip(fit.unknowns, fit.value, fit.half_width, fit.uncertainty)
    ]
    return {
        "material": c.material,
        "runs": len(c.runs),
        "coefficients": unknowns[: len(COEFFICIENTS)],
        "drift": unknowns[len(COEFFICIENTS) :],
        "correlation": fit.correlation,
        "chi_squared": fit.chi_squared,
        "degrees_of_freedom": fit.degrees_of_freedom,
        "reduced_chi_squared": fit.chi_squared / fit.degrees_of_freedom,
        "probability": fit.probability,
        "widened_by": fit.widened_by,
        "condition": fit.condition,
        "leave_one_run_out": cross_validation_of(c),
        "distrusted_runs": [{"run": run, "probability": p} for run, p in c.distrusted()],
        "warnings": warnings_of(c),
    }


def residuals_of(calibrations: Sequence[Calibration]) -> pd.DataFrame:
    """A line for each force; materials and axes also by number, from 1."""
    tables = []
    for number, c in enumerate(calibrations, 1):
        measured_n, spread_n = c.runs[FORCES].to_numpy(float), c.runs[SPREADS].to_numpy(float)
        tables.append(pd.DataFrame({
            "run": np.repeat(c.runs.run.to_numpy(), FORCES_OF_A_RUN),
            "material": c.material,
            "material_number": number,
            "axis": np.tile(AXES, len(c.runs)),
            "axis_number": np.tile(range(1, FORCES_OF_A_RUN + 1), len(c.runs)),
            "measured_n": measured_n.ravel(),
            "spread_n": spread_n.ravel(),
            "fitted_n": c.fit.fitted_n,
            "residual_in_spreads": (measured_n.ravel() - c.fit.fitted_n) / spread_n.ravel(),
            "predicted_by_others_n": c.fit.predicted_n.ravel(),
        }))
    return pd.concat(tables, ignore_index=True)


def runs_of(calibrations: Sequence[Calibration]) -> pd.DataFrame:
    """A line for each run, the most distrusted first in each material: distance of its forces from the prediction by the others,
    in standard deviations of that difference; the probability of all three, for this run and for any of the table; its weight, 1
    in a fit of least squares.
    """
    tables = []
    for c in calibrations:
        named = dict(c.distrusted())
        table = pd.DataFrame({"run": c.runs.run.to_numpy(), "material": c.material})
        table[[f"studentised_{axis}" for axis in AXES]] = c.fit.studentised
        table["probability"] = c.fit.outlying
        table["weight"] = c.fit.weight.reshape(-1, FORCES_OF_A_RUN).mean(axis=1)
        table["is_distrusted"] = [run in named for run in table.run]
        tables.append(table.sort_values("probability", kind="stable"))
    return pd.concat(tables, ignore_index=True)


def scene_fragment(calibrations: Sequence[Calibration], source: str) -> str:
    """A [[burrs]] table for each material and each burr that cut it, with intervals and source in comments. A
    coefficient below 0, which a scene refuses, is 0 there, and a comment says so.
    """
    head = ("# To copy into a scene. The coefficients are of the bone that was milled, which is then relative\n"
            "# stiffness 1.\n\n")
    return head + "".join(_scene_of(c, source) for c in calibrations)


def _scene_of(c: Calibration, source: str) -> str:
    fit = c.fit
    lines = [
        f"# {c.material}: {len(c.runs)} runs of {source}, osteomill_study calibrate, 95 % intervals, chi^2 {fit.chi_squared:.3g} of "
        f"{fit.degrees_of_freedom} degrees of freedom",
        "#   " + _intervals(fit, 0),
        "#   " + _intervals(fit, 3),
    ]
    lines += [f"#   {name} is below 0, which a scene refuses: 0 here" for name, value in zip(COEFFICIENTS, fit.value) if value < 0.0]
    material = c.material.replace("\\", "\\\\").replace('"', '\\"')
    for burr in c.runs.drop_duplicates(["diameter_mm", "edges", "turns"]).itertuples():
        lines += ["[[burrs]]", f'name = "{burr.diameter_mm:g} mm, {burr.edges:g} edges, {material}"',
                  f"diameter_mm = {burr.diameter_mm:.2f}", f"edges = {burr.edges:g}"]
        if burr.turns == "counter-clockwise":
            lines.append('turns = "counter-clockwise"')
        lines += [f"cutting_coefficients_n_per_mm2 = {_accepted(fit, 0)} # K_t, K_r, K_a",
                  f"edge_coefficients_n_per_mm = {_accepted(fit, 3)} # K_te, K_re, K_ae", ""]
    return "\n".join(lines) + "\n"


def _intervals(fit: Fit, first: int) -> str:
    """Numbers with as many digits as their intervals bear out, and one more."""
    parts = []
    for i, name in list(enumerate(COEFFICIENTS))[first : first + 3]:
        value, half_width = fit.value[i], fit.half_width[i]
        digits = min(6, max(0, 1 - math.floor(math.log10(max(half_width, 1e-6)))))
        parts.append(f"{name} {value:.{digits}f} ({value - half_width:.{digits}f} to {value + half_width:.{digits}f})")
    return f"{', '.join(parts)} {list(COEFFICIENTS.values())[first]}"


def _accepted(fit: Fit, first: int) -> str:
    return "[" + ", ".join(f"{max(0.0, value):#.6g}" for value in fit.value[first : first + 3]) + "]"


def _drift(fit: Fit) -> list[tuple[str, float, float]]:
    fitted = list(zip(fit.unknowns, fit.value, fit.half_width))[len(COEFFICIENTS) :]
    return [(name, float(value), float(half_width)) for name, value, half_width in fitted]


def chart_of_fit(calibrations: Sequence[Calibration]) -> Figure:
    """Measured forces against those of the fitted coefficients, a panel for each material."""
    figure = _panels(calibrations, "Mean forces of the bone on the burr: measured, with their spread, against fitted")
    for axes, c in zip(figure.axes, calibrations):
        fitted_n = c.fit.fitted_n.reshape(-1, FORCES_OF_A_RUN)
        ends = [fitted_n.min(), fitted_n.max()]
        axes.plot(ends, ends, color=charts.GREY, label="equal")
        for axis, (label, colour, marker) in enumerate(SERIES):
            axes.errorbar(fitted_n[:, axis], c.runs[FORCES[axis]], c.runs[SPREADS[axis]], fmt=marker, color=colour, label=label)
        axes.set_ylabel("measured, N")
        axes.legend(loc="upper left")
    return figure


def chart_of_residuals(calibrations: Sequence[Calibration]) -> Figure:
    """Residual of each force, in spreads, against the force, a panel for each material."""
    figure = _panels(calibrations, "Measured less fitted force: 95 % should lie between the dashed lines")
    for axes, c in zip(figure.axes, calibrations):
        fitted_n = c.fit.fitted_n.reshape(-1, FORCES_OF_A_RUN)
        left = (c.runs[FORCES].to_numpy(float) - fitted_n) / c.runs[SPREADS].to_numpy(float)
        for bound in (-1.96, 0.0, 1.96):
            axes.axhline(bound, color=charts.GREY, linestyle="--" if bound else "-")
        for axis, (label, colour, marker) in enumerate(SERIES):
            axes.plot(fitted_n[:, axis], left[:, axis], marker, color=colour, label=label)
        largest = max(3.0, float(np.abs(left).max()))
        axes.set_ylim(-1.3 * largest, 1.3 * largest)
        axes.set_ylabel("residual, spreads")
        axes.legend(loc="upper center", ncols=len(SERIES))
    return figure


SERIES = (("along the feed", charts.BLUE, "o"), ("across, to the left", charts.RED, "s"), ("up", charts.GREEN, "^"))


def _panels(calibrations: Sequence[Calibration], title: str) -> Figure:
    columns = min(3, len(calibrations))
    rows = -(-len(calibrations) // columns)
    figure = charts.figure(1.5 + 5.0 * columns, 5.0 * rows)
    figure.suptitle(title)
    for place, c in enumerate(calibrations, 1):
        axes = figure.add_subplot(rows, columns, place)
        axes.set_title(c.material, parse_math=False)
        axes.set_xlabel("fitted, N")
    return figure
