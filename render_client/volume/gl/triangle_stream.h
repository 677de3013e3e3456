// Triangles that are other ones in every frame: positions only, a move-only value.
#pragma once

#include <epoxy/gl.h>

#include <glm/vec3.hpp>
#include <span>

namespace osteomill::gl {

class TriangleStream {
  public:
    TriangleStream();
    TriangleStream(TriangleStream&& other) noexcept;
    TriangleStream& operator=(TriangleStream&& other) noexcept;
    ~TriangleStream();

    /// Replaces all of them; three corners each, attribute 0.
    void upload(std::span<const glm::vec3> corners);
    /// Draws them in their order.
    void draw() const;

  private:
    GLuint array_ = 0;
    GLuint buffer_ = 0;
    GLsizei corner_count_ = 0;
};

}  // namespace osteomill::gl
