"""Charts of the study `arms`."""

import pandas as pd
from matplotlib.figure import Figure

from osteomill.studies import charts
from osteomill.studies.arms import CHATTER_N

COLOURS = (charts.SKY, charts.BLUE, charts.GREEN, charts.GREY, charts.PINK, charts.RED)
NO_STEP_MM = 0.0015  # where an encoder without steps stands on a logarithmic axis


def encoder(table: pd.DataFrame) -> Figure:
    figure = charts.figure(10.0, 4.6)
    figure.suptitle("The tooth scene with finer and coarser encoders")
    noise, jumps = figure.subplots(1, 2)
    steps_mm = table["step_mm"].where(table["step_mm"] > 0.0, NO_STEP_MM)
    for axes, column, label, colour in ((noise, "noise_percent", "force above 5 Hz, rms, % of the mean force", charts.BLUE),
                                        (jumps, "jumps_per_s", "jumps of over 0.03 N a second", charts.RED)):
        axes.plot(steps_mm, table[column], marker="o", color=colour)
        axes.set(xscale="log", xlabel="encoder step, mm (leftmost: none)", ylabel=label, ylim=(0.0, None))
        axes.set_xticks(list(steps_mm), [f"{step:g}" for step in table["step_mm"]])
        axes.set_xticks([], minor=True)
    return figure


def response(table: pd.DataFrame) -> Figure:
    figure = charts.figure(10.0, 7.6)
    figure.suptitle("Force on the hand beside that on a rigid burr: 5 mm, 10 000 rpm, a slot 1 mm deep")
    gain, phase = figure.subplots(2, 1, sharex=True)
    for colour, ((coupling, stiffness), rows) in zip(COLOURS, table.groupby(["coupling", "stiffness_n_per_mm"], sort=False)):
        gain.plot(rows["hz"], rows["gain"], marker="o", color=colour, label=f"{coupling} {stiffness:g} N/mm")
        phase.plot(rows["hz"], rows["phase_deg"].where(rows["phase_deg"] <= 20.0, rows["phase_deg"] - 360.0), marker="o", color=colour)
    gain.set(xscale="log", yscale="log", ylabel="gain")
    gain.yaxis.set_major_formatter("{x:g}")
    gain.legend(ncol=2)
    phase.set(xlabel="frequency, Hz", ylabel="phase, degrees")
    phase.set_xticks(sorted(set(table["hz"])), [f"{hz:g}" for hz in sorted(set(table["hz"]))])
    phase.set_xticks([], minor=True)
    return figure


def springs(table: pd.DataFrame) -> Figure:
    figure = charts.figure(13.0, 4.8)
    figure.suptitle("Springs of the shipped arms; filled: what each gets; crosses: the published coupling")
    passed, peak, noise = figure.subplots(1, 3)
    of_springs = ((passed, "bandwidth_hz"), (peak, "share_of_peak"))
    first = table["arm"].iloc[0]
    for colour, (arm, rows) in zip((charts.BLUE, charts.RED, charts.GREEN, charts.PINK, charts.AMBER), table.groupby("arm", sort=False)):
        sprung = rows[rows["coupling"] == "implicit"].sort_values("stiffness_n_per_mm")
        gets = sprung[sprung["is_chosen"]]
        published = rows[rows["coupling"] == "interpolate"]
        for axes, number in of_springs:
            if arm == first:
                axes.plot(sprung["stiffness_n_per_mm"], sprung[number], marker="o", markerfacecolor="white", color=charts.GREY)
            axes.plot(gets["stiffness_n_per_mm"], gets[number], marker="o", markersize=8, color=colour, linestyle="none")
        noise.plot(sprung["stiffness_n_per_mm"], sprung["noise_n"], marker="o", markerfacecolor="white", color=colour, label=arm)
        noise.plot(gets["stiffness_n_per_mm"], gets["noise_n"], marker="o", markersize=8, color=colour, linestyle="none")
        noise.plot(published["stiffness_n_per_mm"], published["noise_n"], marker="x", color=colour, linestyle="none")
    passed.set(xlabel="spring at the arm, N/mm", ylabel="force passed up to, Hz", xlim=(0.0, 5.0), ylim=(0.0, None))
    peak.set(xlabel="spring at the arm, N/mm", ylabel="share of the exact peak of a plunge", xlim=(0.0, 5.0), ylim=(0.0, 1.0))
    noise.set(xlabel="spring at the arm, N/mm", ylabel="force above 5 Hz, N rms", xlim=(0.0, 5.0), ylim=(0.0, None))
    noise.legend(loc="center right")
    return figure


def slide(table: pd.DataFrame) -> Figure:
    """A panel a way, a row a grip, a column a speed: the arm as it is, and in brackets the ideal one."""
    ways = list(dict.fromkeys(table["way"]))
    figure = charts.figure(10.0, 2.6 * len(ways) + 1.0)
    figure.suptitle(f"Polishing: limit cycle of the force on the hand, N rms; red: {CHATTER_N:g} N and more, which is chatter\n"
                    "large: the arm as it is; in brackets: without friction and encoder steps, which hide limit cycles")
    for axes, way in zip(figure.subplots(len(ways), 1, squeeze=False)[:, 0], ways):
        rows = table[table["way"] == way]
        grips, speeds = list(dict.fromkeys(rows["grip"])), sorted(set(rows["rpm"]))
        for _, row in rows.iterrows():
            place = (speeds.index(row["rpm"]), grips.index(row["grip"]) + (-0.22 if row["is_ideal"] else 0.12))
            text = f"({row['limit_cycle_n']:.2f})" if row["is_ideal"] else f"{row['limit_cycle_n']:.2f}"
            axes.text(*place, text, ha="center", va="center", fontsize=9 if row["is_ideal"] else 12,
                      color=charts.RED if row["limit_cycle_n"] >= CHATTER_N else charts.BLUE)
        axes.set(xlim=(-0.5, len(speeds) - 0.5), ylim=(-0.5, len(grips) - 0.5), ylabel="grip", title=way)
        axes.set_xticks(range(len(speeds)), [f"{rpm / 1000.0:g}" for rpm in speeds])
        axes.set_yticks(range(len(grips)), grips)
        axes.grid(False)
    axes.set_xlabel("spindle, 1000 rpm")
    return figure
