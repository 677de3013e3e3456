// A linked shader program: a move-only value.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "render_client/volume/gl/name.h"

namespace osteomill::gl {

class Program {
  public:
    /// Compiles and links GLSL 3.30. Throws std::runtime_error with the compiler's log.
    Program(const std::string& vertex_source, const std::string& fragment_source);

    /// glUseProgram; the setters below need it.
    void use() const;
    /// Draws one triangle over the whole viewport: without attributes, the vertex shader makes its corners of
    /// gl_VertexID. Needs use().
    void fill_picture() const;
    /// Draws triangles without attributes likewise. Needs use().
    void draw_triangles(int count) const;
    /// glUniform*. A name that the linker removed as unused is ignored, as OpenGL does.
    void set(const char* name, int value) const;
    void set(const char* name, float value) const;
    void set(const char* name, const glm::vec2& value) const;
    void set(const char* name, const glm::vec3& value) const;
    void set(const char* name, const glm::vec4& value) const;
    void set(const char* name, const glm::mat3& value) const;
    void set(const char* name, const glm::mat4& value) const;

  private:
    static void create(GLsizei, GLuint* id) { *id = glCreateProgram(); }
    static void remove(GLsizei, const GLuint* id) {
        // NVIDIA's driver reuses the name of a program that is current: the next program of that name would
        // draw with its uniforms.
        glUseProgram(0);
        glDeleteProgram(*id);
    }

    Name<create, remove> id_;
    VertexArrayName no_attributes_;
};

}  // namespace osteomill::gl
