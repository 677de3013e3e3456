// The ways of drawing the bone, by name.
#pragma once

#include <memory>

#include "render_client/volume/passes/bone_renderer.h"

namespace osteomill {

enum class RendererChoice {
    raycast,  ///< the default: fast, because it skips empty space
    slices    ///< as published: every slice through the 3D texture
};

std::unique_ptr<BoneRenderer> make_renderer(RendererChoice choice);

}  // namespace osteomill
