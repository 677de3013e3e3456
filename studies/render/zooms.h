// Pictures of every bone at three zooms, as render_client draws them at full quality: what one looks at for
// rings, terraces and seams, before a change of the drawing and after it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "common/program/progress.h"
#include "studies/render/trial_bone.h"

namespace osteomill::study {

/// Writes BONE_whole.png (all of it), BONE_10.png (10 pixels a voxel, from above) and BONE_20.png (20, with a
/// hole of 5 mm cut where the view's middle meets bone) of the tooth, the cube, the head and, where `scans`
/// names the folder of trial scans, a skull; of the tooth and the skull in other looks, too. `folder` is
/// there. Throws std::runtime_error naming a file that cannot be written.
void write_zooms(const glm::ivec2& size_px, const std::filesystem::path& folder,
                 const std::optional<std::filesystem::path>& scans, const ReportProgress& progress);

}  // namespace osteomill::study
