#include "studies/stability/encoder/spring_choice.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ostream>
#include <utility>

#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"
#include "devices/haply/inverse3_profile.h"
#include "devices/hid/arm_kinematics.h"
#include "devices/hid/profile_file.h"
#include "imaging/progress.h"
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

SpringRow row_of(const std::string& name, const ArmModel& arm, const std::string& coupling,
                 double stiffness_n_per_mm) {
    const EncoderNoise noise = drill_tooth(arm, coupling, stiffness_n_per_mm);
    return {.arm = name,
            .coupling = coupling,
            .stiffness_n_per_mm = stiffness_n_per_mm,
            .noise_n = noise.noise_n,
            .largest_jump_n = noise.largest_jump_n};
}

std::string springs_csv(const std::vector<SpringRow>& rows) {
    std::string csv =
        "arm,coupling,stiffness_n_per_mm,is_chosen,bandwidth_hz,noise_n,largest_jump_n,limited_by\n";
    for (const SpringRow& r : rows)
        csv +=
            fmt::format("{},{},{:.3g},{},{:.3g},{:.3g},{:.3g},{}\n", r.arm, r.coupling, r.stiffness_n_per_mm,
                        r.is_chosen ? 1 : 0, r.bandwidth_hz, r.noise_n, r.largest_jump_n, r.limited_by);
    return csv;
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
    ProgressLine line(surroundings.progress, surroundings.is_terminal, "springs");
    const auto arms = shipped_arms();
    std::vector<double> widths_hz;
    for (const double spring : springs_n_per_mm) widths_hz.push_back(bandwidth_hz(spring));
    std::vector<SpringRow> rows;
    for (std::size_t a = 0; a < arms.size(); ++a) {
        const auto& [name, arm] = arms[a];
        for (std::size_t i = 0; i < springs_n_per_mm.size(); ++i) {
            rows.push_back(row_of(name, arm, "implicit", springs_n_per_mm[i]));
            rows.back().bandwidth_hz = widths_hz[i];
        }
        const DeviceLimits limits = limits_of(arm);
        rows.push_back(row_of(name, arm, "implicit", limits.max_stiffness_n_per_mm));
        rows.back().is_chosen = true;
        rows.back().limited_by = limits.stiffness_is_limited_by;
        rows.back().bandwidth_hz = bandwidth_hz(limits.max_stiffness_n_per_mm);
        // The published ones have no spring, and pass all of it where they hold.
        for (const char* published : {"interpolate", "sample-estimate-interpolate"})
            rows.push_back(row_of(name, arm, published, limits.max_stiffness_n_per_mm));
        line.report(static_cast<double>(a + 1) / static_cast<double>(arms.size()), "");
    }
    write_text(springs_csv(rows), out / "springs.csv");
    draw_chart(chart_scripts(), "springs", out);
    surroundings.said << springs_csv(rows);
}

}  // namespace osteomill::study
