#include "render_client/volume/gl/mesh.h"

#include <cstddef>
#include <glm/common.hpp>
#include <utility>

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
    glGenVertexArrays(1, &array_);
    glGenBuffers(1, &vertices_);
    glGenBuffers(1, &indices_);
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

Mesh::Mesh(Mesh&& other) noexcept
    : array_(std::exchange(other.array_, 0)),
      vertices_(std::exchange(other.vertices_, 0)),
      indices_(std::exchange(other.indices_, 0)),
      index_count_(other.index_count_),
      low_(other.low_),
      high_(other.high_) {}

Mesh& Mesh::operator=(Mesh&& other) noexcept {
    std::swap(array_, other.array_);
    std::swap(vertices_, other.vertices_);
    std::swap(indices_, other.indices_);
    std::swap(index_count_, other.index_count_);
    std::swap(low_, other.low_);
    std::swap(high_, other.high_);
    return *this;
}

Mesh::~Mesh() {
    if (array_ == 0) return;
    glDeleteVertexArrays(1, &array_);
    glDeleteBuffers(1, &vertices_);
    glDeleteBuffers(1, &indices_);
}

void Mesh::draw() const {
    glBindVertexArray(array_);
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
}

}  // namespace osteomill::gl
