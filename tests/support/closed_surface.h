// Check that triangles close a volume, for tests: by their points' numbers, or by where the points are, which
// is all that a reader of STL has.
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace osteomill::testing {

using Triangle = std::array<std::uint32_t, 3>;

/// Edges that do not belong to exactly two triangles which pass along them in opposite directions.
inline std::size_t open_edges(std::span<const Triangle> triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> uses;
    for (const Triangle& triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = triangle[i];
            const std::uint32_t to = triangle[(i + 1) % 3];
            ++uses[{std::min(from, to), std::max(from, to)}][from < to ? 0 : 1];
        }
    std::size_t open = 0;
    for (const auto& [edge, count] : uses)
        if (edge.first == edge.second || count != std::array{1, 1}) ++open;
    return open;
}

/// The same triangles, of points that are numbered by their place.
inline std::vector<Triangle> welded(std::span<const glm::vec3> points_mm,
                                    std::span<const Triangle> triangles) {
    std::map<std::array<float, 3>, std::uint32_t> number_of;
    std::vector<Triangle> result(triangles.begin(), triangles.end());
    for (Triangle& triangle : result)
        for (std::uint32_t& point : triangle) {
            const glm::vec3& place = points_mm[point];
            point =
                number_of
                    .try_emplace({place.x, place.y, place.z}, static_cast<std::uint32_t>(number_of.size()))
                    .first->second;
        }
    return result;
}

/// Positive where the triangles are anticlockwise from outside (the divergence theorem).
inline double enclosed_mm3(std::span<const glm::vec3> points_mm, std::span<const Triangle> triangles) {
    double six_times = 0.0;
    const glm::dvec3 origin(points_mm.empty() ? glm::vec3(0.0F) : points_mm.front());
    for (const Triangle& t : triangles)
        six_times +=
            glm::dot(glm::dvec3(points_mm[t[0]]) - origin,
                     glm::cross(glm::dvec3(points_mm[t[1]]) - origin, glm::dvec3(points_mm[t[2]]) - origin));
    return six_times / 6.0;
}

}  // namespace osteomill::testing
