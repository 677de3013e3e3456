#include "imaging/phantoms/head_phantom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/bone/bone_builder.h"

namespace osteomill {

namespace {

/// Share of each voxel of a grid that lies within an ellipsoid around the origin.
///
/// With the half axes r, k0 = |p / r| and k1 = |p / r^2|, the distance from p to the surface is about
/// k0 (k0 - 1) / k1. Both squares are sums of one term an axis, so three short tables suffice for every
/// voxel. Since k1 <= k0 / min r, a voxel with |k0 - 1| >= h / (2 min r) is farther than half a voxel from
/// the surface: whole or empty, without a root.
class EllipsoidCover {
  public:
    EllipsoidCover(const Grid& grid, const glm::dvec3& radii_mm) : spacing_mm_(grid.spacing_mm) {
        for (int axis = 0; axis < 3; ++axis) {
            const double radius_mm = radii_mm[axis];
            for (int i = 0; i < grid.size_voxels[axis]; ++i) {
                const double share = centre_of_voxel_mm(grid, glm::ivec3(i))[axis] / radius_mm;
                terms_[static_cast<std::size_t>(axis)].push_back(
                    {share * share, share / radius_mm * (share / radius_mm)});
            }
        }
        const double half_voxel =
            0.5 * grid.spacing_mm / std::min(radii_mm.x, std::min(radii_mm.y, radii_mm.z));
        whole_below_ = half_voxel < 1.0 ? (1.0 - half_voxel) * (1.0 - half_voxel) : 0.0;
        empty_above_ = (1.0 + half_voxel) * (1.0 + half_voxel);
    }

    /// The terms of y and z, the same for all voxels of a row.
    struct Terms {
        double k0_squared = 0.0;
        double k1_squared = 0.0;
    };
    Terms of_row(int y, int z) const { return sum(term(1, y), term(2, z)); }

    /// 0 to 1.
    double cover(int x, const Terms& row) const {
        const Terms at = sum(term(0, x), row);
        if (at.k0_squared <= whole_below_) return 1.0;
        if (at.k0_squared >= empty_above_) return 0.0;
        const double k0 = std::sqrt(at.k0_squared);
        const double distance_mm = k0 * (k0 - 1.0) / std::sqrt(at.k1_squared);
        return std::clamp(0.5 - distance_mm / spacing_mm_, 0.0, 1.0);
    }

    /// Whether a box of voxels lies within the ellipsoid as a whole, or outside.
    bool is_whole(const glm::ivec3& first, const glm::ivec3& end) const {
        return extreme(first, end, [](double a, double b) { return std::max(a, b); }) <= whole_below_;
    }
    bool is_empty(const glm::ivec3& first, const glm::ivec3& end) const {
        return extreme(first, end, [](double a, double b) { return std::min(a, b); }) >= empty_above_;
    }

  private:
    static Terms sum(const Terms& a, const Terms& b) {
        return {a.k0_squared + b.k0_squared, a.k1_squared + b.k1_squared};
    }
    const Terms& term(std::size_t axis, int i) const { return terms_[axis][static_cast<std::size_t>(i)]; }

    template <typename Pick>
    double extreme(const glm::ivec3& first, const glm::ivec3& end, const Pick& pick) const {
        double all_axes = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            double picked = term(a, first[axis]).k0_squared;
            for (int i = first[axis] + 1; i < end[axis]; ++i) picked = pick(picked, term(a, i).k0_squared);
            all_axes += picked;
        }
        return all_axes;
    }

    double spacing_mm_;
    double whole_below_ = 0.0;
    double empty_above_ = 0.0;
    std::array<std::vector<Terms>, 3> terms_;
};

class Shell {
  public:
    explicit Shell(const Braincase& shape)
        : grid_(shape.grid),
          outer_(shape.grid, shape.outer_radii_mm),
          inner_(shape.grid, shape.outer_radii_mm - shape.thickness_mm) {}

    /// Bricks that may hold bone, ascending.
    std::vector<glm::ivec3> bricks() const {
        const glm::ivec3 size = size_in_bricks(grid_);
        std::vector<glm::ivec3> found;
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const glm::ivec3 first = glm::ivec3(x, y, z) * brick_edge_voxels;
                    const glm::ivec3 end = end_of(first);
                    if (!outer_.is_empty(first, end) && !inner_.is_whole(first, end))
                        found.emplace_back(x, y, z);
                }
        return found;
    }

    void fill(const glm::ivec3& brick, ByteBrick& fraction) const {
        const glm::ivec3 first = brick * brick_edge_voxels;
        const glm::ivec3 end = end_of(first);
        if (end != first + brick_edge_voxels) fraction.fill(0);
        for (int z = first.z; z < end.z; ++z)
            for (int y = first.y; y < end.y; ++y) {
                const EllipsoidCover::Terms outer_row = outer_.of_row(y, z);
                const EllipsoidCover::Terms inner_row = inner_.of_row(y, z);
                std::uint8_t* row = &fraction[offset_in_brick({0, y, z})];
                for (int x = first.x; x < end.x; ++x) {
                    const double covered =
                        std::max(0.0, outer_.cover(x, outer_row) - inner_.cover(x, inner_row));
                    row[x - first.x] = static_cast<std::uint8_t>(255.0 * covered + 0.5);
                }
            }
    }

  private:
    glm::ivec3 end_of(const glm::ivec3& first) const {
        return glm::min(first + brick_edge_voxels, grid_.size_voxels);
    }

    Grid grid_;
    EllipsoidCover outer_;
    EllipsoidCover inner_;
};

}  // namespace

Braincase head_braincase() {
    return {.grid = {.size_voxels = glm::ivec3(2048), .spacing_mm = 0.1, .origin_mm = glm::dvec3(-102.35)},
            .outer_radii_mm = {74.0, 92.0, 76.0},
            .thickness_mm = 2.2};
}

Bone make_braincase(const Braincase& shape) {
    require_valid(shape.grid);
    const glm::dvec3& r = shape.outer_radii_mm;
    if (!(shape.thickness_mm > 0.0 && shape.thickness_mm < std::min(r.x, std::min(r.y, r.z))))
        throw std::invalid_argument("the braincase's thickness is " + std::to_string(shape.thickness_mm) +
                                    " mm, not between 0 and its least radius");
    const Shell shell(shape);
    const std::vector<glm::ivec3> bricks = shell.bricks();
    BoneBuilder builder = BoneBuilder::homogeneous(shape.grid, 1.0, false);
    builder.reserve_bricks(bricks.size());
    ByteBrick fraction{};
    for (const glm::ivec3& brick : bricks) {
        shell.fill(brick, fraction);
        builder.add_brick(brick, fraction, nullptr, nullptr);
    }
    return std::move(builder).build();
}

}  // namespace osteomill
