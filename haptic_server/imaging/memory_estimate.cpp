#include "haptic_server/imaging/memory_estimate.h"

#include <algorithm>
#include <sstream>
#include <string>

namespace osteomill {

namespace {
constexpr std::uint64_t file_voxel_bytes = 4;  // the widest type that scanners write
constexpr std::uint64_t float_bytes = 4;
constexpr std::uint64_t copies_when_refining = 4;  // values, two of ITK's smoothing, coefficients
constexpr std::uint64_t hu_bytes = 2;
constexpr std::uint64_t program_bytes = 64u << 20;  // libraries, buffers of compression
}  // namespace

std::uint64_t import_memory_bytes(std::uint64_t source_voxels, std::uint64_t region_source_voxels,
                                  const Grid& result) {
    const std::uint64_t result_voxels = static_cast<std::uint64_t>(result.size_voxels.x) *
                                        static_cast<std::uint64_t>(result.size_voxels.y) *
                                        static_cast<std::uint64_t>(result.size_voxels.z);
    const std::uint64_t reading = source_voxels * (file_voxel_bytes + float_bytes);
    const std::uint64_t cutting = (source_voxels + region_source_voxels) * float_bytes;
    const std::uint64_t refining =
        region_source_voxels * float_bytes * copies_when_refining + result_voxels * hu_bytes;
    return program_bytes + std::max({reading, cutting, refining});
}

std::optional<std::uint64_t> available_memory_bytes(std::istream& meminfo) {
    for (std::string line; std::getline(meminfo, line);) {
        std::istringstream words(line);
        std::string name;
        std::uint64_t kibibytes = 0;
        if (words >> name && name == "MemAvailable:" && words >> kibibytes) return kibibytes * 1024;
    }
    return std::nullopt;
}

}  // namespace osteomill
