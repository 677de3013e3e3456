#include "studies/stability/encoder/tissue_forces.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/output/study_run.h"
#include "analysis/output/table.h"
#include "common/program/progress.h"
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
    const StudyRun run(out, surroundings);
    const auto arms = shipped_arms();
    const Scene scene = phantom_scene("tooth");
    Table table({"tissue", "arm", "friction_n", "mean_force_n", "noticeable_differences"});
    run.chapter("tissues", [&](const ReportProgress& progress) {
        for (std::size_t i = 0; i < scene.tissues.size(); ++i) {
            const std::string& tissue = scene.tissues[i].name;
            for (const auto& [name, arm] : arms) {
                const double force_n = drill_tooth(arm, "implicit", std::nullopt, tissue).mean_force_n;
                const double friction_n = arm.coulomb_friction_n;
                table.add({tissue, name, friction_n, force_n,
                           noticeable_differences(friction_n, friction_n + force_n)});
            }
            progress(static_cast<double>(i + 1) / static_cast<double>(scene.tissues.size()));
        }
    });
    run.write(table, "tissues");
    run.say("{}", table.csv());
}

}  // namespace osteomill::study
