// The bones that pictures are measured on, and the views of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "render_client/volume/bone_colours.h"
#include "render_client/volume/camera.h"

namespace osteomill::study {

struct TrialBone {
    Bone bone;
    std::vector<TissueColour> tissues{};
    Camera overview{};
    Camera close_up{};
};

// Names of trial bones.
inline constexpr const char* tooth_trial = "tooth phantom";  ///< the default scene's, 512 x 512 x 128 voxels
inline constexpr const char* skull_trial =
    "skull CT";  ///< 40 mm of the skull of the trial scans, 400^3 voxels

/// The tooth's close-up shows 7 mm round, the skull's 9. Scans are imported from the folder `scans`, by way
/// of a file in `folder` which is removed again. Throws std::runtime_error if a scan is not there,
/// std::invalid_argument for another name.
TrialBone trial_bone(const std::string& name, const std::filesystem::path& scans,
                     const std::filesystem::path& folder);

}  // namespace osteomill::study
