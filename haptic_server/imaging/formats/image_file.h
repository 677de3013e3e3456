// An image file as its header describes it: how the image lies in the patient, and where its values lie.
#pragma once

#include <map>
#include <string>

#include "haptic_server/imaging/formats/source_image.h"
#include "haptic_server/imaging/formats/voxel_data.h"
#include "haptic_server/imaging/formats/voxel_layout.h"

namespace osteomill {

struct ImageFile {
    SourceImage image{};  ///< without values; its notes say what had to be assumed
    int layers = 1;       ///< values of a voxel, side by side
    VoxelLayout voxels{};
    VoxelData data{};
    std::map<std::string, std::string> key_values{};  ///< of a NRRD, "key:=value"
};

}  // namespace osteomill
