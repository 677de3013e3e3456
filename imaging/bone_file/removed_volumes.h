// Volumes of bone removed by tissue in all earlier sessions, as a saved bone states them, because removed
// bone can no longer be counted.
#pragma once

#include <array>
#include <string>

#include "imaging/bone_file/hu_file.h"

namespace osteomill {

/// mm^3, index: tissue label; 0 for bone without one.
using VolumesByTissue = std::array<double, 256>;

inline constexpr const char* removed_key = "osteomill_removed_mm3";

/// "0:1.25 7:0.5": label and mm^3 of whatever is above 0, ascending.
std::string text_of_removed(const VolumesByTissue& removed_mm3);

/// Nothing if the file does not tell. Throws ImagingError if its values make no sense.
VolumesByTissue removed_before_mm3(const BoneFile& file);

}  // namespace osteomill
