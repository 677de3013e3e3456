// The bones that pictures are measured on, and the views of them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
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

// Names of trial bones.
inline constexpr const char* tooth_trial = "tooth phantom";  ///< of the default scene, 512 x 512 x 128 voxels
inline constexpr const char* cube_trial = "cube";
inline constexpr const char* head_trial = "head";
inline constexpr const char* skull_trial = "skull CT";  ///< 40 mm of the skull of the trial scans, 400^3 voxels
inline constexpr const char* vault_trial = "vault CT";  ///< of the head of which the slices are 2 mm apart

/// The trial bones, each made when it is first asked for. One thread at a time.
class TrialBones {
  public:
    /// Scans are imported from the folder `scans`, by way of a file in `folder` which is removed again.
    TrialBones(std::optional<std::filesystem::path> scans, std::filesystem::path folder)
        : scans_(std::move(scans)), folder_(std::move(folder)) {}

    bool has_scans() const { return scans_.has_value(); }
    /// Close-ups of phantoms show 7 mm round, of scans 9. Throws std::runtime_error where a scan is not
    /// there.
    const TrialBone& operator[](const std::string& name);

  private:
    std::optional<std::filesystem::path> scans_;
    std::filesystem::path folder_;
    std::map<std::string, TrialBone> made_{};
};

/// Where the camera's axis first meets bone; throws std::runtime_error where it meets none.
glm::dvec3 seen_point_mm(const Bone& bone, const Camera& camera);

/// Takes away a ball of this diameter round the point in the close-up's middle; returns the bricks that
/// changed.
std::vector<BrickChange> carve_in_view(TrialBone& trial, double diameter_mm);

}  // namespace osteomill::study
