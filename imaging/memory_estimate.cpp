#include "imaging/memory_estimate.h"

#include <algorithm>

#include "common/bone/brick.h"
#include "imaging/bone_file/nrrd_writer.h"
#include "imaging/resampling/near_bone.h"

namespace osteomill {

namespace {
constexpr std::uint64_t float_bytes = 4;
constexpr std::uint64_t refined_bytes = 3;                // HU, and whether bone is near
constexpr std::uint64_t most_refined_bytes = 640u << 20;  // but for one slice, and those around it
constexpr int slices_around = 2 * kept_voxels_around_bone;
constexpr std::uint64_t program_bytes = 128u << 20;  // libraries, buffers of compression

std::uint64_t slice_bytes(const Grid& result) {
    return voxels_of_slice(result) * refined_bytes;
}
}  // namespace

int slices_at_once(const Grid& result) {
    const auto fit =
        static_cast<int>(std::min<std::uint64_t>(most_refined_bytes / slice_bytes(result), 1024));
    return std::clamp(fit - slices_around, 1, brick_edge_voxels);
}

std::uint64_t import_memory_bytes(std::uint64_t reading_bytes, std::uint64_t part_floats,
                                  const Grid& result) {
    const std::uint64_t refining =
        slice_bytes(result) * static_cast<std::uint64_t>(slices_at_once(result) + slices_around);
    return program_bytes + std::min(part_floats * float_bytes, most_scan_bytes) +
           std::max(reading_bytes, refining);
}

}  // namespace osteomill
