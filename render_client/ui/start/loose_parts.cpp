#include "render_client/ui/start/loose_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace osteomill {

LooseParts loose_parts_in(const ScanVoxels& voxels, const ScanPreview& look, double mm_per_px,
                          const ScanBox& region, double threshold_hu) {
    if (!(look.white_hu > look.black_hu)) return {};
    const auto voxel_of = [&](const glm::dvec3& place_mm, const auto& rounded) {
        return glm::clamp(glm::ivec3(rounded((place_mm - look.covers.low_mm) / mm_per_px)), glm::ivec3(0),
                          voxels.size - 1);
    };
    const glm::ivec3 low = voxel_of(region.low_mm, [](const glm::dvec3& at) { return glm::ceil(at - 1e-6); });
    const glm::ivec3 high =
        voxel_of(region.high_mm, [](const glm::dvec3& at) { return glm::floor(at + 1e-6); });
    const glm::ivec3 size = glm::max(high - low + 1, glm::ivec3(0));
    const double least_grey =
        std::ceil(255.0 * (threshold_hu - look.black_hu) / (look.white_hu - look.black_hu));
    const auto place_of = [](const glm::ivec3& at, const glm::ivec3& within) {
        return static_cast<std::size_t>(at.x) +
               static_cast<std::size_t>(within.x) *
                   (static_cast<std::size_t>(at.y) +
                    static_cast<std::size_t>(within.y) * static_cast<std::size_t>(at.z));
    };
    std::vector<std::uint8_t> is_left(place_of({0, 0, size.z}, size));
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                is_left[place_of({x, y, z}, size)] =
                    voxels.greys[place_of(low + glm::ivec3(x, y, z), voxels.size)] >= least_grey ? 1 : 0;

    LooseParts loose;
    std::size_t largest = 0;
    bool is_largest_loose = false;
    std::vector<glm::ivec3> to_visit;
    const double voxel_mm3 = mm_per_px * mm_per_px * mm_per_px;
    const auto take = [&](const glm::ivec3& at) {
        std::uint8_t& left = is_left[place_of(at, size)];
        if (left == 0) return;
        left = 0;
        to_visit.push_back(at);
    };
    const auto size_of_part_at = [&](const glm::ivec3& first) {
        std::size_t count = 0;
        for (take(first); !to_visit.empty(); ++count) {
            const glm::ivec3 at = to_visit.back();
            to_visit.pop_back();
            const glm::ivec3 from = glm::max(at - 1, glm::ivec3(0)), to = glm::min(at + 1, size - 1);
            for (int z = from.z; z <= to.z; ++z)
                for (int y = from.y; y <= to.y; ++y)
                    for (int x = from.x; x <= to.x; ++x) take({x, y, z});
        }
        return count;
    };
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const std::size_t part = size_of_part_at({x, y, z});
                if (part == 0) continue;
                const double mm3 = static_cast<double>(part) * voxel_mm3;
                const bool is_loose = mm3 < loose_part_mm3;
                if (is_loose) loose = {loose.count + 1, loose.mm3 + mm3};
                if (part <= largest) continue;
                largest = part;
                is_largest_loose = is_loose;
            }
    if (is_largest_loose) loose = {loose.count - 1, loose.mm3 - static_cast<double>(largest) * voxel_mm3};
    return loose;
}

}  // namespace osteomill
