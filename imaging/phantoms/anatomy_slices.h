// CT numbers of an anatomy that is given by distance functions, filled on all cores.
//
// An anatomy is a class with
//
//     std::optional<Near> near(const glm::dvec3& centre_mm, double reach_mm) const;
//         its parts that may lie within `reach_mm` of a place; nothing: all there is air
//     double surface_mm(const glm::dvec3& p, const Near& near) const;
//         a measure of the distance from the surface of all that is solid, negative inside; zero on the
//         surface and sloping by a half to two there
//     PlaceInAnatomy at(const glm::dvec3& p, const Near& near) const;
//
// In the slices HU pass the threshold on the surface. The filling of a voxel there follows from the distance
// itself, the measure over its slope, so that there are no stairs (bone_from_hu.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "imaging/bone_from_hu.h"
#include "imaging/in_parallel.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

struct PlaceInAnatomy {
    double surface_mm = 0.0;  ///< as the anatomy's own surface_mm
    double hu = 0.0;          ///< of the solid that is there or nearest
    double outside_hu = air_hu;
    std::uint8_t tissue = 0;
};

/// HU that pass the threshold exactly on the surface, reach the material's one voxel inside, and the
/// surroundings' one voxel outside.
inline double hu_across_surface(double material_hu, double outside_hu, double distance_voxels) {
    return distance_voxels < 0.0
               ? phantom_threshold_hu + (material_hu - phantom_threshold_hu) * std::min(1.0, -distance_voxels)
               : phantom_threshold_hu + (outside_hu - phantom_threshold_hu) * std::min(1.0, distance_voxels);
}

template <typename Anatomy>
class AnatomySlices {
  public:
    AnatomySlices(const Grid& grid, Anatomy anatomy)
        : grid_(grid),
          anatomy_(std::move(anatomy)),
          slice_(static_cast<std::size_t>(grid.size_voxels.x) *
                 static_cast<std::size_t>(grid.size_voxels.y)) {}

    void read(std::span<std::int16_t> hu, std::span<std::uint8_t> tissue) {
        const int count = static_cast<int>(hu.size() / slice_);
        keep_last_slices(count);
        const int rows = (grid_.size_voxels.y + block_voxels - 1) / block_voxels;
        const int layers = (count + block_voxels - 1) / block_voxels;
        in_parallel(rows * layers, [&](int i) {
            const glm::ivec3 first(0, i % rows * block_voxels, next_z_ + i / rows * block_voxels);
            const glm::ivec3 end =
                glm::min(first + block_voxels, glm::ivec3(0, grid_.size_voxels.y, next_z_ + count));
            for (int x = 0; x < grid_.size_voxels.x; x += block_voxels)
                fill({x, first.y, first.z}, {std::min(x + block_voxels, grid_.size_voxels.x), end.y, end.z},
                     hu, tissue);
        });
        next_z_ += count;
    }

    /// Distance of a voxel of the slices that were read last, or of the two before, from the surface.
    double surface_distance_voxels(const glm::ivec3& voxel) const {
        return distance_voxels_[index_from(voxel, held_from_z_)];
    }

  private:
    static constexpr int block_voxels = 8;
    static constexpr int kept_slices = 2;

    std::size_t index_from(const glm::ivec3& voxel, int first_z) const {
        return static_cast<std::size_t>(voxel.x) +
               static_cast<std::size_t>(grid_.size_voxels.x) * static_cast<std::size_t>(voxel.y) +
               slice_ * static_cast<std::size_t>(voxel.z - first_z);
    }

    void keep_last_slices(int count) {
        const int kept = std::min(kept_slices, next_z_);
        if (kept > 0)
            std::copy_n(&distance_voxels_[slice_ * static_cast<std::size_t>(next_z_ - kept - held_from_z_)],
                        slice_ * static_cast<std::size_t>(kept), distance_voxels_.begin());
        held_from_z_ = next_z_ - kept;
        distance_voxels_.resize(slice_ * static_cast<std::size_t>(kept + count));
    }

    void fill(const glm::ivec3& first, const glm::ivec3& end, std::span<std::int16_t> hu,
              std::span<std::uint8_t> tissue) {
        const glm::dvec3 centre =
            0.5 * (centre_of_voxel_mm(grid_, first) + centre_of_voxel_mm(grid_, end - 1));
        const auto near = anatomy_.near(centre, 0.5 * std::sqrt(3.0) * block_voxels * grid_.spacing_mm);
        for (int z = first.z; z < end.z; ++z)
            for (int y = first.y; y < end.y; ++y)
                for (int x = first.x; x < end.x; ++x) {
                    const std::size_t index = index_from({x, y, z}, next_z_);
                    float& distance = distance_voxels_[index_from({x, y, z}, held_from_z_)];
                    hu[index] = air_hu;
                    tissue[index] = 0;
                    distance = 1.0f;
                    if (!near) continue;
                    const glm::dvec3 p = centre_of_voxel_mm(grid_, {x, y, z});
                    const PlaceInAnatomy place = anatomy_.at(p, *near);
                    const double d = surface_distance_mm(p, place.surface_mm, *near) / grid_.spacing_mm;
                    distance = static_cast<float>(std::clamp(d, -1.0, 1.0));
                    hu[index] = static_cast<std::int16_t>(
                        std::lround(hu_across_surface(place.hu, place.outside_hu, d)));
                    if (d < 1.0) tissue[index] = place.tissue;
                }
    }

    /// The measure over its slope; off the surface, where it does not matter, the measure.
    template <typename Near>
    double surface_distance_mm(const glm::dvec3& p, double measure_mm, const Near& near) const {
        if (std::abs(measure_mm) > grid_.spacing_mm) return measure_mm;
        const double step_mm = 0.125 * grid_.spacing_mm;
        glm::dvec3 rise(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = step_mm;
            rise[axis] = anatomy_.surface_mm(p + step, near) - measure_mm;
        }
        return measure_mm / std::max(glm::length(rise) / step_mm, 0.5);
    }

    Grid grid_;
    Anatomy anatomy_;
    std::size_t slice_;
    int next_z_ = 0;       // the first slice that has not been read
    int held_from_z_ = 0;  // of the distances
    std::vector<float> distance_voxels_;
};

template <typename Anatomy>
HuSlices slices_of_anatomy(const Grid& grid, Anatomy anatomy) {
    auto slices = std::make_shared<AnatomySlices<Anatomy>>(grid, std::move(anatomy));
    return {.grid = grid,
            .labelled = true,
            .read = [slices](std::span<std::int16_t> hu,
                             std::span<std::uint8_t> tissue) { slices->read(hu, tissue); },
            .surface_distance_voxels =
                [slices](const glm::ivec3& voxel) { return slices->surface_distance_voxels(voxel); }};
}

}  // namespace osteomill
