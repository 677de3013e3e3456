#include "render_client/volume/gl/program.h"

#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

namespace osteomill::gl {

namespace {

template <auto& read>
std::string log_of(GLuint id) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    read(id, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

class Shader {
  public:
    Shader(GLenum stage, const std::string& source) : id_(glCreateShader(stage)) {
        const char* text = source.c_str();
        glShaderSource(id_, 1, &text, nullptr);
        glCompileShader(id_);
        GLint compiled = 0;
        glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        if (compiled) return;
        const std::string log = log_of<glGetShaderInfoLog>(id_);
        glDeleteShader(id_);
        throw std::runtime_error("the OpenGL driver refused a shader: " + log);
    }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    ~Shader() { glDeleteShader(id_); }
    GLuint id() const { return id_; }

  private:
    GLuint id_;
};

}  // namespace

Program::Program(const std::string& vertex_source, const std::string& fragment_source) {
    const Shader vertex(GL_VERTEX_SHADER, vertex_source);
    const Shader fragment(GL_FRAGMENT_SHADER, fragment_source);
    glAttachShader(id_, vertex.id());
    glAttachShader(id_, fragment.id());
    glLinkProgram(id_);
    GLint linked = 0;
    glGetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (linked) return;
    throw std::runtime_error("the OpenGL driver could not link a shader program: " +
                             log_of<glGetProgramInfoLog>(id_));
}

void Program::use() const {
    glUseProgram(id_);
}
void Program::fill_picture() const {
    draw_triangles(1);
}
void Program::draw_triangles(int count) const {
    glBindVertexArray(no_attributes_);
    glDrawArrays(GL_TRIANGLES, 0, 3 * count);
    glBindVertexArray(0);
}
void Program::set(const char* name, int value) const {
    glUniform1i(glGetUniformLocation(id_, name), value);
}
void Program::set(const char* name, float value) const {
    glUniform1f(glGetUniformLocation(id_, name), value);
}
void Program::set(const char* name, const glm::vec2& value) const {
    glUniform2fv(glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec3& value) const {
    glUniform3fv(glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec4& value) const {
    glUniform4fv(glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat3& value) const {
    glUniformMatrix3fv(glGetUniformLocation(id_, name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(glGetUniformLocation(id_, name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace osteomill::gl
