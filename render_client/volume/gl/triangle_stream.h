// Triangles that differ in every frame: positions only, a move-only value.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "render_client/volume/gl/name.h"

namespace osteomill::gl {

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
