#include "studies/render/cue_cost.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/statistics/percentile.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/tool/tool_renderer.h"
#include "studies/render/picture_trial.h"

namespace osteomill::study {

namespace {

constexpr int rays_a_side = 4;
constexpr double discontinuity_mm = 1.0;

bool is_of_tool(std::string_view cue) {
    return cue == "handpiece" || cue == "motion blur";
}

/// A burr of 5 mm, or the nose of its handpiece, before what the camera looks at; the handpiece points
/// upwards and a little towards the eye.
DrawnTool tool_with(std::string_view cue, bool is_on, const Camera& camera) {
    constexpr double nose_mm = 40.0;  // above the burr
    DrawnTool tool;
    tool.state.spindle_axis = glm::normalize(camera.up() - 0.3 * camera.forward());
    tool.state.burr_position_mm = camera.target_mm - 0.5 * camera.distance_mm * camera.forward();
    if (cue == "handpiece") tool.state.burr_position_mm -= nose_mm * tool.state.spindle_axis;
    tool.has_handpiece = cue == "handpiece" && is_on;
    tool.motion = cue == "motion blur" && is_on ? BurrMotion::at_speed : BurrMotion::still;
    return tool;
}

/// Frames of the usual picture with one of its cues, or without it.
class CuedFrames {
  public:
    CuedFrames(std::string_view cue, bool is_on, const Camera& camera, const glm::ivec2& size_px)
        : framebuffer_(size_px), camera_(camera), covered_(size_px) {
        bone_.set_appearance(look_with(cue, is_on));
        if (!is_of_tool(cue)) return;
        tool_.emplace();
        drawn_tool_ = tool_with(cue, is_on, camera);
    }

    void draw(const BoneTextures& bone) {
        framebuffer_.bind();
        bone_.draw(bone, camera_, framebuffer_.size_px());
        if (!tool_) return;
        tool_->draw(drawn_tool_, camera_, covered_);
        tool_->draw_seen_through(drawn_tool_, camera_, framebuffer_.size_px());
    }
    Picture read_back() const { return framebuffer_.read_back(); }

  private:
    gl::Framebuffer framebuffer_;
    Camera camera_;
    TileMask covered_;
    RaycastRenderer bone_;
    std::optional<ToolRenderer> tool_;
    DrawnTool drawn_tool_;
};

Picture drawn(BoneRenderer& renderer, const gl::Framebuffer& framebuffer, const BoneTextures& bone,
              const Camera& camera) {
    framebuffer.bind();
    renderer.draw(bone, camera, framebuffer.size_px());
    return framebuffer.read_back();
}

double distance_mm(const Camera& camera, const glm::ivec2& size_px, float window_depth) {
    const glm::dmat4 projection = camera.projection(size_px);
    return projection[3][2] / (2.0 * static_cast<double>(window_depth) - 1.0 + projection[2][2]);
}

/// Summary of the squares of rays, one for each pixel: their mean, and whether depth is discontinuous among
/// them.
struct Supersampled {
    Picture picture;
    std::vector<bool> is_silhouette;
};

Supersampled supersampled(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) {
    RaycastRenderer renderer({.step_voxels = 0.5f * RaycastSettings{}.step_voxels});
    renderer.set_appearance(look_with("smooth silhouettes", false));
    const glm::ivec2 fine_px = rays_a_side * size_px;
    const gl::Framebuffer framebuffer(fine_px);
    const Picture fine = drawn(renderer, framebuffer, bone, camera);
    const std::vector<float> depth = framebuffer.read_depth();
    Supersampled made{.picture = Picture(size_px), .is_silhouette = {}};
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            std::array<int, 3> sum{};
            float nearest = 1.0f, farthest = 0.0f;
            for (int ray = 0; ray < rays_a_side * rays_a_side; ++ray) {
                const int at_x = rays_a_side * x + ray % rays_a_side;
                const int at_y = rays_a_side * y + ray / rays_a_side;
                for (std::size_t channel = 0; channel < 3; ++channel)
                    sum[channel] += fine.at(at_x, at_y)[channel];
                const float here =
                    depth[static_cast<std::size_t>(at_y) * static_cast<std::size_t>(fine_px.x) +
                          static_cast<std::size_t>(at_x)];
                nearest = std::min(nearest, here);
                farthest = std::max(farthest, here);
            }
            for (std::size_t channel = 0; channel < 3; ++channel)
                made.picture.rgb[3 * made.is_silhouette.size() + channel] = static_cast<std::uint8_t>(
                    std::lround(static_cast<double>(sum[channel]) / (rays_a_side * rays_a_side)));
            made.is_silhouette.push_back(distance_mm(camera, size_px, farthest) -
                                             distance_mm(camera, size_px, nearest) >
                                         discontinuity_mm);
        }
    return made;
}

double psnr_on_silhouettes(const Picture& picture, const Supersampled& reference) {
    double squares = 0.0;
    std::size_t bytes = 0;
    for (std::size_t pixel = 0; pixel < reference.is_silhouette.size(); ++pixel) {
        if (!reference.is_silhouette[pixel]) continue;
        for (std::size_t byte = 3 * pixel; byte < 3 * pixel + 3; ++byte, ++bytes)
            squares += std::pow(picture.rgb[byte] - reference.picture.rgb[byte], 2.0);
    }
    return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(bytes) / squares);
}

}  // namespace

SceneAppearance look_with(std::string_view cue, bool is_on) {
    SceneAppearance look;
    if (cue == "ambient occlusion")
        look.ambient_occlusion = is_on;
    else if (cue == "thin bone")
        look.thin_bone = is_on;
    else if (cue == "smooth silhouettes")
        look.smooth_silhouettes = is_on;
    else if (cue == "wet bone")
        look.specular = is_on ? usual_wetness : 0.0f;
    else if (cue == "grain")
        look.grain = is_on;
    else if (cue == "sawn faces")
        look.neutral_sawn_faces = is_on;
    else if (!is_of_tool(cue))
        throw std::invalid_argument("no cue is called '" + std::string(cue) + "'");
    return look;
}

CueCost cue_cost(std::string_view cue, const BoneTextures& bone, const Camera& camera,
                 const glm::ivec2& size_px, int pairs) {
    CuedFrames without(cue, false, camera, size_px), with(cue, true, camera, size_px);
    without.draw(bone);
    with.draw(bone);
    const Picture plain = without.read_back();
    const Picture cued = with.read_back();
    FrameStopwatch without_watch, with_watch;
    const auto time = [&](CuedFrames& frames, FrameStopwatch& watch) {
        watch.time([&] {
            frames.draw(bone);
            glFinish();
        });
    };
    std::vector<double> parts, cpu_parts;
    for (int pair = 0; pair < std::max(pairs, 1); ++pair) {
        time(without, without_watch);
        time(with, with_watch);
        cpu_parts.push_back(with_watch.frames().cpu.back() / without_watch.frames().cpu.back() - 1.0);
        parts.push_back(with_watch.frames().wall.back() / without_watch.frames().wall.back() - 1.0);
    }
    std::size_t changed = 0;
    for (std::size_t pixel = 0; pixel < plain.rgb.size(); pixel += 3)
        if (!std::equal(plain.rgb.begin() + static_cast<std::ptrdiff_t>(pixel),
                        plain.rgb.begin() + static_cast<std::ptrdiff_t>(pixel + 3),
                        cued.rgb.begin() + static_cast<std::ptrdiff_t>(pixel)))
            ++changed;
    return {.without_ms = percentile(without_watch.frames().wall, 0.5),
            .with_ms = percentile(with_watch.frames().wall, 0.5),
            .part_of_frame = percentile(parts, 0.5),
            .part_of_cpu = percentile(cpu_parts, 0.5),
            .changed_pixels = 3.0 * static_cast<double>(changed) / static_cast<double>(plain.rgb.size())};
}

SilhouettePsnr silhouette_psnr(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size_px) {
    const Supersampled reference = supersampled(bone, camera, size_px);
    const gl::Framebuffer framebuffer(size_px);
    RaycastRenderer without, with;
    without.set_appearance(look_with("smooth silhouettes", false));
    with.set_appearance(look_with("smooth silhouettes", true));
    return {.without_db = psnr_on_silhouettes(drawn(without, framebuffer, bone, camera), reference),
            .with_db = psnr_on_silhouettes(drawn(with, framebuffer, bone, camera), reference),
            .pixels = static_cast<std::size_t>(
                std::count(reference.is_silhouette.begin(), reference.is_silhouette.end(), true))};
}

}  // namespace osteomill::study
