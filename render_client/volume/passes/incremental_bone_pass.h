// The bone's part of the picture, kept from frame to frame: only the parts that show a change are drawn
// again.
//
// Each tile of the picture is either exact, as the renderer would draw it now, or stale. A motion of the
// camera makes all tiles stale; under a still camera a change makes those tiles stale whose rays, or whose
// shading, can meet a changed brick. Stale tiles are drawn again at once if time allows. Otherwise tiles that
// show a removed surface are drawn at a lower resolution and upscaled; tiles in which a nearby carve changes
// only the ambient light stay as they are. Once the camera rests, all become exact piece by piece, as frames
// can afford it. The pieces are drawn aside, and shown together when none is left: there is no seam between
// sharp and coarse parts that moves through the picture.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render_client/volume/gl/draw_timer.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/gl/program.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/passes/detail_control.h"
#include "render_client/volume/passes/tile_mask.h"
#include "render_client/volume/picture.h"

namespace osteomill {

/// A coarse picture upscaled into a finer one: colour interpolated, depth not, so that bone still hides the
/// parts of later drawings behind it.
class Upscaler {
  public:
    Upscaler();
    /// Fills these boxes of `fine` with those of `coarse`; both show the same view.
    void draw(const gl::Framebuffer& coarse, const gl::Framebuffer& fine,
              std::span<const PixelBox> boxes) const;

  private:
    gl::Program program_;
};

/// The tiles of a picture that can show changes of these voxels of the bone's grid(), if shading reads
/// `reach_voxels` around a voxel (bone_program.h).
TileMask tiles_of_changes(std::span<const VoxelBox> changed, const BoneTextures& bone, const Camera& camera,
                          const glm::ivec2& size_px, int reach_voxels);

class IncrementalBonePass {
  public:
    /// `stopwatch` makes it draw on demand, at whatever quality keeps the rate of frames; null: always in
    /// full, however long it takes. Renderer and stopwatch must outlive this object. The size is at least one
    /// pixel each way. `frame_s` is the part of a frame's time that it may take.
    IncrementalBonePass(BoneRenderer& renderer, const glm::ivec2& size_px, Stopwatch* stopwatch,
                        double frame_s = target_frame_s);

    void resize(const glm::ivec2& size_px);
    /// Cuts and background; a changed appearance makes all tiles stale.
    void set_appearance(const SceneAppearance& look);
    const SceneAppearance& look() const { return renderer_.look(); }
    /// Another bone: all tiles are stale.
    void forget(DrawingCost cost = DrawingCost::as_before);
    /// Marks voxels of `bone` that changed since the last update, as its own update returned them.
    void mark_dirty(const BoneTextures& bone, std::span<const VoxelBox> changed);

    /// Draws the tiles that are due. Returns those that look different from before. Leaves some framebuffer
    /// bound.
    TileMask update(const BoneTextures& bone, const Camera& camera);
    /// Learns the time of a whole frame, waiting excluded: the time of its other parts is not available to
    /// draw bone.
    void frame_took(double frame_s);

    PictureQuality quality() const;
    /// Background and bone of the last update, colour and depth.
    const gl::Framebuffer& framebuffer() const { return layer_; }
    const glm::ivec2& size_px() const { return layer_.size_px(); }

  private:
    struct Measured {
        Extent extent;
        std::int64_t pixels;
        std::int64_t pixels_of_frame = 0;  ///< with what else was drawn in that frame
        bool is_history = false;           ///< what was drawn then is drawn no more
    };

    void learn();
    void draw_exact(const BoneTextures& bone, const Camera& camera, const TileMask& tiles, Extent extent);
    /// These return the pixels that they drew.
    std::int64_t draw_coarse(const BoneTextures& bone, const Camera& camera, const TileMask& tiles,
                             Extent extent, double divisor);
    std::int64_t draw_timed(const BoneTextures& bone, const Camera& camera, const gl::Framebuffer& target,
                            std::span<const PixelBox> boxes, Extent extent);
    /// Takes turns: parts that did not fit come first the next time.
    TileMask part_that_fits(const TileMask& tiles, std::int64_t room_px);
    void draw_aside(const BoneTextures& bone, const Camera& camera, const TileMask& tiles, Extent extent);
    /// Shows what was drawn aside; returns those tiles.
    TileMask show_refined();

    BoneRenderer& renderer_;
    Stopwatch* stopwatch_;
    Upscaler upscaler_;
    DetailControl control_;
    gl::Framebuffer layer_;
    gl::Framebuffer coarse_;                ///< where stale parts are drawn before they are upscaled
    std::optional<gl::Framebuffer> aside_;  ///< once parts were refined
    TileMask stale_;
    TileMask refined_;               ///< of the stale ones, those drawn aside and not shown yet
    double coarsest_divisor_ = 1.0;  ///< among the stale tiles
    std::size_t next_tile_ = 0;      ///< whose turn it is to be refined
    std::vector<VoxelBox> dirty_;  ///< voxels of the bone's grid, whole blocks: shading reads means over them
    std::optional<Camera> camera_;  ///< that the layer shows; none: there is nothing in it yet
    int frames_at_rest_ = 0;        ///< of the camera
    int frames_of_calm_ = 0;        ///< of camera and bone
    std::int64_t drawn_this_frame_px_ = 0;
    bool measures_this_frame_ = false;
    std::optional<Measured> measured_;  ///< what the stopwatch runs, or ran, for
    std::optional<double> frame_s_;     ///< how long that frame took
};

}  // namespace osteomill
