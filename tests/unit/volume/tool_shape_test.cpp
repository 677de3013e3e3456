#include "render_client/volume/tool/tool_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

namespace osteomill::tool_shape_test {
namespace {

Triangles burr_and_shank(const BurrShape& burr) {
    Triangles tool = burr_head(burr);
    const Triangles shank = burr_shank(burr);
    tool.vertices.insert(tool.vertices.end(), shank.vertices.begin(), shank.vertices.end());
    return tool;
}

TEST(ToolShape, HasTheBurrsRadiusAndAShankTowardsPlusZ) {
    const Triangles tool = burr_and_shank({.diameter_mm = 3.0, .edges = 6, .clockwise = true});
    float lowest = 0.0f, highest = 0.0f, widest_of_burr = 0.0f;
    for (const Vertex& vertex : tool.vertices) {
        lowest = std::min(lowest, vertex.position.z);
        highest = std::max(highest, vertex.position.z);
        if (vertex.position.z < 0.0f) widest_of_burr = std::max(widest_of_burr, glm::length(vertex.position));
    }
    EXPECT_NEAR(lowest, -1.5f, 1e-5f);
    EXPECT_NEAR(widest_of_burr, 1.5f, 1e-5f);
    EXPECT_GT(highest, 15.0f);
}

TEST(ToolShape, HasTheOutlineOfAHeadThatIsNoBall) {
    const Triangles tool =
        burr_and_shank({.diameter_mm = 2.0, .head = usual_head(HeadShape::cylinder, 2.0, 5.0), .edges = 8});
    float lowest = 0.0f, widest = 0.0f;
    for (const Vertex& vertex : tool.vertices) {
        lowest = std::min(lowest, vertex.position.z);
        if (vertex.position.z < 3.9f) widest = std::max(widest, glm::length(glm::vec2(vertex.position)));
    }
    EXPECT_NEAR(lowest, -1.0f, 1e-5f);
    EXPECT_NEAR(widest, 1.0f, 1e-3f);
}

TEST(ToolShape, TurnsEveryTriangleOutwards) {
    const Triangles sphere = unit_sphere({1.0f, 1.0f, 1.0f});
    for (std::size_t first = 0; first < sphere.indices.size(); first += 3) {
        const glm::vec3 a = sphere.vertices[sphere.indices[first]].position;
        const glm::vec3 b = sphere.vertices[sphere.indices[first + 1]].position;
        const glm::vec3 c = sphere.vertices[sphere.indices[first + 2]].position;
        EXPECT_GE(glm::dot(glm::cross(b - a, c - a), a + b + c), -1e-6f);
    }
}

}  // namespace
}  // namespace osteomill::tool_shape_test
