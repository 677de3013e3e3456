#include "haptic_server/imaging/hu_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/nrrd_volume.h"

namespace osteomill {

namespace {

std::optional<double> threshold_of(const std::filesystem::path& path,
                                   const std::map<std::string, std::string>& key_values) {
    const auto found = key_values.find(threshold_key);
    if (found == key_values.end()) return std::nullopt;
    char* end = nullptr;
    const double threshold_hu = std::strtod(found->second.c_str(), &end);
    if (found->second.empty() || *end != '\0' || !std::isfinite(threshold_hu))
        throw ImagingError(path, fmt::format("{}:={} is not a number of HU", threshold_key, found->second));
    return threshold_hu;
}

}  // namespace

BoneFile read_bone_file(const std::filesystem::path& path) {
    NrrdVolume<std::int16_t> file = read_nrrd_volume<std::int16_t>(path);
    const std::optional<double> threshold_hu = threshold_of(path, file.key_values);
    return {.volume = {.grid = file.grid, .hu = std::move(file.voxels), .tissue = {}},
            .threshold_hu = threshold_hu,
            .key_values = std::move(file.key_values)};
}

void write_hu_nrrd(const std::filesystem::path& path, const HuVolume& volume,
                   const std::map<std::string, std::string>& key_values) {
    write_nrrd_volume(path, volume.grid, volume.hu, key_values);
}

std::string threshold_text(double threshold_hu) {
    return fmt::format("{}", threshold_hu);
}

}  // namespace osteomill
