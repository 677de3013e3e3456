#include "studies/polishing/speed_and_grip.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace osteomill::study {

namespace {

/// Of the hands of hand_model.h, whose values are mass, stiffness and damping.
HandModel between(const HandModel& a, const HandModel& b) {
    return {.mass_kg = std::sqrt(a.mass_kg * b.mass_kg),
            .stiffness_n_per_mm = std::sqrt(a.stiffness_n_per_mm * b.stiffness_n_per_mm),
            .damping_n_s_per_mm = std::sqrt(a.damping_n_s_per_mm * b.damping_n_s_per_mm)};
}

HandModel twice(const HandModel& a) {
    return {.mass_kg = 2.0 * a.mass_kg,
            .stiffness_n_per_mm = 2.0 * a.stiffness_n_per_mm,
            .damping_n_s_per_mm = 2.0 * a.damping_n_s_per_mm};
}

struct StudiedCoupling {
    std::string name;
    double milling_rate_hz;
};

std::vector<StudiedCoupling> studied_couplings() {
    return {{"interpolate", published_milling_rate_hz},
            {"sample-estimate-interpolate", published_milling_rate_hz},
            {"sample-estimate-hold", published_milling_rate_hz},
            {"implicit", 1000.0}};
}

/// From the published speed to that of an air turbine.
std::vector<double> studied_speeds_rpm(bool quick) {
    if (quick) return {20'000.0, 320'000.0};
    return {10'000.0, 20'000.0, 40'000.0, 80'000.0, 160'000.0, 320'000.0};
}

ArmModel ideal_arm() {
    return {.coulomb_friction_n = 0.0, .resolution_mm = 0.0};
}

FigureRun without_record(FigureRun figure) {
    figure.run.record = {};
    figure.windows = {};
    return figure;
}

bool are_one_block(const SpeedAndGrip& a, const SpeedAndGrip& b) {
    return a.figure.setup.coupling == b.figure.setup.coupling && a.is_ideal_arm == b.is_ideal_arm;
}

}  // namespace

std::vector<NamedGrip> studied_grips(bool quick) {
    const HandModel light = hand_model(Grip::light);
    const HandModel firm = hand_model(Grip::firm);
    if (quick) return {{"firm", firm}};
    return {{"light", light}, {"medium", between(light, firm)}, {"firm", firm}, {"braced", twice(firm)}};
}

std::vector<SpeedAndGrip> sweep_speed_and_grip(const Specimen& cube, bool quick,
                                               const std::filesystem::path& folder,
                                               const Progress& progress) {
    std::vector<SpeedAndGrip> planned;
    for (const StudiedCoupling& coupling : studied_couplings())
        for (const bool is_ideal_arm : quick ? std::vector{false} : std::vector{false, true})
            for (const NamedGrip& grip : studied_grips(quick))
                for (const double rpm : studied_speeds_rpm(quick))
                    planned.push_back({.grip = grip.name,
                                       .is_ideal_arm = is_ideal_arm,
                                       .figure = {.setup = {.coupling = coupling.name,
                                                            .milling_rate_hz = coupling.milling_rate_hz,
                                                            .spindle_rpm = rpm,
                                                            .hand = grip.hand,
                                                            .arm = is_ideal_arm ? ideal_arm() : ArmModel{}},
                                                  .run = {}}});
    const std::filesystem::path log = folder / "one_of_the_sweep.csv";
    double done = 0.0;
    for (SpeedAndGrip& point : planned) {
        const PolishingSetup setup = point.figure.setup;
        point.figure = without_record(judged(setup, run_by_hand(cube, setup, log)));
        progress(++done / static_cast<double>(planned.size()));
    }
    std::filesystem::remove(log);
    return planned;
}

std::string csv_of(const std::vector<SpeedAndGrip>& swept) {
    std::string csv =
        "coupling,milling_rate_hz,arm,grip,rpm,steady,limit_cycle_n,onset_depth_mm,mean_force_n,slide_s,"
        "largest_depth_mm,stray_mm\n";
    for (const SpeedAndGrip& point : swept) {
        const FigureRun& f = point.figure;
        csv += fmt::format("{},{:.0f},{},{},{:.0f},{:d},{:.4f},{},{:.4f},{:.2f},{:.3f},{:.3f}\n",
                           f.setup.coupling, f.setup.milling_rate_hz, point.is_ideal_arm ? "ideal" : "real",
                           point.grip, f.setup.spindle_rpm, point.is_steady() ? 1 : 0, f.limit_cycle_n,
                           f.onset_mm ? fmt::format("{:.3f}", *f.onset_mm) : "", f.mean_force_n,
                           f.run.slide_s, f.run.depth_mm, f.run.stray_mm);
    }
    return csv;
}

std::string table_of(const std::vector<SpeedAndGrip>& swept) {
    std::string table;
    for (std::size_t i = 0; i < swept.size(); ++i) {
        const SpeedAndGrip& point = swept[i];
        const bool begins_block = i == 0 || !are_one_block(swept[i - 1], point);
        if (begins_block) {
            table +=
                fmt::format("{}, milling at {:.0f} Hz, {}\n        rpm", point.figure.setup.coupling,
                            point.figure.setup.milling_rate_hz,
                            point.is_ideal_arm ? "arm without friction and encoder steps" : "arm as it is");
            for (std::size_t k = i;
                 k < swept.size() && are_one_block(point, swept[k]) && swept[k].grip == point.grip; ++k)
                table += fmt::format("{:>8.0f} ", swept[k].figure.setup.spindle_rpm);
        }
        if (begins_block || swept[i - 1].grip != point.grip) table += fmt::format("\n    {:<7}", point.grip);
        table += fmt::format("{:>8.3f}{}", point.figure.limit_cycle_n, point.is_steady() ? ' ' : '*');
        if (i + 1 == swept.size() || !are_one_block(point, swept[i + 1])) table += '\n';
    }
    return table;
}

}  // namespace osteomill::study
