#include "common/sound/sound_cue.h"

#include <algorithm>
#include <cmath>

namespace osteomill {

namespace {

constexpr double most_rev_per_s = 10'000.0;
constexpr double most_force_n = 1000.0;
constexpr double least_stiffness = 0.01;
constexpr double most_stiffness = 10.0;

double usable(double value, double low, double high) noexcept {
    return std::isfinite(value) ? std::clamp(value, low, high) : low;
}

}  // namespace

SoundCue cue_of(const ToolState& tool, const Burr& burr) noexcept {
    SoundCue cue{.edges = std::max(1, burr.edges)};
    if (!tool.spindle_on) return cue;
    const double in_air_rev_per_s = usable(spindle_rpm(tool, burr) / 60.0, 0.0, most_rev_per_s);
    cue.rev_per_s = in_air_rev_per_s;
    if (!tool.cut) return cue;
    cue.force_n = usable(tool.cut->force_n, 0.0, most_force_n);
    cue.tooth_ripple_n = usable(tool.cut->tooth_ripple_n, 0.0, most_force_n);
    cue.relative_stiffness = usable(tool.cut->relative_stiffness, least_stiffness, most_stiffness);
    if (!tool.cut->loaded_rpm || !(in_air_rev_per_s > 0.0)) return cue;
    cue.rev_per_s = usable(*tool.cut->loaded_rpm / 60.0, 0.0, in_air_rev_per_s);
    cue.strain = 1.0 - cue.rev_per_s / in_air_rev_per_s;
    return cue;
}

}  // namespace osteomill
