#include "studies/render/timed_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <glm/common.hpp>
#include <vector>

#include "common/statistics/percentile.h"

namespace osteomill::study {

namespace {

double cpu_now_ms() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double wall_now_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

Cost median_cost(const std::function<void()>& work, int times) {
    return median_cost([] {}, work, times);
}

Cost median_cost(const std::function<void()>& prepare, const std::function<void()>& work, int times) {
    std::vector<double> wall_ms, cpu_ms;
    for (int time = 0; time <= times; ++time) {
        prepare();
        glFinish();
        const double wall_before = wall_now_ms(), cpu_before = cpu_now_ms();
        work();
        glFinish();
        if (time == 0 && times > 0) continue;
        wall_ms.push_back(wall_now_ms() - wall_before);
        cpu_ms.push_back(cpu_now_ms() - cpu_before);
    }
    return {percentile(wall_ms, 0.5), percentile(cpu_ms, 0.5)};
}

TimedPicture timed_drawing(BoneRenderer& renderer, const BoneTextures& bone, const Camera& camera,
                           const glm::ivec2& size_px, int times) {
    const gl::Framebuffer framebuffer(size_px);
    const Cost cost = median_cost(
        [&] {
            framebuffer.bind();
            renderer.draw(bone, camera, size_px);
        },
        times);
    return {framebuffer.read_back(), cost};
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
