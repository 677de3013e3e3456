// Pictures and their cost.
#pragma once

#include <glm/vec2.hpp>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/bone_renderer.h"

namespace osteomill::study {

/// The cost of a piece of work: wall time until OpenGL had finished it, and the time of all threads of this
/// process.
struct Cost {
    double wall_ms = 0.0;
    double cpu_ms = 0.0;
};

struct TimedPicture {
    Picture picture;
    Cost cost;
};

/// Draws the whole bone layer at `size_px` once unmeasured, then `times` times; the median of each. The
/// smallest would hide a driver's occasional work, and the mean would include other load on the machine. With
/// `times` 0, the first time, for drawing that takes seconds. Needs a current context.
TimedPicture timed_drawing(BoneRenderer& renderer, const BoneTextures& bone, const Camera& camera,
                           const glm::ivec2& size_px, int times);

/// A picture of another size, bilinear between pixels, as a coarser one is shown in a window.
Picture scaled(const Picture& picture, const glm::ivec2& size_px);

}  // namespace osteomill::study
