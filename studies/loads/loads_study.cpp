#include "studies/loads/loads_study.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "analysis/output/study_run.h"
#include "common/scene/material.h"
#include "studies/loads/pressed_burr.h"

namespace osteomill::study {

namespace {

const Burr burr{
    .diameter_mm = 1.5, .spindle_rev_per_s = 40'000.0 / 60.0, .edge_coefficients_n_per_mm = {0.3, 0.3, 0.0}};

constexpr std::array loads_n{0.34, 0.64, 1.05};
constexpr std::string_view full_law = "full";

std::string_view law_of(const PressedStroke& stroke) {
    return stroke.burr.edge_coefficients_n_per_mm == glm::dvec3(0.0) ? "published" : full_law;
}

std::string rate_text(const PressedResult& result) {
    return result.sinks ? "sinks" : fmt::format("{:.3f}", result.removal_mm3_per_s);
}

}  // namespace

void run_loads_study(const std::filesystem::path& out, const StudySurroundings& surroundings) {
    std::vector<PressedStroke> strokes;
    for (const Material& material : shipped_materials())
        for (const double load_n : loads_n)
            for (const bool is_full : {true, false}) {
                strokes.push_back({.burr = burr, .material = material, .load_n = load_n});
                if (!is_full) strokes.back().burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
            }
    StudyRun run(out, surroundings);
    const auto planned = run.plan(
        strokes,
        [](const PressedStroke& s) {
            return fmt::format("{}, {} N, {} law", s.material.name, s.load_n, law_of(s));
        },
        press);
    if (!run.perform()) return;
    Table table({"material", "load_n", "law", "removal_mm3_per_s", "depth_mm", "sinks"});
    std::string line;
    run.say("mm^3/s: full law, published law");
    auto stroke = strokes.begin();
    for (const PressedResult& result : planned.outcomes()) {
        const PressedStroke& s = *stroke++;
        const bool is_full = law_of(s) == full_law;
        table.add({s.material.name, s.load_n, law_of(s), result.removal_mm3_per_s, result.depth_mm,
                   result.sinks});
        if (line.empty()) line = fmt::format("{:34}", s.material.name);
        if (is_full) line += fmt::format("{:.2f} N ", s.load_n);
        line += fmt::format("{:>7}{}", rate_text(result), is_full ? "," : "   ");
        if (is_full || s.load_n != loads_n.back()) continue;
        run.say("{}", line);
        line.clear();
    }
    run.write(table, "loads");
}

}  // namespace osteomill::study
