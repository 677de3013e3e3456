// Cost of bringing the textures up to date after a carve.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/progress.h"
#include "studies/render/timed_drawing.h"
#include "studies/render/trial_bone.h"

namespace osteomill::study {

struct UploadRow {
    double diameter_mm = 0.0;  ///< of the ball that was taken away
    std::size_t bricks = 0;    ///< that changed
    Cost gradient{};           ///< fractions and skipping maps
    Cost surface_voxels{};     ///< and the surface voxels shaded again
};

/// Balls of growing diameter out of the close-up's middle.
std::vector<UploadRow> measure_uploads(const TrialBone& trial, bool quick, const Progress& progress);

/// Table with a header.
std::string csv_of(const std::vector<UploadRow>& rows);

}  // namespace osteomill::study
