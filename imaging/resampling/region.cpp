#include "imaging/resampling/region.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <stdexcept>

#include "common/text/words.h"

namespace osteomill {

ScanRegion extent_of(const SourceImage& image) {
    ScanRegion extent{.low_mm = image.origin_mm, .high_mm = image.origin_mm};
    const glm::dvec3 last = glm::dvec3(image.size_voxels - 1);
    for (int corner = 1; corner < 8; ++corner) {
        const glm::dvec3 at =
            position_mm(image, last * glm::dvec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1));
        extent.low_mm = glm::min(extent.low_mm, at);
        extent.high_mm = glm::max(extent.high_mm, at);
    }
    return extent;
}

ScanRegion parse_region(const std::string& text) {
    const auto refuse = [&](const char* why) {
        throw std::invalid_argument(
            fmt::format("--region '{}': {}; it is x0,y0,z0,x1,y1,z1 in mm of patient LPS", text, why));
    };
    const auto numbers = listed_numbers<6>(text);
    if (!numbers) refuse("not six numbers");
    const auto& [x0, y0, z0, x1, y1, z1] = *numbers;
    const ScanRegion region{.low_mm = {x0, y0, z0}, .high_mm = {x1, y1, z1}};
    if (!glm::all(glm::lessThan(region.low_mm, region.high_mm)))
        refuse("its second corner must be above its first");
    return region;
}

ScanRegion clip(const ScanRegion& region, const ScanRegion& extent) {
    const ScanRegion common{.low_mm = glm::max(region.low_mm, extent.low_mm),
                            .high_mm = glm::min(region.high_mm, extent.high_mm)};
    if (!glm::all(glm::lessThan(common.low_mm, common.high_mm)))
        throw std::invalid_argument(
            fmt::format("--region {} lies outside the image, which covers {} (mm, patient LPS)",
                        to_text(region), to_text(extent)));
    return common;
}

std::string to_text(const ScanRegion& region) {
    return fmt::format("{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f}", region.low_mm.x, region.low_mm.y,
                       region.low_mm.z, region.high_mm.x, region.high_mm.y, region.high_mm.z);
}

Grid grid_over(const ScanRegion& region, double spacing_mm) {
    // A centre that rounding puts just outside the region still belongs to it.
    constexpr double rounding_voxels = 1e-6;
    const glm::dvec3 count =
        glm::floor((region.high_mm - region.low_mm) / spacing_mm + rounding_voxels) + 1.0;
    for (int axis = 0; axis < 3; ++axis)
        if (!(count[axis] <= 65536.0))
            throw std::invalid_argument(fmt::format(
                "{:.0f} voxels of {} mm along one axis are too many (at most 65536); use --region or a "
                "larger --spacing-mm",
                count[axis], spacing_mm));
    return {.size_voxels = glm::ivec3(count), .spacing_mm = spacing_mm, .origin_mm = region.low_mm};
}

}  // namespace osteomill
