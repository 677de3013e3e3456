// The part of the picture that can show a box of patient space.
#pragma once

#include <cstdint>
#include <optional>

#include "render_client/volume/camera.h"

namespace osteomill {

/// Pixels (from the lower left corner, as glScissor counts) that can show a box of patient space; nothing if
/// the box reaches behind the camera, so that any pixel could show it.
struct PixelBox {
    glm::ivec2 first{0};
    glm::ivec2 size{0};

    bool operator==(const PixelBox&) const = default;
    std::int64_t count() const { return static_cast<std::int64_t>(size.x) * size.y; }
};
std::optional<PixelBox> pixels_of_box(const Camera& camera, const glm::dvec3& low_mm,
                                      const glm::dvec3& high_mm, const glm::ivec2& size_px);

}  // namespace osteomill
