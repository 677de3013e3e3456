#include "render_client/volume/passes/pixel_box.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace osteomill {

std::optional<PixelBox> pixels_of_box(const Camera& camera, const glm::dvec3& low_mm,
                                      const glm::dvec3& high_mm, const glm::ivec2& size_px) {
    glm::dvec2 first(size_px), last(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place(corner & 1 ? high_mm.x : low_mm.x, corner & 2 ? high_mm.y : low_mm.y,
                               corner & 4 ? high_mm.z : low_mm.z);
        if (!camera.has_in_front(place)) return std::nullopt;
        const glm::dvec2 pixel = pixel_of(camera, place, size_px);
        first = glm::min(first, pixel);
        last = glm::max(last, pixel);
    }
    const glm::ivec2 low = glm::clamp(glm::ivec2(glm::floor(first)) - 1, glm::ivec2(0), size_px);
    const glm::ivec2 high = glm::clamp(glm::ivec2(glm::ceil(last)) + 1, glm::ivec2(0), size_px);
    const glm::ivec2 size = glm::max(high - low, 0);
    // pixel_of counts rows from the top.
    return PixelBox{{low.x, size_px.y - low.y - size.y}, size};
}

}  // namespace osteomill
