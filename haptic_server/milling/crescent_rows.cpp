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
[[gnu::always_inline]] inline std::int32_t floor_of(float place) {
    return static_cast<std::int32_t>(place);
}

/// The same, rounding up but for the slack: never beyond the ceiling.
[[gnu::always_inline]] inline std::int32_t ceiling_of(float place) {
    return static_cast<std::int32_t>(place + static_cast<float>(1.0 - 0.1 * slack_voxels));
}

}  // namespace

CrescentRows::CrescentRows(const Sweep& ball, bool crescent_only, const glm::ivec3& first,
                           const glm::ivec3& end) noexcept
    : crescent_only_(crescent_only) {
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
    const bool cuts_rows = crescent_only && std::abs(direction_.x) > 1e-2f;
    if (cuts_rows) {
        plane_per_ahead_ = -1.0f / direction_.x;
        plane_at_ = from_.x + static_cast<float>(slack_voxels) * plane_per_ahead_;
    }
    right_weight_ = cuts_rows && direction_.x > 0.0f ? 1.0f : 0.0f;
    left_weight_ = cuts_rows && direction_.x < 0.0f ? 1.0f : 0.0f;
    row_weight_ = crescent_only && !cuts_rows ? 1.0f : 0.0f;
    const auto range = [&](int axis) {
        return VoxelRange{std::max(first[axis], static_cast<int>(std::ceil(middle[axis] - outer))),
                          std::min(end[axis], static_cast<int>(std::floor(middle[axis] + outer)) + 1)};
    };
    columns_ = range(0);
    rows_ = range(1);
    slices_ = range(2);
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

[[gnu::always_inline]] inline void CrescentRows::fill_slice(int z, const VoxelRange& rows) noexcept {
    constexpr auto slack = static_cast<float>(slack_voxels);
    const float dz = static_cast<float>(z) - middle_.z;
    const float outer_left = outer_squared_ - dz * dz;
    const float inner_left = inner_squared_ - dz * dz;
    const float ahead_z = (static_cast<float>(z) - from_.z) * direction_.z;
    const float first_y = static_cast<float>(rows_.first);
    const float middle_x = middle_.x;
    const float middle_y = middle_.y;
    const float from_y = from_.y;
    const float direction_y = direction_.y;
    const float plane_at = plane_at_;
    const float plane_per_ahead = plane_per_ahead_;
    const float right_weight = right_weight_;
    const float left_weight = left_weight_;
    const float row_weight = row_weight_;
    const float across_ahead = std::abs(direction_.x);
    const auto least_x = static_cast<float>(columns_.first);
    const auto most_x = static_cast<float>(columns_.end - 1);
    // Whole groups of rows and no branch, so that the compiler does a group at once.
    constexpr int group = 8;
    const int begin = (rows.first - rows_.first) / group * group;
    const int end = rows.end - rows_.first;
    for (int group_begin = begin; group_begin < end; group_begin += group)
        for (int row = group_begin; row < group_begin + group; ++row) {
            const float y = first_y + static_cast<float>(row);
            const float dy = y - middle_y;
            const float outer_squared = outer_left - dy * dy;
            const float inner_squared = inner_left - dy * dy;
            const float outer = std::sqrt(outer_squared < 0.0f ? 0.0f : outer_squared);
            const float inner = std::sqrt(inner_squared < 0.0f ? 0.0f : inner_squared);
            const float ahead = ahead_z + (y - from_y) * direction_y;
            const float plane = plane_at + ahead * plane_per_ahead;
            const float row_ahead = row_weight * (ahead + across_ahead * (outer + 2.0f) + slack);
            const float right_of = right_weight * plane;
            const float left_of = left_weight * plane + (1.0f - left_weight) * most_x;

            float first = middle_x - outer;
            first = first < right_of ? right_of : first;
            first = first < least_x ? least_x : first;
            float last = middle_x + outer;
            last = last > left_of ? left_of : last;
            last = last > most_x ? most_x : last;
            last = last < first ? -1.0f : last;
            last = outer_squared < 0.0f ? -1.0f : last;
            last = row_ahead < 0.0f ? -1.0f : last;

            const std::int32_t whole_first = ceiling_of(first);
            const std::int32_t whole_end = floor_of(last) + 1;
            const std::int32_t inside_first = floor_of(middle_x - inner) + 1;
            const std::int32_t inside_end = ceiling_of(middle_x + inner);
            // Where the row misses the inner ball the left part is all of it.
            const std::int32_t left_end = inner_squared < 0.0f ? whole_end : inside_first;
            const std::int32_t right_first = inner_squared < 0.0f ? whole_end : inside_end;
            left_first_[static_cast<std::size_t>(row)] = whole_first;
            left_end_[static_cast<std::size_t>(row)] = left_end < whole_end ? left_end : whole_end;
            right_first_[static_cast<std::size_t>(row)] =
                right_first > whole_first ? right_first : whole_first;
            right_end_[static_cast<std::size_t>(row)] = whole_end;
        }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void CrescentRows::fill_slice_avx2(int z, const VoxelRange& rows) noexcept {
    fill_slice(z, rows);
}
#endif

VoxelRange CrescentRows::begin_slice(int z, [[maybe_unused]] InstructionSet instructions) noexcept {
    const float dz = static_cast<float>(z) - middle_.z;
    const float half_squared = outer_squared_ - dz * dz;
    if (half_squared < 0.0f) return {};
    const float half = std::sqrt(half_squared);
    const VoxelRange rows{std::max(rows_.first, ceiling_of(std::max(0.0f, middle_.y - half))),
                          std::min(rows_.end, floor_of(middle_.y + half) + 1)};
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) {
        fill_slice_avx2(z, rows);
        return rows;
    }
#endif
    fill_slice(z, rows);
    return rows;
}

}  // namespace osteomill
