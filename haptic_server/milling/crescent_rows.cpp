#include "haptic_server/milling/crescent_rows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

/// Slack for single precision, voxels: places of up to a few hundred, rounded a few times.
constexpr double slack_voxels = 1e-3;

/// For places that are not negative: the conversion itself rounds down.
int floor_of(float place) {
    return static_cast<int>(place);
}

int ceiling_of(float place) {
    const int whole = static_cast<int>(place);
    return whole + (static_cast<float>(whole) < place ? 1 : 0);
}

}  // namespace

CrescentRows::CrescentRows(const Sweep& ball, bool crescent_only) noexcept : crescent_only_(crescent_only) {
    const glm::dvec3 middle = 0.5 * (ball.from + ball.to);
    const glm::dvec3 along = ball.to - ball.from;
    const double length = glm::length(along);
    const double outer = ball.radius + 0.5 + 0.5 * length + slack_voxels;
    const double inner = ball.radius - 0.5 - 0.5 * length - slack_voxels;
    middle_ = glm::vec3(middle);
    from_ = glm::vec3(ball.from);
    outer_squared_ = static_cast<float>(outer * outer);
    inner_squared_ = crescent_only && inner > 0.0 ? static_cast<float>(inner * inner) : -1.0f;
    if (length > 0.0) direction_ = glm::vec3(along / length);
    // A step nearly across x cuts no row in two; ranges() then only asks whether the whole row lies behind.
    if (std::abs(direction_.x) > 1e-2f) per_direction_x_ = 1.0f / direction_.x;
    const auto range = [&](double centre) {
        return VoxelRange{static_cast<int>(std::max(0.0, std::ceil(centre - outer))),
                          static_cast<int>(std::floor(centre + outer)) + 1};
    };
    rows_ = range(middle.y);
    slices_ = range(middle.z);
    rows_.end = std::min(rows_.end, rows_.first + most_rows);
}

bool CrescentRows::misses_cube(const glm::ivec3& first, int edge) const noexcept {
    constexpr auto slack = static_cast<float>(slack_voxels);
    const glm::vec3 low = glm::vec3(first) - middle_;
    const glm::vec3 high = low + static_cast<float>(edge - 1);
    const glm::vec3 nearest = glm::max(glm::max(low, -high), glm::vec3(0.0f));
    if (glm::dot(nearest, nearest) > outer_squared_ + slack) return true;
    if (!crescent_only_) return false;
    const glm::vec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    if (inner_squared_ > 0.0f && glm::dot(farthest, farthest) < inner_squared_ - slack) return true;
    const glm::vec3 from_corner = glm::vec3(first) - from_;
    const glm::vec3 most_ahead = glm::max(glm::vec3(0.0f), direction_) * static_cast<float>(edge - 1);
    const glm::vec3 ahead = from_corner * direction_ + most_ahead;
    return ahead.x + ahead.y + ahead.z < -10.0f * slack;
}

void CrescentRows::begin_slice(int z) noexcept {
    const float dz = static_cast<float>(z) - middle_.z;
    const float outer_left = outer_squared_ - dz * dz;
    const float inner_left = inner_squared_ - dz * dz;
    const float first_dy = static_cast<float>(rows_.first) - middle_.y;
    const int count = rows_.end - rows_.first;
    for (int i = 0; i < count; ++i) {
        const float dy = first_dy + static_cast<float>(i);
        const float outer = outer_left - dy * dy;
        const float inner = inner_left - dy * dy;
        outer_[static_cast<std::size_t>(i)] = outer < 0.0f ? -1.0f : std::sqrt(outer < 0.0f ? 0.0f : outer);
        inner_[static_cast<std::size_t>(i)] = inner < 0.0f ? -1.0f : std::sqrt(inner < 0.0f ? 0.0f : inner);
    }
    ahead_z_ = (static_cast<float>(z) - from_.z) * direction_.z;
}

std::array<VoxelRange, 2> CrescentRows::ranges(int y) const noexcept {
    const auto i = static_cast<std::size_t>(y - rows_.first);
    const float outer = outer_[i];
    if (outer < 0.0f) return {};
    float first = std::max(0.0f, middle_.x - outer);
    float last = middle_.x + outer;
    if (crescent_only_) {
        constexpr auto slack = static_cast<float>(slack_voxels);
        const float ahead = ahead_z_ + (static_cast<float>(y) - from_.y) * direction_.y;
        if (per_direction_x_ > 0.0f) {
            first = std::max(first, from_.x - ahead * per_direction_x_ - slack * per_direction_x_);
        } else if (per_direction_x_ < 0.0f) {
            last = std::min(last, from_.x - ahead * per_direction_x_ - slack * per_direction_x_);
        } else if (ahead + std::abs(direction_.x) * (outer + 2.0f) + slack < 0.0f) {
            return {};
        }
        if (!(first <= last)) return {};
    }
    const VoxelRange whole{ceiling_of(first), floor_of(last) + 1};
    const float inner = inner_[i];
    if (inner < 0.0f) return {whole, {}};
    return {VoxelRange{whole.first, std::min(whole.end, floor_of(middle_.x - inner) + 1)},
            VoxelRange{std::max(whole.first, ceiling_of(middle_.x + inner)), whole.end}};
}

}  // namespace osteomill
