#include "studies/stability/encoder/tissue_forces.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/output/study_run.h"
#include "analysis/output/table.h"
#include "imaging/phantoms/phantom.h"
#include "studies/stability/encoder/encoder_noise.h"
#include "studies/stability/encoder/spring_choice.h"

namespace osteomill::study {
namespace {

constexpr double weber_fraction = 0.1;
constexpr double weber_from_n = 0.5;

/// Over no force at all.
double noticeable_level(double force_n) {
    const double linear = std::min(force_n / weber_from_n, 1.0);
    return (linear + std::log(std::max(force_n / weber_from_n, 1.0))) / weber_fraction;
}

}  // namespace

double noticeable_differences(double from_n, double to_n) {
    return noticeable_level(to_n) - noticeable_level(from_n);
}

void run_tissue_study(const std::filesystem::path& out, const StudySurroundings& surroundings) {
    struct Drilling {
        std::string tissue;
        std::string arm_name;
        ArmModel arm;
    };
    std::vector<Drilling> drillings;
    for (const Tissue& tissue : phantom_scene("tooth").tissues)
        for (const auto& [name, arm] : shipped_arms()) drillings.push_back({tissue.name, name, arm});
    StudyRun run(out, surroundings);
    const auto planned = run.plan(
        drillings, [](const Drilling& d) { return d.tissue + ", " + d.arm_name; },
        [](const Drilling& d) {
            return drill_tooth(d.arm, "implicit", std::nullopt, d.tissue).mean_force_n;
        });
    if (!run.perform()) return;
    Table table({"tissue", "arm", "friction_n", "mean_force_n", "noticeable_differences"});
    auto drilling = drillings.begin();
    for (const double force_n : planned.outcomes()) {
        const double friction_n = drilling->arm.coulomb_friction_n;
        table.add({drilling->tissue, drilling->arm_name, friction_n, force_n,
                   noticeable_differences(friction_n, friction_n + force_n)});
        ++drilling;
    }
    run.write(table, "tissues");
    run.say("{}", table.csv());
}

}  // namespace osteomill::study
