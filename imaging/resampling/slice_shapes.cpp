#include "imaging/resampling/slice_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "imaging/in_parallel.h"
#include "imaging/resampling/contour_depth.h"

namespace osteomill {

namespace {

/// Slices closer than this are near enough for HU to be blended.
constexpr double far_apart_pixels = 1.5;
/// Slices' distances that a contour may move: a surface that leans less than 1 in this is left to HU, which
/// the thickness of the slices has blurred by then.
constexpr double reach_slices = 12.0;

/// If a surface closes like a cap, its contour moves farther from slice to slice, each time by this factor.
/// For a paraboloid it is 1.4 to 2.4: its top lies just below the next slice or just above the last.
constexpr double growth_of_last_way = 1.6;

double rise(double from, double to, double at) {
    const double t = std::clamp((at - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Depth at a place of one slice whose pixels lie row after row, between them bilinear.
float depth_at(std::span<const float> depth_mm, int columns, int rows, const glm::dvec2& at) {
    const double x = std::clamp(at.x, 0.0, columns - 1.0);
    const double y = std::clamp(at.y, 0.0, rows - 1.0);
    const int column = std::min(static_cast<int>(x), std::max(columns - 2, 0));
    const int row = std::min(static_cast<int>(y), std::max(rows - 2, 0));
    const auto value = [&](int dx, int dy) {
        return depth_mm[static_cast<std::size_t>(std::min(row + dy, rows - 1)) *
                            static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(std::min(column + dx, columns - 1))];
    };
    const auto u = static_cast<float>(x - column);
    const auto v = static_cast<float>(y - row);
    return (1.0F - v) * ((1.0F - u) * value(0, 0) + u * value(1, 0)) +
           v * ((1.0F - u) * value(0, 1) + u * value(1, 1));
}

/// From a voxel's place in memory to its neighbour's.
std::size_t step_along(const SourceImage& part, int axis) {
    std::size_t step = 1;
    for (int before = 0; before < axis; ++before) step *= static_cast<std::size_t>(part.size_voxels[before]);
    return step;
}

/// Weights of a cubic B-spline and of its slope, which smooth a distance whose contour is made of short
/// straight pieces.
struct SmoothWeights {
    double value[4];
    double slope[4];
};

SmoothWeights smooth_weights(double t) {
    const double u = 1.0 - t;
    return {{u * u * u / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
             (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0, t * t * t / 6.0},
            {-0.5 * u * u, -2.0 * t + 1.5 * t * t, 2.0 * u - 1.5 * u * u, 0.5 * t * t}};
}

}  // namespace

std::optional<int> axis_of_far_slices(const glm::dvec3& spacing_mm) {
    for (int axis = 0; axis < 3; ++axis) {
        const double widest_mm = std::max(spacing_mm[(axis + 1) % 3], spacing_mm[(axis + 2) % 3]);
        if (spacing_mm[axis] >= far_apart_pixels * widest_mm) return axis;
    }
    return std::nullopt;
}

double contour_reach_mm(const glm::dvec3& spacing_mm, int axis) {
    return reach_slices * spacing_mm[axis];
}

struct SliceShapes::Depth {
    double mm = 0.0;
    glm::dvec2 towards_bone{0.0};  // its slope, mm a mm; 1 but where bone is thin or its contour bends
};

SliceShapes::SliceShapes(const SourceImage& part, std::span<const float> values, int axis,
                         double threshold_hu, double result_spacing_mm, std::span<float> scratch,
                         const std::function<void()>& pause)
    : axes_((axis + 1) % 3, (axis + 2) % 3, axis),
      columns_(part.size_voxels[axes_.x]),
      rows_(part.size_voxels[axes_.y]),
      slices_(part.size_voxels[axes_.z]),
      column_mm_(part.spacing_mm[axes_.x]),
      row_mm_(part.spacing_mm[axes_.y]),
      slice_mm_(part.spacing_mm[axes_.z]),
      pixel_mm_(std::max(column_mm_, row_mm_)),
      reach_mm_(contour_reach_mm(part.spacing_mm, axis)),
      result_mm_(result_spacing_mm),
      column_step_(step_along(part, axes_.x)),
      row_step_(step_along(part, axes_.y)),
      slice_step_(step_along(part, axes_.z)),
      depth_mm_(scratch.first(values.size())),
      trust_(scratch.subspan(values.size(), values.size())) {
    measure_depths(values, threshold_hu, pause);
    compare_slices(pause);
}

std::size_t SliceShapes::index(int column, int row, int slice) const {
    return static_cast<std::size_t>(column) * column_step_ + static_cast<std::size_t>(row) * row_step_ +
           static_cast<std::size_t>(slice) * slice_step_;
}

void SliceShapes::measure_depths(std::span<const float> values, double threshold_hu,
                                 const std::function<void()>& pause) {
    in_parallel(slices_, [&](int slice) {
        std::vector<float> hu;
        hu.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column) hu.push_back(values[index(column, row, slice)]);
        std::vector<float> depth_mm(hu.size());
        contour_depth_mm(
            {.columns = columns_, .rows = rows_, .column_mm = column_mm_, .row_mm = row_mm_, .hu = hu},
            threshold_hu, reach_mm_, depth_mm);
        auto from = depth_mm.begin();
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column) depth_mm_[index(column, row, slice)] = *from++;
        pause();
    });
}

void SliceShapes::compare_slices(const std::function<void()>& pause) {
    in_parallel(slices_ - 1, [&](int slice) {
        std::vector<float> lower_mm, upper_mm;
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column) {
                lower_mm.push_back(depth_mm_[index(column, row, slice)]);
                upper_mm.push_back(depth_mm_[index(column, row, slice + 1)]);
            }
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column)
                trust_[index(column, row, slice)] = trust_between(lower_mm, upper_mm, column, row);
        pause();
    });
}

/// 1 if both contours face the same way and what lies between them is bone in one slice and none in the
/// other, as it is if one surface moves; else 0, with a slope between.
float SliceShapes::trust_between(std::span<const float> lower_mm, std::span<const float> upper_mm, int column,
                                 int row) const {
    const auto at = [&](std::span<const float> depth_mm, int x, int y) {
        return depth_mm[static_cast<std::size_t>(std::clamp(y, 0, rows_ - 1)) *
                            static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(std::clamp(x, 0, columns_ - 1))];
    };
    const double lower = at(lower_mm, column, row);
    const double upper = at(upper_mm, column, row);
    const double in_reach =
        1.0 - rise(0.8 * reach_mm_, reach_mm_, std::max(std::abs(lower), std::abs(upper)));
    if (in_reach <= 0.0) return 0.0F;
    const auto slope = [&](std::span<const float> depth_mm) {
        return glm::dvec2(at(depth_mm, column + 1, row) - at(depth_mm, column - 1, row),
                          at(depth_mm, column, row + 1) - at(depth_mm, column, row - 1)) /
               (2.0 * glm::dvec2(column_mm_, row_mm_));
    };
    const glm::dvec2 lower_slope = slope(lower_mm);
    const glm::dvec2 upper_slope = slope(upper_mm);
    const double agree = rise(0.8, 0.97, glm::dot(lower_slope, upper_slope));
    if (agree <= 0.0) return 0.0F;
    const glm::dvec2 pixel(column, row);
    const glm::dvec2 to_pixels = 1.0 / glm::dvec2(column_mm_, row_mm_);
    const auto on_contour = [&](double depth_mm, const glm::dvec2& towards_bone) {
        return pixel - depth_mm * glm::normalize(towards_bone) * to_pixels;
    };
    const double way_mm = lower - upper;
    const double side = way_mm < 0.0 ? -1.0 : 1.0;
    const double seen_below = side * depth_at(lower_mm, columns_, rows_, on_contour(upper, upper_slope));
    const double seen_above = -side * depth_at(upper_mm, columns_, rows_, on_contour(lower, lower_slope));
    const double part =
        (std::min(seen_below, seen_above) + 0.5 * pixel_mm_) / (std::abs(way_mm) + 0.5 * pixel_mm_);
    return static_cast<float>(in_reach * agree * rise(0.4, 0.7, part));
}

/// 0 to 1: a contour that moves by less than an edge's blur needs no correction.
double SliceShapes::moved_enough(double way_mm) const {
    return rise(0.5 * pixel_mm_, 1.5 * pixel_mm_, std::abs(way_mm));
}

/// 1 from contour to contour and as far around as the result's surface is felt, which in the slice is further
/// the more the surface leans.
double SliceShapes::near_surface(double lower_mm, double upper_mm) const {
    if (lower_mm * upper_mm <= 0.0) return 1.0;
    return near_surface_at_most(std::min(std::abs(lower_mm), std::abs(upper_mm)),
                                std::abs(lower_mm - upper_mm));
}

double SliceShapes::near_surface_at_most(double beyond_mm, double way_mm) const {
    constexpr double felt_voxels = 3.0;
    const double felt_mm =
        felt_voxels * result_mm_ * std::sqrt(1.0 + way_mm * way_mm / (slice_mm_ * slice_mm_));
    return 1.0 - rise(felt_mm, felt_mm + pixel_mm_ + 0.25 * way_mm, beyond_mm);
}

float SliceShapes::between_pixels(std::span<const float> values, const glm::dvec3& at, int slice) const {
    const int column = std::clamp(static_cast<int>(at[axes_.x]), 0, columns_ - 2);
    const int row = std::clamp(static_cast<int>(at[axes_.y]), 0, rows_ - 2);
    const auto u = static_cast<float>(at[axes_.x] - column);
    const auto v = static_cast<float>(at[axes_.y] - row);
    return (1.0F - v) *
               ((1.0F - u) * values[index(column, row, slice)] + u * values[index(column + 1, row, slice)]) +
           v * ((1.0F - u) * values[index(column, row + 1, slice)] +
                u * values[index(column + 1, row + 1, slice)]);
}

SliceShapes::Depth SliceShapes::depth(const glm::dvec3& at, int slice) const {
    const double x = at[axes_.x];
    const double y = at[axes_.y];
    const SmoothWeights wx = smooth_weights(x - std::floor(x));
    const SmoothWeights wy = smooth_weights(y - std::floor(y));
    Depth sum;
    for (int j = 0; j < 4; ++j) {
        const int row = std::clamp(static_cast<int>(std::floor(y)) - 1 + j, 0, rows_ - 1);
        double value = 0.0;
        double slope = 0.0;
        for (int i = 0; i < 4; ++i) {
            const int column = std::clamp(static_cast<int>(std::floor(x)) - 1 + i, 0, columns_ - 1);
            const double depth_mm = depth_mm_[index(column, row, slice)];
            value += wx.value[i] * depth_mm;
            slope += wx.slope[i] * depth_mm;
        }
        sum.mm += wy.value[j] * value;
        sum.towards_bone += glm::dvec2(wy.value[j] * slope / column_mm_, wy.slope[j] * value / row_mm_);
    }
    return sum;
}

/// Whether the contour is out of reach, as where bone ends between two slices.
double SliceShapes::out_of_reach(double depth_mm) const {
    return rise(0.8 * reach_mm_, reach_mm_, std::abs(depth_mm));
}

/// The depth that a slice without a contour would have, if the contour went on as it came from `before` to
/// `last`. It counts near the last contour; deeper in, the HU decide where bone ends.
SliceShapes::Continued SliceShapes::continued(const glm::dvec3& at, int last, int before,
                                              double beyond_mm) const {
    if (before < 0 || before >= slices_) return {};
    const double trust = between_pixels(trust_, at, std::min(last, before));
    const double last_mm = between_pixels(depth_mm_, at, last);
    const double way_mm = last_mm - between_pixels(depth_mm_, at, before);
    if (trust <= 0.0 || way_mm * beyond_mm <= 0.0) return {};
    const double swept = -last_mm / way_mm;  // share of the way on, when the contour comes by here
    return {.mm = last_mm + growth_of_last_way * way_mm,
            .weight = trust * moved_enough(way_mm) *
                      near_surface(last_mm, last_mm + growth_of_last_way * way_mm) *
                      (1.0 - rise(0.2, 0.8, swept))};
}

bool SliceShapes::may_move(const glm::ivec3& cell) const {
    const int column = cell[axes_.x];
    const int row = cell[axes_.y];
    const int below = cell[axes_.z];
    if (below < 0 || below + 1 >= slices_ || column < 0 || row < 0 || column >= columns_ || row >= rows_)
        return false;
    float low[2]{std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
    float high[2]{-low[0], -low[1]};
    float trust = 0.0F;
    for (int corner = 0; corner < 4; ++corner) {
        const std::size_t lower = index(std::min(column + (corner & 1), columns_ - 1),
                                        std::min(row + (corner >> 1), rows_ - 1), below);
        for (std::size_t upper = 0; upper < 2; ++upper) {
            low[upper] = std::min(low[upper], depth_mm_[lower + upper * slice_step_]);
            high[upper] = std::max(high[upper], depth_mm_[lower + upper * slice_step_]);
        }
        trust = std::max(trust, trust_[lower]);
    }
    const auto least = [&](int slice) { return std::max({low[slice], -high[slice], 0.0F}); };
    const auto most = [&](int slice) { return std::max(high[slice], -low[slice]); };
    // These two slices alone do not show how a contour ends.
    if (std::max(out_of_reach(most(0)), out_of_reach(most(1))) > 0.0)
        return out_of_reach(least(0)) == 0.0 || out_of_reach(least(1)) == 0.0;
    const double way_mm = std::max(high[1] - low[0], high[0] - low[1]);
    if (trust <= 0.0F || moved_enough(way_mm) <= 0.0) return false;
    return near_surface_at_most(std::min(least(0), least(1)), way_mm) > 0.0;
}

std::optional<PlacesInSlices> SliceShapes::places(const glm::dvec3& at) const {
    const int below = static_cast<int>(std::floor(at[axes_.z]));
    const double t = at[axes_.z] - below;
    if (below < 0 || below + 1 >= slices_ || t == 0.0 || at[axes_.x] < 0.0 || at[axes_.y] < 0.0 ||
        at[axes_.x] > columns_ - 1 || at[axes_.y] > rows_ - 1 || columns_ < 2 || rows_ < 2)
        return std::nullopt;
    const double lower_mm = between_pixels(depth_mm_, at, below);
    const double upper_mm = between_pixels(depth_mm_, at, below + 1);
    const double no_lower = out_of_reach(lower_mm);
    const double no_upper = out_of_reach(upper_mm);
    if (no_lower > 0.0 && no_upper > 0.0) return std::nullopt;
    const double trust = between_pixels(trust_, at, below);
    double weight = trust * moved_enough(upper_mm - lower_mm) * near_surface(lower_mm, upper_mm);
    Continued instead;
    if (no_upper > 0.0) instead = continued(at, below, below - 1, upper_mm);
    if (no_lower > 0.0) instead = continued(at, below + 1, below + 2, lower_mm);
    weight = glm::mix(weight, instead.weight, std::max(no_lower, no_upper));
    if (weight <= 0.0) return std::nullopt;

    Depth lower = depth(at, below);
    Depth upper = depth(at, below + 1);
    if (instead.weight > 0.0) {
        lower.mm = glm::mix(lower.mm, instead.mm, no_lower);
        upper.mm = glm::mix(upper.mm, instead.mm, no_upper);
    }
    const double depth_mm = depth_between(at, below, lower.mm, upper.mm);
    const auto place = [&](const Depth& from, int slice) {
        const double slope = glm::length(from.towards_bone);
        const glm::dvec2 step_mm = (depth_mm - from.mm) * from.towards_bone / std::max(slope, 0.5);
        glm::dvec3 moved = at;
        moved[axes_.x] = std::clamp(at[axes_.x] + step_mm.x / column_mm_, 0.0, columns_ - 1.0);
        moved[axes_.y] = std::clamp(at[axes_.y] + step_mm.y / row_mm_, 0.0, rows_ - 1.0);
        moved[axes_.z] = slice;
        return moved;
    };
    return PlacesInSlices{
        .weight = weight,
        .upper_share = glm::mix(t, no_lower > 0.0 ? 1.0 : 0.0, std::max(no_lower, no_upper)),
        .lower = place(lower, below),
        .upper = place(upper, below + 1)};
}

/// A cubic from slice to slice, so that the surface has no edge at a slice; its ends go straight if the slice
/// beyond shows another surface. Neither end is so steep that the cubic would turn back.
double SliceShapes::depth_between(const glm::dvec3& at, int below, double lower_mm, double upper_mm) const {
    const double way_mm = upper_mm - lower_mm;
    // `inner_mm`: the depth on the other side of the interval.
    // `onwards`: 1 above the interval, -1 below; `inner_mm`: the depth on its other side.
    const auto end_slope = [&](int beyond, int interval, double inner_mm, double onwards) {
        if (beyond < 0 || beyond >= slices_) return way_mm;
        double slope_mm = way_mm;
        if (const double trust = between_pixels(trust_, at, interval); trust > 0.0) {
            const double across_mm = 0.5 * onwards * (depth(at, beyond).mm - inner_mm);
            const double tamed_mm = way_mm < 0.0 ? std::clamp(across_mm, 3.0 * way_mm, 0.0)
                                                 : std::clamp(across_mm, 0.0, 3.0 * way_mm);
            slope_mm = glm::mix(way_mm, tamed_mm, trust);
        }
        const double beyond_mm = between_pixels(depth_mm_, at, beyond);
        if (onwards * way_mm * beyond_mm <= 0.0) return slope_mm;
        return glm::mix(slope_mm, 0.5 * (1.0 + growth_of_last_way) * way_mm, out_of_reach(beyond_mm));
    };
    const double at_lower_mm = end_slope(below - 1, below - 1, upper_mm, -1.0);
    const double at_upper_mm = end_slope(below + 2, below + 1, lower_mm, 1.0);
    const double t = at[axes_.z] - below;
    const double u = 1.0 - t;
    return lower_mm * u * u * (1.0 + 2.0 * t) + upper_mm * t * t * (3.0 - 2.0 * t) + at_lower_mm * t * u * u -
           at_upper_mm * t * t * u;
}

}  // namespace osteomill
