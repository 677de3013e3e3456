#include "simulation/carving/crescent_rows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace osteomill {

CrescentRows::CrescentRows(const Sweep& ball, double rim, const glm::ivec3& first,
                           const glm::ivec3& end) noexcept {
    const glm::dvec3 along = ball.to - ball.from;
    const double length = glm::length(along);
    const bool is_crescent = length > 0.0;
    const double outer = std::hypot(ball.radius + rim, length) + slack_voxels;
    const double inner = ball.radius - rim - slack_voxels;
    shape_.from = glm::vec3(ball.from);
    shape_.to = glm::vec3(ball.to);
    shape_.outer_squared = static_cast<float>(outer * outer);
    shape_.inner_squared = is_crescent && inner > 0.0 ? static_cast<float>(inner * inner) : -1.0f;
    if (is_crescent) shape_.direction = glm::vec3(along / length);
    const bool cuts_rows = std::abs(shape_.direction.x) > 1e-2f;
    if (cuts_rows) {
        shape_.plane_per_ahead = -1.0f / shape_.direction.x;
        shape_.plane_at = shape_.from.x + static_cast<float>(slack_voxels) * shape_.plane_per_ahead;
    }
    shape_.right_weight = cuts_rows && shape_.direction.x > 0.0f ? 1.0f : 0.0f;
    shape_.left_weight = cuts_rows && shape_.direction.x < 0.0f ? 1.0f : 0.0f;
    shape_.row_weight = is_crescent && !cuts_rows ? 1.0f : 0.0f;
    const auto range = [&](int axis) {
        return VoxelRange{std::max(first[axis], static_cast<int>(std::ceil(ball.to[axis] - outer))),
                          std::min(end[axis], static_cast<int>(std::floor(ball.to[axis] + outer)) + 1)};
    };
    columns_ = range(0);
    rows_ = range(1);
    slices_ = range(2);
    rows_.end = std::min(rows_.end, most_rows);
    shape_.first_x = static_cast<float>(columns_.first);
    shape_.last_x = static_cast<float>(columns_.end - 1);
    shape_.first_y = static_cast<float>(rows_.first);
    shape_.last_y = static_cast<float>(rows_.end - 1);
}

bool CrescentRows::misses_cube(const glm::ivec3& first, int edge) const noexcept {
    constexpr auto slack = static_cast<float>(slack_voxels);
    const auto size = static_cast<float>(edge - 1);
    const glm::vec3 to_corner = glm::vec3(first) - shape_.to;
    const glm::vec3 nearest = glm::max(glm::max(to_corner, -to_corner - size), glm::vec3(0.0f));
    if (glm::dot(nearest, nearest) > shape_.outer_squared + slack) return true;
    const glm::vec3 from_corner = glm::vec3(first) - shape_.from;
    const glm::vec3 farthest = glm::max(glm::abs(from_corner), glm::abs(from_corner + size));
    if (shape_.inner_squared > 0.0f && glm::dot(farthest, farthest) < shape_.inner_squared - slack)
        return true;
    const glm::vec3 most_ahead = glm::max(glm::vec3(0.0f), shape_.direction) * size;
    const glm::vec3 ahead = from_corner * shape_.direction + most_ahead;
    return ahead.x + ahead.y + ahead.z < -10.0f * slack;
}

}  // namespace osteomill
