// A bone file: CT numbers on the bone's own grid, as bone_import writes and haptic_server loads.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "haptic_server/imaging/hu_volume.h"

namespace osteomill {

/// Key under which a bone file says from which HU on there is bone.
inline constexpr const char* threshold_key = "osteomill_threshold_hu";

struct BoneFile {
    HuVolume volume;                                ///< tissue is empty
    std::optional<double> threshold_hu;             ///< of threshold_key; absent where the file has none
    std::map<std::string, std::string> key_values;  ///< all of the header's, threshold_key among them
};

/// Reads an int16 NRRD on an isotropic, axis-aligned LPS grid. Throws ImagingError in one line for anything
/// else; where the image is merely of another form the line says to run bone_import.
BoneFile read_bone_file(const std::filesystem::path& path);

/// Writes volume.hu (not its labels) as a gzip NRRD, in patient LPS, with the given key-values.
/// Throws as write_nrrd_volume does.
void write_hu_nrrd(const std::filesystem::path& path, const HuVolume& volume,
                   const std::map<std::string, std::string>& key_values = {});

/// "300" for 300.0: how a threshold is written under threshold_key.
std::string threshold_text(double threshold_hu);

}  // namespace osteomill
