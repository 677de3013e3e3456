// How far a notch of the wheel takes the burr along its spindle: fast in air, fine at the bone, finer where
// the picture is magnified.
#pragma once

#include <algorithm>
#include <optional>

namespace osteomill {

/// `mm_per_px`: at the burr. `ahead_mm`: from the burr to the bone along the spindle; nothing if none is
/// near.
constexpr double wheel_step_mm(double mm_per_px, std::optional<double> ahead_mm) {
    constexpr double fine_px = 2.0, finest_mm = 0.02, coarsest_at_bone_mm = 0.2;
    constexpr double share_of_way = 0.3, in_air_mm = 3.0;  // half of the hand's greatest lead
    const double fine_mm = std::clamp(fine_px * mm_per_px, finest_mm, coarsest_at_bone_mm);
    return std::clamp(ahead_mm ? share_of_way * *ahead_mm : in_air_mm, fine_mm, in_air_mm);
}

}  // namespace osteomill
