#include "render_client/volume/gl/mesh.h"

#include <cstddef>
#include <glm/common.hpp>

namespace osteomill::gl {

namespace {

void set_attribute(GLuint index, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          // OpenGL's own way of passing an offset is a pointer.
                          reinterpret_cast<const void*>(offset));
}

}  // namespace

Mesh::Mesh(const Triangles& triangles) : index_count_(static_cast<GLsizei>(triangles.indices.size())) {
    if (!triangles.vertices.empty()) low_ = high_ = triangles.vertices.front().position;
    for (const Vertex& vertex : triangles.vertices) {
        low_ = glm::min(low_, vertex.position);
        high_ = glm::max(high_, vertex.position);
    }
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, vertices_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.vertices.size() * sizeof(Vertex)),
                 triangles.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(triangles.indices.size() * sizeof(std::uint32_t)),
                 triangles.indices.data(), GL_STATIC_DRAW);
    set_attribute(0, offsetof(Vertex, position));
    set_attribute(1, offsetof(Vertex, normal));
    set_attribute(2, offsetof(Vertex, colour));
    glBindVertexArray(0);
}

void Mesh::draw() const {
    glBindVertexArray(array_);
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
}

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
