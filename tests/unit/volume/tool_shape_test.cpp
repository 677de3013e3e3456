#include "render_client/volume/tool/tool_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

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

TEST(ToolShape, HasTheShankOfTheBurrsProfile) {
    const BurrShape burr{
        .diameter_mm = 2.0,
        .shank = {{1.0, 0.4}, {6.0, 0.4}, {8.0, 1.2}, {30.0, 1.2}, {31.0, 6.0}, {80.0, 8.0}}};
    float highest = 0.0f;
    for (const Vertex& vertex : burr_shank(burr).vertices) {
        const float z = vertex.position.z;
        const float radius = glm::length(glm::vec2(vertex.position));
        if (radius > 0.0f) {
            EXPECT_NEAR(radius, z <= 6.0f ? 0.4f : 1.2f, 1e-5f) << z;
        }
        highest = std::max(highest, z);
    }
    EXPECT_NEAR(highest, 30.0f, 1e-5f) << "from there on it is the handpiece";
    float begins = 1e6f;
    for (const Vertex& vertex : handpiece(burr).vertices) begins = std::min(begins, vertex.position.z);
    EXPECT_NEAR(begins, 29.5f, 1e-4f);
}

/// Brightness of each vertex.
std::vector<float> shades(const Triangles& triangles) {
    std::vector<float> values;
    for (const Vertex& vertex : triangles.vertices) values.push_back(vertex.colour.g);
    return values;
}

struct Spread {
    double mean = 0.0, deviation = 0.0;
};

Spread spread_of(const std::vector<float>& values) {
    Spread spread;
    const auto count = static_cast<double>(values.size());
    for (const float value : values) spread.mean += value / count;
    for (const float value : values) spread.deviation += std::pow(value - spread.mean, 2.0) / count;
    spread.deviation = std::sqrt(spread.deviation);
    return spread;
}

TEST(ToolShape, BlursFlutesAndMarksAtSpeedWithinTheSweptOutline) {
    for (const BurrHead& shape : {BurrHead{}, usual_head(HeadShape::cylinder, 3.0, 5.0)}) {
        const BurrShape burr{.diameter_mm = 3.0, .head = shape, .edges = 8};
        const Triangles still = burr_head(burr);
        const Triangles turning = burr_head(burr, BurrMotion::at_speed);
        ASSERT_EQ(turning.vertices.size(), still.vertices.size());
        // A vertex of the turning head is as far from the axis as the lands at its height.
        for (std::size_t i = 0; i < still.vertices.size(); ++i) {
            const auto from_axis = [](const Vertex& vertex) {
                return glm::length(glm::vec2(vertex.position));
            };
            EXPECT_GE(from_axis(turning.vertices[i]), from_axis(still.vertices[i]) - 1e-5f) << i;
            EXPECT_LE(glm::length(glm::vec2(turning.vertices[i].position)), 1.5f + 1e-5f) << i;
        }
        EXPECT_NEAR(spread_of(shades(turning)).mean, spread_of(shades(still)).mean, 0.01);
    }
    const Spread still = spread_of(shades(burr_shank({})));
    const Spread turning = spread_of(shades(burr_shank({}, BurrMotion::at_speed)));
    EXPECT_NEAR(turning.mean, still.mean, 0.02) << "but for marks that end between two columns";
    EXPECT_NEAR(turning.deviation, 0.2 * still.deviation, 0.01) << "which way it turns is still seen";
}

TEST(ToolShape, HasAHandpieceThatBeginsInTheEndOfTheShank) {
    for (const double diameter_mm : {1.0, 5.0}) {
        const BurrShape burr{.diameter_mm = diameter_mm};
        float shank_ends = 0.0f;
        for (const Vertex& vertex : burr_shank(burr).vertices)
            shank_ends = std::max(shank_ends, vertex.position.z);
        float begins = 1e6f, ends = 0.0f, widest = 0.0f;
        for (const Vertex& vertex : handpiece(burr).vertices) {
            begins = std::min(begins, vertex.position.z);
            ends = std::max(ends, vertex.position.z);
            widest = std::max(widest, glm::length(glm::vec2(vertex.position)));
        }
        EXPECT_NEAR(begins, shank_ends - 0.5f, 1e-4f);
        EXPECT_GT(ends, shank_ends + 90.0f);
        EXPECT_LE(widest, 9.0f);
    }
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
