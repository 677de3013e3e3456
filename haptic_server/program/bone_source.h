// The bone that a scene names, and saving what a session has left of it.
#pragma once

#include <filesystem>
#include <optional>

#include "common/scene/scene.h"
#include "haptic_server/imaging/hu_volume.h"

namespace osteomill {

/// What a bone was built from. Dense: keep it no longer than needed.
struct BoneSource {
    HuVolume volume;
    double threshold_hu = 0.0;
};

struct LoadedBone {
    Bone bone;
    std::optional<BoneSource> source;  ///< none for a bone that no CT numbers were made for
};

/// Makes the phantom or reads the file. For a file the threshold is the scene's, or the file's own, or the
/// default of 300 HU. Throws std::runtime_error with one line naming the file.
LoadedBone load_bone(const Scene& scene);

/// Where neither scene nor file says from which HU on a voxel is bone: about what separates trabecular bone
/// from soft tissue in CT.
inline constexpr double default_threshold_hu = 300.0;

}  // namespace osteomill
