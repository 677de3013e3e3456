#include "render_client/volume/gl/triangle_stream.h"

#include <utility>

namespace osteomill::gl {

TriangleStream::TriangleStream() {
    glGenVertexArrays(1, &array_);
    glGenBuffers(1, &buffer_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
    glBindVertexArray(0);
}

TriangleStream::TriangleStream(TriangleStream&& other) noexcept
    : array_(std::exchange(other.array_, 0)),
      buffer_(std::exchange(other.buffer_, 0)),
      corner_count_(std::exchange(other.corner_count_, 0)) {}

TriangleStream& TriangleStream::operator=(TriangleStream&& other) noexcept {
    std::swap(array_, other.array_);
    std::swap(buffer_, other.buffer_);
    std::swap(corner_count_, other.corner_count_);
    return *this;
}

TriangleStream::~TriangleStream() {
    if (buffer_ != 0) glDeleteBuffers(1, &buffer_);
    if (array_ != 0) glDeleteVertexArrays(1, &array_);
}

void TriangleStream::upload(std::span<const glm::vec3> corners) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size_bytes()), corners.data(),
                 GL_STREAM_DRAW);
    corner_count_ = static_cast<GLsizei>(corners.size());
}

void TriangleStream::draw() const {
    glBindVertexArray(array_);
    glDrawArrays(GL_TRIANGLES, 0, corner_count_);
    glBindVertexArray(0);
}

}  // namespace osteomill::gl
