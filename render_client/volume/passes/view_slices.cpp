#include "render_client/volume/passes/view_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace osteomill {

namespace {

/// Corners of a box by three bits, its edges by the corners at their ends.
constexpr std::array<std::array<unsigned, 2>, 12> edges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Puts the corners of a convex polygon in order round its middle.
void sort_round_middle(std::vector<glm::dvec3>& polygon, const glm::dvec3& normal) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : polygon) middle += corner / static_cast<double>(polygon.size());
    const glm::dvec3 first = polygon.front() - middle;
    const glm::dvec3 second = glm::cross(normal, first);
    const auto angle = [&](const glm::dvec3& corner) {
        return std::atan2(glm::dot(corner - middle, second), glm::dot(corner - middle, first));
    };
    std::sort(polygon.begin(), polygon.end(),
              [&](const glm::dvec3& a, const glm::dvec3& b) { return angle(a) < angle(b); });
}

}  // namespace

std::vector<glm::vec3> view_slices(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& eye,
                                   const glm::dvec3& forward, double spacing) {
    if (!(spacing > 0.0)) throw std::invalid_argument("slices need a positive spacing");
    std::array<glm::dvec3, 8> corners{};
    std::array<double, 8> depths{};
    for (unsigned i = 0; i < 8; ++i) {
        corners[i] = {i & 1U ? high.x : low.x, i & 2U ? high.y : low.y, i & 4U ? high.z : low.z};
        depths[i] = glm::dot(corners[i] - eye, forward);
    }
    const auto [nearest, farthest] = std::minmax_element(depths.begin(), depths.end());
    const auto first = static_cast<long>(std::max(1.0, std::ceil(*nearest / spacing)));
    const auto last = static_cast<long>(std::floor(*farthest / spacing));

    std::vector<glm::vec3> triangles;
    std::vector<glm::dvec3> polygon;
    for (long slice = first; slice <= last; ++slice) {
        const double depth = spacing * static_cast<double>(slice);
        polygon.clear();
        for (const auto& [a, b] : edges) {
            if ((depths[a] < depth) == (depths[b] < depth)) continue;
            const double part = (depth - depths[a]) / (depths[b] - depths[a]);
            polygon.push_back(corners[a] + part * (corners[b] - corners[a]));
        }
        if (polygon.size() < 3) continue;
        sort_round_middle(polygon, forward);
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            triangles.emplace_back(polygon[0]);
            triangles.emplace_back(polygon[i - 1]);
            triangles.emplace_back(polygon[i]);
        }
    }
    return triangles;
}

}  // namespace osteomill
