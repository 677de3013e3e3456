// Motion of bone's contour from slice to slice, where a scan's slices lie further apart than its pixels.
// There a surface that leans towards the slices moves on, from one slice to the next, by more than its edge
// is blurred, and HU blended between the two would make a stair of each slice. So between slices the depth in
// bone is blended instead, and HU are taken from where the slices have that depth. S. P. Raya and J. K.
// Udupa, "Shape-based interpolation of multidimensional objects", IEEE Transactions on Medical Imaging 9(1),
// 1990; for grey values, G. J. Grevera and J. K. Udupa, the same 15(6), 1996.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "imaging/formats/source_image.h"

namespace osteomill {

/// The axis of a scan along which its slices are far apart: 1.5 pixels or more. Nothing if there is none, or
/// two: then the method gains nothing.
std::optional<int> axis_of_far_slices(const glm::dvec3& spacing_mm);

/// How far within a slice a contour is searched.
double contour_reach_mm(const glm::dvec3& spacing_mm, int axis);

/// The places in two slices that give the HU of a place between them.
struct PlacesInSlices {
    double weight = 0.0;       ///< how much they count against HU blended in place: 0 to 1
    double upper_share = 0.0;  ///< share of the place in the upper slice; the lower one has the rest
    glm::dvec3 lower{0.0};     ///< continuous voxel coordinates in the scan
    glm::dvec3 upper{0.0};
};

class SliceShapes {
  public:
    /// Floats of memory that it needs, per voxel of the scan.
    static constexpr std::size_t floats_per_voxel = 2;

    /// Looks at every slice along `axis`, on all cores. `values` are the part's HU, finite; `scratch`, which
    /// must outlive it, takes floats_per_voxel for each. `result_spacing_mm`: the spacing of the voxels for
    /// which places are requested. `pause`: see filter_lines.
    SliceShapes(
        const SourceImage& part, std::span<const float> values, int axis, double threshold_hu,
        double result_spacing_mm, std::span<float> scratch, const std::function<void()>& pause = [] {});

    /// `at`: continuous voxel coordinates in the scan. std::nullopt if HU blended in place are right: in a
    /// slice, far from the contour, where it hardly moves, and where the slices' contours are not of one
    /// surface (bone in one slice only, a plate thinner than the way it moves).
    std::optional<PlacesInSlices> places(const glm::dvec3& at) const;

    /// Whether places() may find any between voxel `cell` of the scan and the next along each axis: by far
    /// the most have none, and asking for all at once is cheap.
    bool may_move(const glm::ivec3& cell) const;

  private:
    struct Depth;
    struct Continued {
        double mm = 0.0;
        double weight = 0.0;
    };
    void measure_depths(std::span<const float> values, double threshold_hu,
                        const std::function<void()>& pause);
    void compare_slices(const std::function<void()>& pause);
    float trust_between(std::span<const float> lower_mm, std::span<const float> upper_mm, int column,
                        int row) const;
    std::size_t index(int column, int row, int slice) const;
    float between_pixels(std::span<const float> values, const glm::dvec3& at, int slice) const;
    double moved_enough(double way_mm) const;
    double out_of_reach(double depth_mm) const;
    Continued continued(const glm::dvec3& at, int last, int before, double beyond_mm) const;
    double depth_between(const glm::dvec3& at, int below, double lower_mm, double upper_mm) const;
    double near_surface(double lower_mm, double upper_mm) const;
    double near_surface_at_most(double beyond_mm, double way_mm) const;
    Depth depth(const glm::dvec3& at, int slice) const;

    glm::ivec3 axes_;  // column, row, slice: which of the part's
    int columns_, rows_, slices_;
    double column_mm_, row_mm_, slice_mm_, pixel_mm_, reach_mm_, result_mm_;
    std::size_t column_step_, row_step_, slice_step_;  // from a voxel's place in memory to its neighbour's
    std::span<float> depth_mm_;                        // each voxel's depth within its slice
    std::span<float> trust_;  // that the contour near a voxel and the one in the next slice are one surface's
};

}  // namespace osteomill
