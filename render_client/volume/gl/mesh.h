// Triangles on the graphics card: a vertex array with its buffers, a move-only value.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "render_client/volume/gl/name.h"
#include "render_client/volume/tool/triangles.h"

namespace osteomill::gl {

class Mesh {
  public:
    /// Attributes: 0 position, 1 normal, 2 colour (linear RGB).
    explicit Mesh(const Triangles& triangles);

    void draw() const;
    /// Opposite corners of the box round all vertices.
    const glm::vec3& low() const { return low_; }
    const glm::vec3& high() const { return high_; }

  private:
    VertexArrayName array_;
    BufferName vertices_;
    BufferName indices_;
    GLsizei index_count_ = 0;
    glm::vec3 low_{0.0f};
    glm::vec3 high_{0.0f};
};

/// Triangles that differ in every frame: positions only, a move-only value.
class TriangleStream {
  public:
    TriangleStream();

    /// Replaces all of them; three corners each, attribute 0.
    void upload(std::span<const glm::vec3> corners);
    /// Draws them in their order.
    void draw() const;

  private:
    VertexArrayName array_;
    BufferName buffer_;
    GLsizei corner_count_ = 0;
};

}  // namespace osteomill::gl
