// A bar of a round length that is right at the depth of the camera's target.
#pragma once

#include <string>

namespace osteomill {

struct ScaleBar {
    double length_mm = 0.0;
    double length_px = 0.0;
    std::string label;  ///< "5 mm", "200 um"
};

/// The longest of 1, 2 and 5 times a power of ten that spans at most `longest_px` if a pixel spans
/// `mm_per_px`, both above zero.
ScaleBar scale_bar(double mm_per_px, double longest_px);

}  // namespace osteomill
