// Frame time against the size of the volume and of the window.
#pragma once

#include <string>
#include <vector>

#include "studies/render/accuracy.h"

namespace osteomill::study {

struct ScaledFrames {
    double at = 0.0;  ///< edge of the volume, voxels; or thousands of pixels of the window
    Cost raycast{};
    Cost raycast_surface_voxels{};
    Cost slices{};
};

/// The same shape in 64^3 voxels and more, full quality.
std::vector<ScaledFrames> frames_by_volume(const glm::ivec2& size_px, bool quick, const Progress& progress);
/// A bone's overview in windows from 160 x 120.
std::vector<ScaledFrames> frames_by_window(const TrialBone& trial, bool quick, const Progress& progress);

/// Table with a header; `at` names the first column.
std::string csv_of(const std::vector<ScaledFrames>& rows, const std::string& at);

}  // namespace osteomill::study
