#include "studies/stability/encoder/spring_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "analysis/output/study_run.h"
#include "devices/haply/inverse3_profile.h"
#include "devices/hid/arm_kinematics.h"
#include "devices/hid/profile_file.h"
#include "studies/stability/encoder/encoder_noise.h"
#include "studies/stability/rails/force_response.h"

namespace osteomill::study {
namespace {

constexpr const char* sprung_coupling = "implicit";
constexpr std::array springs_n_per_mm{0.5, 1.0, 1.5, 2.0, 3.0, 4.5};

double bandwidth_hz(double stiffness_n_per_mm) {
    constexpr double half_power = 0.71;
    double low_hz = 0.1;
    double high_hz = 100.0;
    for (int i = 0; i < 7; ++i) {
        const double hz = std::sqrt(low_hz * high_hz);
        (std::abs(respond(sprung_coupling, stiffness_n_per_mm, hz).response) > half_power ? low_hz : high_hz) = hz;
    }
    return std::sqrt(low_hz * high_hz);
}

/// An arm with a spring and a coupling.
struct Choice {
    std::string arm_name;
    ArmModel arm;
    std::string coupling;
    double stiffness_n_per_mm;
    bool is_chosen;
    std::string limited_by;
};

}  // namespace

std::vector<std::pair<std::string, ArmModel>> shipped_arms() {
    std::vector<std::pair<std::string, ArmModel>> arms{{"simulated", ArmModel{}}};
    for (const std::string& name : shipped_profile_names()) {
        const ArmProfile profile = load_arm_profile(name);
        constexpr double m_per_mm = 0.001;
        arms.emplace_back(name, ArmModel{.mass_kg = profile.apparent_mass_kg,
                                         .resolution_mm = ArmKinematics(profile).resolution_mm(),
                                         .max_force_n = profile.max_force_n,
                                         .max_stiffness_n_per_mm = m_per_mm * profile.max_stiffness_n_per_m});
    }
    arms.emplace_back("inverse3",
                      ArmModel{.mass_kg = inverse3_profile.apparent_mass_kg,
                               .resolution_mm = inverse3_profile.position_step_mm,
                               .max_force_n = inverse3_profile.max_force_n,
                               .max_stiffness_n_per_mm = inverse3_profile.max_stiffness_n_per_mm});
    return arms;
}

void run_spring_study(const std::filesystem::path& out, const StudySurroundings& surroundings) {
    StudyRun run(out, surroundings);
    std::vector<Choice> choices;
    for (const auto& [name, arm] : shipped_arms()) {
        const auto add = [&, &name = name, &arm = arm](const char* coupling, double spring_n_per_mm,
                                                       bool is_chosen, const std::string& limited_by) {
            choices.push_back({name, arm, coupling, spring_n_per_mm, is_chosen, limited_by});
        };
        for (const double spring : springs_n_per_mm) add(sprung_coupling, spring, false, "");
        const DeviceLimits limits = limits_of(arm);
        const double chosen = limits.max_stiffness_n_per_mm;
        add(sprung_coupling, chosen, true, limits.stiffness_is_limited_by);
        // The published ones have no spring, and pass all of it where they hold.
        for (const char* published : {"interpolate", "sample-estimate-interpolate"})
            add(published, chosen, false, "");
    }
    std::set<double> sprung;
    for (const Choice& c : choices)
        if (c.coupling == sprung_coupling) sprung.insert(c.stiffness_n_per_mm);
    const std::vector<double> springs(sprung.begin(), sprung.end());
    const auto bandwidths = run.plan(
        springs, [](double spring) { return fmt::format("bandwidth of {} N/mm", spring); }, bandwidth_hz);
    const auto noises = run.plan(
        choices,
        [](const Choice& c) {
            return fmt::format("{}, {}, {} N/mm{}", c.arm_name, c.coupling, c.stiffness_n_per_mm,
                               c.is_chosen ? ", chosen" : "");
        },
        [](const Choice& c) { return drill_tooth(c.arm, c.coupling, c.stiffness_n_per_mm); });
    if (!run.perform()) return;
    const std::vector<double> bandwidths_hz = bandwidths.outcomes();
    Table table({"arm", "coupling", "stiffness_n_per_mm", "is_chosen", "bandwidth_hz", "noise_n",
                 "largest_jump_n", "limited_by"});
    auto choice = choices.begin();
    for (const EncoderNoise& noise : noises.outcomes()) {
        const Choice& c = *choice++;
        const auto spring = std::ranges::find(springs, c.stiffness_n_per_mm) - springs.begin();
        const double hz =
            c.coupling == sprung_coupling ? bandwidths_hz[static_cast<std::size_t>(spring)] : 0.0;
        table.add({c.arm_name, c.coupling, c.stiffness_n_per_mm, c.is_chosen, hz, noise.noise_n,
                   noise.largest_jump_n, c.limited_by});
    }
    run.write(table, "springs");
    run.draw({"springs"});
    run.say("{}", table.csv());
}

}  // namespace osteomill::study
