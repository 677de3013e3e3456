#include "imaging/resampling/field_of_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

#include "imaging/bone_from_hu.h"
#include "imaging/formats/source_image.h"
#include "imaging/resampling/refine.h"

namespace osteomill {

namespace {

std::byte bit_of(std::size_t place) {
    return std::byte{1} << (place % 8);
}

template <typename Take>
void for_each_neighbour(std::size_t place, const glm::ivec3& size, const Take& take) {
    std::size_t step = 1;
    std::size_t rest = place;
    for (int axis = 0; axis < 3; ++axis) {
        const auto length = static_cast<std::size_t>(size[axis]);
        const std::size_t at = rest % length;
        if (at > 0) take(place - step);
        if (at + 1 < length) take(place + step);
        rest /= length;
        step *= length;
    }
}

/// The mean of the neighbours that are numbers; not a number if there are none.
float mean_around(std::size_t place, const glm::ivec3& size, std::span<const float> values) {
    float sum = 0.0F;
    float count = 0.0F;
    for_each_neighbour(place, size, [&](std::size_t neighbour) {
        if (std::isnan(values[neighbour])) return;
        sum += values[neighbour];
        count += 1.0F;
    });
    return sum / count;
}

}  // namespace

FieldOfView::FieldOfView(const SourceImage& part, std::span<float> values, std::span<std::byte> scratch,
                         const std::function<void()>& pause)
    : part_(part), is_outside_(scratch) {
    const glm::ivec3& size = part_.size_voxels;
    const auto slice = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    std::vector<std::pair<std::size_t, float>> layer;
    for (std::size_t place = 0; place < values.size(); ++place) {
        if (place % slice == 0) pause();
        if (!std::isnan(values[place])) continue;
        is_outside_[place / 8] |= bit_of(place);
        ++voxels_outside_;
        if (const float mean = mean_around(place, size, values); !std::isnan(mean))
            layer.emplace_back(place, mean);
    }
    for (int depth = 0; depth < refine_margin_voxels; ++depth) {
        for (const auto& [place, mean] : layer) values[place] = mean;
        std::vector<std::size_t> next;
        for (const auto& [place, mean] : layer)
            for_each_neighbour(place, size, [&](std::size_t neighbour) {
                if (std::isnan(values[neighbour])) next.push_back(neighbour);
            });
        std::ranges::sort(next);
        next.erase(std::unique(next.begin(), next.end()), next.end());
        layer.clear();
        for (const std::size_t place : next) layer.emplace_back(place, mean_around(place, size, values));
    }
    for (std::size_t place = 0; place < values.size(); ++place) {
        if (place % slice == 0) pause();
        if (std::isnan(values[place])) values[place] = air_hu;
    }
}

void FieldOfView::clear_outside(const Grid& grid, int z, std::span<std::int16_t> hu) const {
    if (voxels_outside_ == 0) return;
    const glm::dvec3 end = glm::dvec3(part_.size_voxels - 1);
    auto out = hu.begin();
    for (int y = 0; y < grid.size_voxels.y; ++y)
        for (int x = 0; x < grid.size_voxels.x; ++x, ++out) {
            const glm::dvec3 at = glm::clamp(
                glm::floor(voxel_at(part_, centre_of_voxel_mm(grid, {x, y, z})) + 0.5), glm::dvec3(0.0), end);
            const std::size_t place = voxel_index(glm::ivec3(at), part_.size_voxels);
            if ((is_outside_[place / 8] & bit_of(place)) != std::byte{0}) *out = air_hu;
        }
}

}  // namespace osteomill
