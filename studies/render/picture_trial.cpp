#include "studies/render/picture_trial.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>
#include <thread>

#include "common/statistics/percentile.h"
#include "render_client/volume/passes/slice_renderer.h"
#include "render_client/volume/textures/voxel_box.h"
#include "studies/render/picture_difference.h"
#include "studies/render/reference_image.h"

namespace osteomill::study {

namespace {

std::unique_ptr<BoneRenderer> renderer_of(const DrawingWay& way) {
    if (way.renderer == RendererChoice::slices)
        return std::make_unique<SliceRenderer>(SliceSettings{.spacing_voxels = way.step_voxels});
    return std::make_unique<RaycastRenderer>(
        RaycastSettings{.skipping = way.skips ? EmptySpaceSkipping::distance_map : EmptySpaceSkipping::none,
                        .step_voxels = way.step_voxels});
}

/// Smoothed fractions are had only if all stays within half of the budget.
std::unique_ptr<BoneTextures> textures_of(const Bone& bone, std::span<const TissueColour> tissues,
                                          const ShadingSettings& look, bool smoothed_normals) {
    auto textures = std::make_unique<BoneTextures>(bone, tissues, look);
    if (smoothed_normals || !textures->smoothed()) return textures;
    const TextureLimits limits{.budget_bytes = 2 * textures->plan().bytes - 1,
                               .layout = textures->plan().layout};
    textures.reset();
    return std::make_unique<BoneTextures>(bone, tissues, look, limits);
}

}  // namespace

Camera overview_of(const Bone& bone) {
    const VoxelBox box = stored_box(bone.content());
    const glm::dvec3 middle_mm = 0.5 * (centre_of_voxel_mm(bone.grid(), box.first) +
                                        centre_of_voxel_mm(bone.grid(), box.first + box.size - 1));
    return camera_on(middle_mm, 0.5 * bone.grid().spacing_mm * glm::length(glm::dvec3(box.size)));
}

Camera close_up_of(const Bone& bone, const Camera& view, double shown_radius_mm) {
    const double step_mm = 0.5 * bone.grid().spacing_mm;
    for (double distance = 0.0; distance < view.far_mm; distance += step_mm) {
        const glm::dvec3 place = view.eye_mm() + distance * view.forward();
        const glm::ivec3 voxel(glm::round(to_voxel_coordinates(bone.grid(), place)));
        if (bone.fraction_at(voxel) < 128) continue;
        Camera camera = camera_on(place, shown_radius_mm);
        camera.azimuth_rad = view.azimuth_rad;
        camera.elevation_rad = view.elevation_rad;
        return camera;
    }
    throw std::runtime_error("the view's middle shows no bone");
}

PictureTrial::PictureTrial(const Bone& bone, std::span<const TissueColour> tissues,
                           const ShadingSettings& look, const Camera& camera, const glm::ivec2& size_px,
                           bool smoothed_normals, std::optional<int> gpu)
    : context_(gpu),
      gl_renderer_(gl::renderer_name()),
      camera_(camera),
      reference_(reference_image(ReferenceVolume(bone, tissues, look), camera, size_px,
                                 {.threads = std::max(1u, std::thread::hardware_concurrency())})),
      textures_(textures_of(bone, tissues, look, smoothed_normals)) {}

PictureTrial::~PictureTrial() {
    context_.make_current();
    textures_.reset();
}

DrawnWay PictureTrial::draw(const DrawingWay& way, int times) const {
    context_.make_current();
    const glm::ivec2& size_px = reference_.size_px;
    const auto renderer = renderer_of(way);
    renderer->set_appearance({.thin_bone = false, .smooth_silhouettes = false});
    const TimedPicture drawn =
        timed_drawing(*renderer, *textures_, camera_, glm::max(size_px / way.divisor, 1), times);
    const Picture shown = way.divisor == 1 ? drawn.picture : scaled(drawn.picture, size_px);
    return {.frame = drawn.cost, .psnr_db = psnr_db(shown, reference_), .ssim = ssim(shown, reference_)};
}

CueCost PictureTrial::cue(std::string_view name, int pairs) const {
    context_.make_current();
    return cue_cost(name, *textures_, camera_, reference_.size_px, pairs);
}

SilhouettePsnr PictureTrial::silhouettes() const {
    context_.make_current();
    return silhouette_psnr(*textures_, camera_, reference_.size_px);
}

Cost frame_cost(const Bone& bone, std::span<const TissueColour> tissues, const ShadingSettings& look,
                const glm::ivec2& size_px, const DrawingWay& way, int times) {
    const gl::OffscreenContext context;
    const BoneTextures textures(bone, tissues, look);
    return timed_drawing(*renderer_of(way), textures, overview_of(bone), size_px, times).cost;
}

TimedPicture timed_drawing(BoneRenderer& renderer, const BoneTextures& bone, const Camera& camera,
                           const glm::ivec2& size_px, int times) {
    const gl::Framebuffer framebuffer(size_px);
    const auto draw = [&] {
        framebuffer.bind();
        renderer.draw(bone, camera, size_px);
        glFinish();
    };
    if (times > 0) draw();
    FrameStopwatch stopwatch;
    for (int time = 0; time < std::max(times, 1); ++time) stopwatch.time(draw);
    const FrameMilliseconds& frames = stopwatch.frames();
    return {framebuffer.read_back(), {percentile(frames.wall, 0.5), percentile(frames.cpu, 0.5)}};
}

Picture scaled(const Picture& picture, const glm::ivec2& size_px) {
    Picture result(size_px);
    const glm::dvec2 factor = glm::dvec2(picture.size_px) / glm::dvec2(size_px);
    const glm::ivec2 last = picture.size_px - 1;
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            const glm::dvec2 place =
                glm::clamp((glm::dvec2(x, y) + 0.5) * factor - 0.5, glm::dvec2(0.0), glm::dvec2(last));
            const glm::ivec2 low = glm::ivec2(place);
            const glm::ivec2 high = glm::min(low + 1, last);
            const glm::dvec2 part = place - glm::dvec2(low);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const auto at = [&](int px, int py) {
                    return static_cast<double>(picture.at(px, py)[channel]);
                };
                const double upper = glm::mix(at(low.x, low.y), at(high.x, low.y), part.x);
                const double lower = glm::mix(at(low.x, high.y), at(high.x, high.y), part.x);
                result.rgb[3 * (static_cast<std::size_t>(y) * size_px.x + x) + channel] =
                    static_cast<std::uint8_t>(std::lround(glm::mix(upper, lower, part.y)));
            }
        }
    return result;
}

namespace {

using Clock = std::chrono::steady_clock;

double cpu_now_ms() {
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void FrameStopwatch::time(const std::function<void()>& work) {
    const double cpu_before_ms = cpu_now_ms();
    const Clock::time_point start = Clock::now();
    timer_.start();
    work();
    timer_.stop();
    frames_.wall.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    frames_.cpu.push_back(cpu_now_ms() - cpu_before_ms);
    std::optional<double> took_s = timer_.take_s();
    while (!took_s) took_s = timer_.take_s();
    frames_.gpu.push_back(1e3 * *took_s);
}

}  // namespace osteomill::study
