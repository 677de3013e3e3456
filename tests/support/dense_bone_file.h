// A small bone file as a whole, for tests.
#pragma once

#include "imaging/bone_file/hu_file.h"
#include "tests/support/hu_volume.h"

namespace osteomill::testing {

struct DenseBoneFile {
    HuVolume volume;  ///< without labels
    std::optional<double> threshold_hu;
    std::map<std::string, std::string> key_values;
};

/// Throws as BoneFile and HuReader do.
inline DenseBoneFile read_bone_file(const std::filesystem::path& path) {
    const BoneFile file(path);
    HuVolume volume{.grid = file.grid(), .hu = {}, .tissue = {}};
    volume.hu.resize(static_cast<std::size_t>(voxel_count(file.grid())));
    HuReader(file).read(volume.hu);
    return {std::move(volume), file.threshold_hu(), file.key_values()};
}

inline void write_bone_file(const std::filesystem::path& path, const HuVolume& volume,
                            const std::map<std::string, std::string>& key_values = {}) {
    BoneFileWriter writer(path, volume.grid, key_values);
    writer.add(volume.hu);
    writer.commit();
}

}  // namespace osteomill::testing
