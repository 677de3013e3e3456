// Geometry of a NIfTI image: spacing, axes and origin from its sform, qform and pixdim.
#pragma once

#include <filesystem>

#include "imaging/formats/image_file.h"
#include "imaging/formats/nifti_fields.h"

namespace osteomill {

/// Fills in the geometry of `image` (mm, patient LPS) and its notes on assumptions and contradictions. The
/// sform is followed if there is one, else the qform, else pixdim with a guessed orientation. Throws
/// ImagingError for numbers that no scan has, an unknown unit, axes that are not perpendicular, and for
/// statements that contradict a sform which is no rotation times spacings. The formulas are those of
/// nifti1.h. `path` is for messages.
void read_nifti_geometry(const NiftiStatements& stated, const std::filesystem::path& path,
                         SourceImage& image);

}  // namespace osteomill
