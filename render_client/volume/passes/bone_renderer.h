// Interface of a renderer of the bone, and the background that each draws first.
#pragma once

#include <epoxy/gl.h>

#include <glm/vec2.hpp>
#include <memory>
#include <span>

#include "render_client/volume/camera.h"
#include "render_client/volume/gl/program.h"
#include "render_client/volume/scene_appearance.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

class BoneRenderer {
  public:
    virtual ~BoneRenderer() = default;
    /// Draws background and bone, colour and depth, over the whole viewport of `size_px` in the bound
    /// framebuffer, within glScissor's part. Depth is that of Camera::projection.
    virtual void draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) = 0;
    /// The same in each of these parts alone. Leaves the scissor test off.
    virtual void draw_parts(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px,
                            std::span<const PixelBox> parts) {
        glEnable(GL_SCISSOR_TEST);
        for (const PixelBox& part : parts) {
            glScissor(part.first.x, part.first.y, part.size.x, part.size.y);
            draw(bone, camera, size_px);
        }
        glDisable(GL_SCISSOR_TEST);
    }

    /// Takes effect from the next draw on.
    void set_appearance(const SceneAppearance& look) { look_ = look; }
    const SceneAppearance& look() const { return look_; }

  private:
    SceneAppearance look_;
};

/// The ways of drawing the bone, by name.
enum class RendererChoice {
    raycast,  ///< the default: fast, because it skips empty space
    slices    ///< as published: every slice through the 3D texture
};

std::unique_ptr<BoneRenderer> make_renderer(RendererChoice choice);

/// The background of a picture, drawn first over all of it: the renderer then skips pixels without bone.
class Background {
  public:
    Background();
    /// Colour, and depth 1, over the viewport of `size_px`, within glScissor's part.
    void draw(const SceneAppearance& look, const glm::ivec2& size_px);

  private:
    gl::Program program_;
};

}  // namespace osteomill
