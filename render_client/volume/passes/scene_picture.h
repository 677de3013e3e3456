// The picture of one moment: bone, soft structures, tool, force. The bone is a layer of its own (see
// IncrementalBonePass). Only the pixels that tool and overlay covered in one frame are copied from it in the
// next.
#pragma once

#include <optional>
#include <span>

#include "render_client/volume/passes/contact_shadow.h"
#include "render_client/volume/passes/incremental_bone_pass.h"
#include "render_client/volume/passes/light_field.h"
#include "render_client/volume/structures/structure_renderer.h"
#include "render_client/volume/tool/tool_renderer.h"

namespace osteomill {

class ScenePicture {
  public:
    /// `stopwatch` makes it draw on demand, at whatever quality keeps the rate of frames; null: always in
    /// full. Renderer and stopwatch must outlive it.
    /// `frame_s` is the part of a frame's time that it may take on demand.
    ScenePicture(BoneRenderer& renderer, const glm::ivec2& size_px, Stopwatch* stopwatch = nullptr,
                 double frame_s = target_frame_s);

    /// A size below one pixel counts as one.
    void resize(const glm::ivec2& size_px);
    /// Cuts and background, from the next draw on.
    void set_appearance(const SceneAppearance& look) { layer_.set_appearance(look); }
    /// The bone was replaced: its layer is drawn anew.
    void forget_bone(DrawingCost cost = DrawingCost::unknown) { layer_.forget(cost); }
    /// Adds a soft structure beside the bone; returns its number.
    std::size_t add_structure(const StructureSurface& surface, double opacity) {
        return structures_.add(surface, opacity);
    }
    /// By its number, from the next draw on.
    void show_structure(std::size_t structure, bool is_shown) { structures_.show(structure, is_shown); }
    /// Removes all structures; the next picture is drawn anew.
    void forget_structures() {
        structures_.forget();
        covered_.mark_all();
    }
    /// Marks voxels of `bone` that changed since the last draw, as its update returned them.
    void mark_dirty(const BoneTextures& bone, std::span<const VoxelBox> changed) {
        layer_.mark_dirty(bone, changed);
    }

    /// Draws into its own framebuffer and leaves it bound, so that an overlay may follow. Null: there is no
    /// bone, or no tool, yet.
    const gl::Framebuffer& draw(const BoneTextures* bone, const DrawnTool* tool, const Camera& camera);
    /// Marks the pixels drawn by an overlay, after draw: otherwise they would stay in the next frame.
    void cover(std::span<const PixelBox> boxes);

    /// Learns the time of the whole frame, waiting excluded.
    void frame_took(double frame_s) { layer_.frame_took(frame_s); }
    PictureQuality quality() const { return layer_.quality(); }
    const glm::ivec2& size_px() const { return picture_.size_px(); }
    /// The framebuffer of the last draw().
    const gl::Framebuffer& framebuffer() const { return picture_; }

  private:
    IncrementalBonePass layer_;
    ToolRenderer tool_renderer_;
    StructureRenderer structures_;
    ContactShadow contact_shadow_;
    std::optional<LightField> light_field_;  ///< once it was wanted
    gl::Framebuffer picture_;
    TileMask covered_;  ///< where the picture does not show the layer
};

}  // namespace osteomill
