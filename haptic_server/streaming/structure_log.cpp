#include "haptic_server/streaming/structure_log.h"

#include <fmt/format.h>

#include <utility>

namespace osteomill {

std::vector<std::string> StructureLog::lines(std::span<const StructureDistance> distances, double time_s) {
    constexpr double left_at = 1.5;
    std::vector<std::string> lines;
    std::vector<bool> is_near(tissues_.size(), false);
    for (const StructureDistance& now : distances) {
        const Tissue& tissue = tissues_[now.tissue];
        const bool was_warned_of = is_warned_of_[now.tissue];
        const double limit_mm = (was_warned_of ? left_at : 1.0) * tissue.warn_mm;
        is_near[now.tissue] = now.touches || (now.distance_mm && *now.distance_mm < limit_mm);
        if (now.touches_so_far > touches_logged_[now.tissue]) {
            touches_logged_[now.tissue] = now.touches_so_far;
            say(lines, fmt::format("the burr touches {} ({:.2f} s; touch {})", tissue.name, time_s,
                                   now.touches_so_far));
        } else if (is_near[now.tissue] && !was_warned_of && !now.touches) {
            say(lines, fmt::format("the burr is {:.2f} mm from {} ({:.2f} s)", *now.distance_mm, tissue.name,
                                   time_s));
        }
    }
    is_warned_of_ = std::move(is_near);
    return lines;
}

void StructureLog::say(std::vector<std::string>& lines, std::string line) {
    if (said_ >= most_lines) return;
    if (++said_ == most_lines) line += "; what follows of structures is left out of the log";
    lines.push_back(std::move(line));
}

}  // namespace osteomill
