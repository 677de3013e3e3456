// Loose parts of bone in a scan's preview, so that a person knows what leaving them out would leave out.
//
// The importer searches the bone that it makes (imaging/resampling/specks.h), in finer voxels and exactly;
// this is an estimate from the preview: parts of voxels at the threshold, within the region, that share a
// face, an edge or a corner.
#pragma once

#include <cstddef>

#include "render_client/ui/start/shown_scan.h"

namespace osteomill {

struct LooseParts {
    std::size_t count = 0;
    double mm3 = 0.0;  ///< in all

    bool operator==(const LooseParts&) const = default;
};

/// A part of less is loose, as for the importer.
inline constexpr double loose_part_mm3 = 2.0;

/// All parts of less than loose_part_mm3 but the largest part. `region`: patient LPS, as the scan's box; what
/// lies outside of the scan is none. Nothing is loose if the preview does not say its HU.
LooseParts loose_parts_in(const ScanVoxels& voxels, const ScanPreview& look, double mm_per_px,
                          const ScanBox& region, double threshold_hu);

}  // namespace osteomill
