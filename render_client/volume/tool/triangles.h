// Triangles in memory, from which a mesh on the graphics card is made.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace osteomill {

struct Vertex {
    glm::vec3 position{0.0f};  ///< mm, in the frame of the thing that is drawn
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    glm::vec3 colour{1.0f};  ///< linear RGB
};

struct Triangles {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise seen from outside
};

}  // namespace osteomill
