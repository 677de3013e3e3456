#include "studies/render/timed_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "common/statistics/percentile.h"
#include "studies/render/full_rate/finished_frames.h"

namespace osteomill::study {

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

}  // namespace osteomill::study
