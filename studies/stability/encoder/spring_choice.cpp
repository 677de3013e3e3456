#include "studies/stability/encoder/spring_choice.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/output/study_run.h"
#include "common/program/progress.h"
#include "devices/haply/inverse3_profile.h"
#include "devices/hid/arm_kinematics.h"
#include "devices/hid/profile_file.h"
#include "studies/stability/encoder/encoder_noise.h"
#include "studies/stability/rails/force_response.h"

namespace osteomill::study {
namespace {

constexpr std::array springs_n_per_mm{0.5, 1.0, 1.5, 2.0, 3.0, 4.5};

double bandwidth_hz(double stiffness_n_per_mm) {
    constexpr double half_power = 0.71;
    double low_hz = 0.1;
    double high_hz = 100.0;
    for (int i = 0; i < 7; ++i) {
        const double hz = std::sqrt(low_hz * high_hz);
        (std::abs(respond("implicit", stiffness_n_per_mm, hz).response) > half_power ? low_hz : high_hz) = hz;
    }
    return std::sqrt(low_hz * high_hz);
}

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
    const StudyRun run(out, surroundings);
    Table table({"arm", "coupling", "stiffness_n_per_mm", "is_chosen", "bandwidth_hz", "noise_n",
                 "largest_jump_n", "limited_by"});
    std::map<double, double> bandwidths_hz;
    const auto bandwidth_of = [&](double spring_n_per_mm) {
        const auto found = bandwidths_hz.find(spring_n_per_mm);
        return found != bandwidths_hz.end()
                   ? found->second
                   : bandwidths_hz.emplace(spring_n_per_mm, bandwidth_hz(spring_n_per_mm)).first->second;
    };
    const auto arms = shipped_arms();
    run.chapter("springs", [&](const ReportProgress& progress) {
        for (std::size_t a = 0; a < arms.size(); ++a) {
            const auto& [name, arm] = arms[a];
            const auto add = [&, &name = name, &arm = arm](const char* coupling, double spring_n_per_mm,
                                                           bool is_chosen, double hz,
                                                           const std::string& limited_by) {
                const EncoderNoise noise = drill_tooth(arm, coupling, spring_n_per_mm);
                table.add({name, coupling, spring_n_per_mm, is_chosen, hz, noise.noise_n,
                           noise.largest_jump_n, limited_by});
            };
            for (const double spring : springs_n_per_mm)
                add("implicit", spring, false, bandwidth_of(spring), "");
            const DeviceLimits limits = limits_of(arm);
            const double chosen = limits.max_stiffness_n_per_mm;
            add("implicit", chosen, true, bandwidth_of(chosen), limits.stiffness_is_limited_by);
            // The published ones have no spring, and pass all of it where they hold.
            for (const char* published : {"interpolate", "sample-estimate-interpolate"})
                add(published, chosen, false, 0.0, "");
            progress(static_cast<double>(a + 1) / static_cast<double>(arms.size()));
        }
    });
    run.write(table, "springs");
    run.draw({"springs"});
    run.say("{}", table.csv());
}

}  // namespace osteomill::study
