// Pictures of every bone at three zooms, as render_client draws them at full quality: what one looks at for
// rings, terraces and seams, before a change of the drawing and after it.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "render_client/volume/bone_colours.h"
#include "studies/render/trial_bone.h"

namespace osteomill::study {

/// A bone in a look of render_client.
struct ZoomCase {
    std::string bone;
    std::string suffix{};  ///< of its pictures' names
    ShadingSettings look{};
};

/// The tooth, the cube, the head and, `with_scans`, a skull and a vault; the tooth and the skull in other
/// looks, too.
std::vector<ZoomCase> zoom_cases(bool with_scans);

/// Writes BONE_whole.png (all of it), BONE_10.png (10 pixels a voxel, from above) and BONE_20.png (20, with a
/// hole of 5 mm cut where the view's middle meets bone) into `folder`, which is there; the first is returned.
/// Needs a current OpenGL context. Throws std::runtime_error naming a file that cannot be written.
std::filesystem::path write_zooms(const ZoomCase& c, TrialBones& bones, const glm::ivec2& size_px,
                                  const std::filesystem::path& folder);

}  // namespace osteomill::study
