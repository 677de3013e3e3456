#include "studies/loads/loads_study.h"

#include <fmt/format.h>

#include "analysis/output/output_files.h"
#include "analysis/output/table.h"
#include "common/scene/material.h"
#include "studies/loads/pressed_burr.h"

namespace osteomill::study {

namespace {

const Burr burr{
    .diameter_mm = 1.5, .spindle_rev_per_s = 40'000.0 / 60.0, .edge_coefficients_n_per_mm = {0.3, 0.3, 0.0}};

std::string rate_text(const PressedResult& result) {
    return result.sinks ? "sinks" : fmt::format("{:.3f}", result.removal_mm3_per_s);
}

}  // namespace

void run_loads_study(const std::filesystem::path& out, const StudySurroundings& surroundings) {
    Table table({"material", "load_n", "law", "removal_mm3_per_s", "depth_mm", "sinks"});
    surroundings.said << "mm^3/s: full law, published law\n";
    for (const Material& material : shipped_materials()) {
        std::string line = fmt::format("{:34}", material.name);
        for (const double load_n : {0.34, 0.64, 1.05}) {
            line += fmt::format("{:.2f} N ", load_n);
            for (const bool is_full : {true, false}) {
                PressedStroke stroke{.burr = burr, .material = material, .load_n = load_n};
                if (!is_full) stroke.burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
                const PressedResult result = press(stroke);
                table.add({material.name, load_n, is_full ? "full" : "published", result.removal_mm3_per_s,
                           result.depth_mm, result.sinks});
                line += fmt::format("{:>7}{}", rate_text(result), is_full ? "," : "   ");
            }
        }
        surroundings.said << line << '\n';
    }
    table.write(out / "loads.csv");
}

}  // namespace osteomill::study
