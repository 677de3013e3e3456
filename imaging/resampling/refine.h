// From a scan's lattice to the bone's: isotropic, fine, along patient LPS.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/bone/grid.h"
#include "imaging/formats/source_image.h"
#include "imaging/resampling/cubic_spline.h"
#include "imaging/resampling/slice_shapes.h"

namespace osteomill {

/// Voxels of the scan around a region that its spline still feels: coefficients fade by 0.27 a voxel, so
/// eight leave 3e-5.
inline constexpr int refine_margin_voxels = 8;

/// Samples a part of a scan (as region.h leaves it) at the centres of the grid's voxels by its cubic
/// B-spline, smoothed first along axes where the grid is coarser. Results are clamped to the range of the
/// part's own values: a spline overshoots beside steep edges, and HU that no voxel had would be bone that is
/// not there. Outside the part (corners of a turned scan) there is air. Rounded to whole HU. If slices are
/// far apart and bone's contour moves between them, HU come from the places at which the slices have the same
/// depth in bone.
class Refiner {
  public:
    /// Turns `values`, the part's, into the spline's coefficients, on all cores; they must outlive it.
    /// `shapes`: those of the same part, or nullptr; they must outlive it.
    /// `pause`: see filter_lines. Throws std::invalid_argument for a bad grid.
    Refiner(
        const SourceImage& part, std::span<float> values, const Grid& grid,
        const SliceShapes* shapes = nullptr, const std::function<void()>& pause = [] {});
    ~Refiner();

    /// One slice of the grid, x fastest. From any number of threads.
    void slice(int z, std::span<std::int16_t> hu) const;

    class Sampler;  ///< one for scans along the grid's axes, one for turned ones

  private:
    std::unique_ptr<const Sampler> sampler_;
};

}  // namespace osteomill
