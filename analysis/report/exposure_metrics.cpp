#include "analysis/report/exposure_metrics.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "analysis/report/nearest_place.h"
#include "analysis/report/voxel_set.h"

namespace osteomill {

namespace {

constexpr double leaves_within_voxels = 2.0;

/// The cavity and the questions asked of it, in a box beyond which it exposes nothing.
class BareSurface {
  public:
    explicit BareSurface(const SessionTrace& trace)
        : grid_(trace.at_start.grid()),
          cavity_(cavity_of(trace.at_start, trace.at_end)),
          surface_mm_(cavity_.surface_mm()),
          nearest_(surface_mm_) {
        if (surface_mm_.empty()) return;
        low_ = high_ = surface_mm_.front();
        for (const glm::dvec3& place : surface_mm_)
            low_ = glm::min(low_, place), high_ = glm::max(high_, place);
        const double reach_mm = thin_mm.back() + grid_.spacing_mm;
        low_ -= reach_mm, high_ += reach_mm;
    }

    /// Thickness of the bone over a voxel of a structure's surface; nothing: none that matters, or none on
    /// this side.
    std::optional<double> thickness_mm(const StructureMask& structure, const glm::ivec3& voxel) const {
        if (cavity_.contains(voxel)) return 0.0;
        const glm::dvec3 place_mm = centre_of_voxel_mm(grid_, voxel);
        if (surface_mm_.empty() || glm::any(glm::lessThan(place_mm, low_)) ||
            glm::any(glm::greaterThan(place_mm, high_)))
            return std::nullopt;
        const glm::dvec3 way_mm = *nearest_.nearest_mm(place_mm) - place_mm;
        const double length_mm = glm::length(way_mm);
        if (length_mm > thin_mm.back() + grid_.spacing_mm) return std::nullopt;
        for (double at_mm = leaves_within_voxels * grid_.spacing_mm; at_mm < length_mm;
             at_mm += 0.5 * grid_.spacing_mm) {
            const glm::dvec3 at = to_voxel_coordinates(grid_, place_mm + at_mm / length_mm * way_mm);
            const glm::ivec3 passed(glm::floor(at + 0.5));
            if (structure.contains(passed) && !cavity_.contains(passed)) return std::nullopt;
        }
        return std::max(0.0, length_mm - grid_.spacing_mm);
    }

  private:
    Grid grid_;
    VoxelSet cavity_;
    std::vector<glm::dvec3> surface_mm_;
    NearestPlace nearest_;
    glm::dvec3 low_{0.0};
    glm::dvec3 high_{0.0};
};

/// In faces of a voxel; 0: the voxel is not of the surface. The surface has no face where the grid ends.
double area(const StructureMask& structure, const glm::ivec3& voxel) {
    const auto goes_on = [&](const glm::ivec3& beside) {
        return structure.contains(beside) || !contains(structure.grid(), beside);
    };
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 step(0);
        step[axis] = 1;
        axes += goes_on(voxel + step) && goes_on(voxel - step) ? 0 : 1;
    }
    return std::sqrt(static_cast<double>(axes));
}

ExposureMetrics exposure_of(const Structure& structure, const BareSurface& bare, std::string name) {
    constexpr double nothing_mm = 1e-6;
    ExposureMetrics metrics{.name = std::move(name)};
    const StructureMask& mask = structure.mask;
    const glm::ivec3 size = size_in_bricks(mask.grid());
    double surface = 0.0;
    for (const StructureBrick& brick : mask.bricks()) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size, brick.brick);
        brick.voxels.for_each([&](std::size_t offset) {
            const glm::ivec3 voxel = first + voxel_in_brick(offset);
            const double faces = area(mask, voxel);
            if (faces == 0.0) return;
            surface += faces;
            const auto over_mm = bare.thickness_mm(mask, voxel);
            if (!over_mm) return;
            if (*over_mm < nothing_mm) metrics.bare_share += faces;
            for (std::size_t k = 0; k < thin_mm.size(); ++k)
                if (*over_mm < thin_mm[k] - nothing_mm) metrics.thin_share[k] += faces;
        });
    }
    if (!(surface > 0.0)) return metrics;
    metrics.bare_share /= surface;
    for (double& share : metrics.thin_share) share /= surface;
    return metrics;
}

}  // namespace

std::vector<ExposureMetrics> exposure_metrics(const SessionTrace& trace) {
    std::vector<ExposureMetrics> all;
    if (trace.structure_places.empty()) return all;
    const BareSurface bare(trace);
    for (const Structure& structure : trace.structure_places)
        if (trace.session.tissues[structure.tissue].is_protected && !structure.mask.empty())
            all.push_back(exposure_of(structure, bare, trace.session.tissues[structure.tissue].name));
    return all;
}

}  // namespace osteomill
