// Interface of a renderer of the bone.
#pragma once

#include <glm/vec2.hpp>

#include "render_client/volume/camera.h"
#include "render_client/volume/scene_appearance.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

class BoneRenderer {
  public:
    virtual ~BoneRenderer() = default;
    /// Draws background and bone, colour and depth, over the whole viewport of `size_px` in the bound
    /// framebuffer, within glScissor's part. Depth is that of Camera::projection.
    virtual void draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) = 0;

    /// Takes effect from the next draw on.
    void set_appearance(const SceneAppearance& look) { look_ = look; }
    const SceneAppearance& look() const { return look_; }

  private:
    SceneAppearance look_;
};

}  // namespace osteomill
