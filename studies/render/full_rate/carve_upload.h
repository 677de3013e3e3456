// Contents of a bone's textures, and the cost of applying a carve to them.
#pragma once

#include <string>
#include <vector>

#include "render_client/volume/textures/texture_plan.h"
#include "studies/render/picture_trial.h"

namespace osteomill::study {

struct CarveUpload {
    TexturePlan plan{};
    std::vector<TextureSize> textures{};
    FrameMilliseconds by_frame{};  ///< the cut of the 5 mm burr from one frame to the next
    FrameMilliseconds by_ball{};   ///< a ball of 5 mm at once, at the burr's first place
    std::size_t bricks_of_ball = 0;
};

/// Uploads `times` carves of either kind of a phantom, with render_client's default appearance and limits;
/// each is timed until OpenGL has finished. Needs a current context. Throws std::runtime_error if the burr
/// meets no bone.
CarveUpload upload_carves(const std::string& phantom, int times);

}  // namespace osteomill::study
