// The picture of one moment for one eye or for two (stereo.h): each eye has a ScenePicture of its own, the
// bone's textures and its shaders are shared.
#pragma once

#include <optional>
#include <vector>

#include "render_client/volume/gl/draw_timer.h"
#include "render_client/volume/passes/scene_picture.h"
#include "render_client/volume/stereo.h"

namespace osteomill {

class StereoPicture {
  public:
    /// On demand it draws at whatever quality keeps the rate of frames; otherwise always in full. The
    /// renderer must outlive it. A size below one pixel counts as one.
    StereoPicture(BoneRenderer& renderer, const glm::ivec2& size_px, bool on_demand,
                  const StereoSettings& stereo);

    // These are as in ScenePicture, for both eyes.
    void resize(const glm::ivec2& size_px);
    void set_appearance(const SceneAppearance& look);
    void forget_bone(DrawingCost cost = DrawingCost::unknown);
    std::size_t add_structure(const StructureSurface& surface, double opacity);
    void show_structure(std::size_t structure, bool is_shown);
    void forget_structures();
    void mark_dirty(const BoneTextures& bone, std::span<const VoxelBox> changed);
    void frame_took(double frame_s);
    PictureQuality quality() const;

    /// Draws each eye's picture; an overlay may follow into all of pictures(), which then are cover()ed.
    void draw(const BoneTextures* bone, const DrawnTool* tool, const Camera& middle);
    std::span<const gl::Framebuffer* const> pictures() const { return pictures_; }
    void cover(std::span<const PixelBox> boxes);
    /// Combines them into one picture, which is bound afterwards. With quad buffering the left eye's picture
    /// is bound.
    const gl::Framebuffer& compose();
    /// Copies the last picture that compose() made.
    void copy_to_window() const;

    /// Size of the whole picture, and of each eye's.
    const glm::ivec2& size_px() const { return size_px_; }
    const glm::ivec2& eye_size_px() const { return left_.size_px(); }

  private:
    bool is_composed() const;
    void note_pictures();

    BoneRenderer& renderer_;
    StereoSettings stereo_;
    glm::ivec2 size_px_;
    gl::DrawTimer left_timer_;
    gl::DrawTimer right_timer_;
    ScenePicture left_;  ///< or the middle's
    std::optional<ScenePicture> right_;
    std::vector<const gl::Framebuffer*> pictures_;
    std::optional<gl::Framebuffer> whole_;
    std::optional<gl::Program> interleave_;
};

}  // namespace osteomill
