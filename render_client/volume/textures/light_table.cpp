#include "render_client/volume/textures/light_table.h"

#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "render_client/volume/shaders/lighting.h"

namespace osteomill {

namespace {

/// Above the sum of all lights.
constexpr double brightest = 1.1;

/// Direction of a place in the square from -1 to 1: the octahedron's lower half is folded outwards.
glm::dvec3 direction_at(double x, double y) {
    const double z = 1.0 - std::abs(x) - std::abs(y);
    if (z >= 0.0) return glm::normalize(glm::dvec3(x, y, z));
    return glm::normalize(
        glm::dvec3(std::copysign(1.0 - std::abs(y), x), std::copysign(1.0 - std::abs(x), y), z));
}

}  // namespace

LightTable::LightTable() {
    lights_.reserve(static_cast<std::size_t>(edge) * edge);
    const auto place = [](int i) { return (i + 0.5) * 2.0 / edge - 1.0; };
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            const glm::dvec3 light = lit(glm::dvec3(1.0), direction_at(place(x), place(y)), 1.0);
            // As display(), without its clamping.
            const glm::dvec3 shown = glm::pow(light, glm::dvec3(1.0 / 2.2));
            lights_.emplace_back(glm::u8vec3(glm::round(shown * (255.0 / brightest))), std::uint8_t{0});
        }
}

glm::vec3 LightTable::towards(const glm::ivec3& outward) const {
    const int length = std::abs(outward.x) + std::abs(outward.y) + std::abs(outward.z);
    const float scale = 1.0f / static_cast<float>(length);
    float x = static_cast<float>(outward.x) * scale, y = static_cast<float>(outward.y) * scale;
    if (outward.z < 0) {
        const float folded_x = std::copysign(1.0f - std::abs(y), x);
        y = std::copysign(1.0f - std::abs(x), y);
        x = folded_x;
    }
    constexpr float half_edge = 0.5f * edge;
    // A little less than the edge, so that 1 falls into the last cell.
    const auto cell = [](float place) { return static_cast<int>((place + 1.0f) * (half_edge - 1e-4f)); };
    const glm::u8vec4& light = lights_[static_cast<std::size_t>(cell(y) * edge + cell(x))];
    return glm::vec3(light) * static_cast<float>(brightest / 255.0);
}

}  // namespace osteomill
