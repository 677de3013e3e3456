// Depth in bone of each pixel of one slice of a scan, measured within the slice: the distance from the
// contour HU = threshold, mm, positive in bone, negative outside. Right to a small part of a pixel, since the
// contour runs between the pixels where their HU place it.
#pragma once

#include <span>

namespace osteomill {

/// One slice, its pixels row after row. HU are finite; lengths are those of the slice.
struct SlicePixels {
    int columns = 0;
    int rows = 0;
    double column_mm = 1.0;  ///< from a pixel to its neighbour in the row
    double row_mm = 1.0;     ///< from a row to the next
    std::span<const float> hu{};
};

/// Fills `depth_mm`, as long as the slice. A depth beyond `reach_mm` becomes `reach_mm` with its sign.
void contour_depth_mm(const SlicePixels& slice, double threshold_hu, double reach_mm,
                      std::span<float> depth_mm);

}  // namespace osteomill
