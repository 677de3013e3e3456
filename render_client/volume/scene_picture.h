// The picture of one moment: bone, tool, force. The bone's layer is kept, and drawn again only when camera,
// size or bone change; after a carve under a still camera only where the carve can be seen.
#pragma once

#include <optional>
#include <span>

#include "render_client/volume/bone_renderer.h"
#include "render_client/volume/contact_shadow.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/pixel_box.h"
#include "render_client/volume/tool_renderer.h"

namespace osteomill {

class ScenePicture {
  public:
    ScenePicture(BoneRenderer& renderer, const glm::ivec2& size_px);

    /// Sizes of less than one pixel count as one.
    void resize(const glm::ivec2& size_px);
    /// Cuts and background, from the next draw on; another look than before draws the layer anew.
    void set_look(const SceneLook& look);
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
    ContactShadow contact_shadow_;
    gl::Framebuffer layer_;
    gl::Framebuffer picture_;
    std::optional<Camera> layer_camera_;  ///< none: the layer is stale everywhere
    std::vector<VoxelBox> dirty_;         ///< voxels of the bone's grid
};

}  // namespace osteomill
