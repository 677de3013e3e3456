// A view of a bone in one appearance, drawn in any way of drawing: the cost of a frame, and the picture's
// distance from the reference image of the same appearance.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "render_client/volume/bone_colours.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/gl/draw_timer.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "studies/render/cue_cost.h"

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

/// Seen whole, from the front and above.
Camera overview_of(const Bone& bone);
/// A view of the middle of another view, with that radius in mm. Throws std::runtime_error if it shows no
/// bone.
Camera close_up_of(const Bone& bone, const Camera& view, double shown_radius_mm);

/// A way to draw.
struct DrawingWay {
    RendererChoice renderer = RendererChoice::raycast;
    float step_voxels = RaycastSettings{}.step_voxels;  ///< between a ray's samples, or between slices
    bool skips = true;                                  ///< whether rays skip empty space
    int divisor = 1;  ///< width and height are divided by it and the picture is scaled up again
};

/// A way's cost and its picture.
struct DrawnWay {
    Cost frame{};
    double psnr_db = 0.0;  ///< infinite for the reference itself
    double ssim = 0.0;
};

class PictureTrial {
  public:
    /// Uploads the bone and makes the reference, in a context of its own that it makes current whenever it
    /// draws. Without `smoothed_normals` a normal takes 64 samples in place of 8, as where memory is short.
    /// `gpu`: as of OffscreenContext. Throws gl::NoOpenGl, and std::runtime_error for a bone without bricks.
    PictureTrial(const Bone& bone, std::span<const TissueColour> tissues, const ShadingSettings& look,
                 const Camera& camera, const glm::ivec2& size_px, bool smoothed_normals,
                 std::optional<int> gpu = std::nullopt);
    ~PictureTrial();
    PictureTrial(const PictureTrial&) = delete;
    PictureTrial& operator=(const PictureTrial&) = delete;

    /// Draws as the reference does: no thin bone, a ray a pixel. Its time is the median of so many frames;
    /// with 0 the first one's, for ways that take seconds.
    DrawnWay draw(const DrawingWay& way, int times) const;
    /// The cost of a cue of the usual appearance (cue_names), by so many pairs of frames.
    CueCost cue(std::string_view name, int pairs) const;
    SilhouettePsnr silhouettes() const;
    /// Whether normals are taken from smoothed fractions: not if they do not fit, nor of surface voxels.
    bool has_smoothed_normals() const { return textures_->smoothed() != nullptr; }
    const std::string& gl_renderer() const { return gl_renderer_; }

  private:
    gl::OffscreenContext context_;
    std::string gl_renderer_;
    Camera camera_;
    Picture reference_;
    std::unique_ptr<BoneTextures> textures_;
};

/// The cost of a frame of an overview, without a picture to compare it with: the median of `times` frames,
/// with 0 that of the first. In a context of its own. Throws as the constructor of PictureTrial.
Cost frame_cost(const Bone& bone, std::span<const TissueColour> tissues, const ShadingSettings& look,
                const glm::ivec2& size_px, const DrawingWay& way, int times);

// Times of frames that were finished: each drawn to its last pixel before the next began, as showing it
// needs.

/// By frame, in order.
struct FrameMilliseconds {
    std::vector<double> wall{};  ///< until the picture was there
    std::vector<double>
        gpu{};  ///< the driver's own work (GL_TIME_ELAPSED); for a software rasteriser, wall time
    std::vector<double> cpu{};  ///< all threads of the process
};

class FrameStopwatch {
  public:
    /// Needs a current OpenGL context, in which nothing else measures GL_TIME_ELAPSED.
    FrameStopwatch() = default;
    /// `work` draws one frame and returns when its pixels are there.
    void time(const std::function<void()>& work);
    const FrameMilliseconds& frames() const { return frames_; }

  private:
    gl::DrawTimer timer_;
    FrameMilliseconds frames_;
};

}  // namespace osteomill::study
