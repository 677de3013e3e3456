#include "render_client/volume/gl/triangle_stream.h"

namespace osteomill::gl {

TriangleStream::TriangleStream() {
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
    glBindVertexArray(0);
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
