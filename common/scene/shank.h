// The shank behind a burr: neck, shank and handpiece as straight cones about the spindle, from one point of a
// profile to the next.
#pragma once

#include <vector>

namespace osteomill {

struct ShankPoint {
    double height_mm = 0.0;  ///< above the burr's centre, along the spindle
    double radius_mm = 0.0;

    bool operator==(const ShankPoint&) const = default;
};

/// Heights ascend. Empty: nothing behind the burr touches bone.
using ShankProfile = std::vector<ShankPoint>;

/// Throws std::invalid_argument unless the profile is empty or has 2 to 8 points, their radii within 0.05 to
/// 30 mm, their heights ascending by 0.01 mm or more from half the burr's radius to 200 mm, the last beyond
/// the burr.
void require_valid(const ShankProfile& shank, double burr_radius_mm);

}  // namespace osteomill
