// The part of a scan that was measured, apart from the padding around a round field of view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "common/bone/grid.h"
#include "imaging/formats/source_image.h"

namespace osteomill {

/// Padding is no measurement: a step of thousands of HU beside it would make a spline overshoot into bone
/// that is not there. So the values around go on into it, and its voxels become air in the end.
class FieldOfView {
  public:
    /// `values` are the part's; those that are not numbers are padding. Next to the field they become the
    /// mean of their neighbours, layer by layer, as deep as a spline reaches; farther away they become air.
    /// `scratch`: a bit for each value, all 0, which must outlive it. `pause`: see filter_lines.
    FieldOfView(
        const SourceImage& part, std::span<float> values, std::span<std::byte> scratch,
        const std::function<void()>& pause = [] {});

    /// How many voxels were not measured.
    std::uint64_t voxels_outside() const { return voxels_outside_; }
    /// Sets to air the part of the grid's slice z that lies in voxels that were not measured. From any number
    /// of threads.
    void clear_outside(const Grid& grid, int z, std::span<std::int16_t> hu) const;

  private:
    SourceImage part_;
    std::span<std::byte> is_outside_;
    std::uint64_t voxels_outside_ = 0;
};

}  // namespace osteomill
