// The picture of one moment: bone, tool, force. The bone's layer is kept, and drawn again only when camera,
// size or bone change; after a carve under a still camera only where the carve can be seen.
#pragma once

#include <optional>
#include <span>

#include "render_client/volume/bone_renderer.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/tool_renderer.h"

namespace osteomill {

class ScenePicture {
  public:
    ScenePicture(BoneRenderer& renderer, const glm::ivec2& size_px);

    /// Sizes of less than one pixel count as one.
    void resize(const glm::ivec2& size_px);
    /// The bone was replaced: its layer is drawn anew.
    void forget_bone();
    /// These bricks changed since the last draw.
    void mark_dirty(const BoneTextures& bone, std::span<const BrickIndex> bricks);

    /// Draws into its own framebuffer and leaves it bound, so that an overlay may follow. Null: there is no
    /// bone, or no tool, yet.
    const gl::Framebuffer& draw(const BoneTextures* bone, const DrawnTool* tool, const Camera& camera);

    const glm::ivec2& size_px() const { return layer_.size_px(); }

  private:
    void draw_layer(const BoneTextures& bone, const Camera& camera);

    BoneRenderer& renderer_;
    ToolRenderer tool_renderer_;
    gl::Framebuffer layer_;
    gl::Framebuffer picture_;
    std::optional<Camera> layer_camera_;  ///< none: the layer is stale everywhere
    std::vector<VoxelBox> dirty_;         ///< voxels of the bone's grid
};

/// Pixels (from the lower left corner, as glScissor counts) that can show a box of patient space; none where
/// it reaches behind the camera and could be anywhere.
struct PixelBox {
    glm::ivec2 first{0};
    glm::ivec2 size{0};
};
std::optional<PixelBox> pixels_of_box(const Camera& camera, const glm::dvec3& low_mm,
                                      const glm::dvec3& high_mm, const glm::ivec2& size_px);

}  // namespace osteomill
