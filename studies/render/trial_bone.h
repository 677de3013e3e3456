// The bones that pictures are measured on, and the views of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "render_client/volume/bone_colours.h"
#include "render_client/volume/camera.h"

namespace osteomill::study {

struct TrialBone {
    std::string name{};
    Bone bone;
    std::vector<TissueColour> tissues{};
    Camera overview{};
    Camera close_up{};
};

/// The phantom of the default scene, 512 x 512 x 128 voxels.
TrialBone tooth_trial();

/// The phantom of another scene (see phantom_names), of which the close-up shows 7 mm round.
TrialBone phantom_trial(const std::string& name);

/// 40 mm of the skull in the folder of trial scans, 400^3 voxels, imported by way of a file in `folder` which
/// is removed again. Throws std::runtime_error where the scan is not there.
TrialBone skull_trial(const std::filesystem::path& scans, const std::filesystem::path& folder);

/// 40 mm of the top of the head of which the slices are 2 mm apart, as above.
TrialBone vault_trial(const std::filesystem::path& scans, const std::filesystem::path& folder);

/// Where the camera's axis first meets bone; throws std::runtime_error where it meets none.
glm::dvec3 seen_point_mm(const Bone& bone, const Camera& camera);

/// Takes away a ball of this diameter round the point in the close-up's middle; returns the bricks that
/// changed.
std::vector<BrickChange> carve_in_view(TrialBone& trial, double diameter_mm);

}  // namespace osteomill::study
