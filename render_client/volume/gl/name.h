// OpenGL's name of an object on the graphics card, made and deleted once: a move-only value, so that classes
// built of names are move-only, too. Needs the OpenGL context in which it was made to be current.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace osteomill::gl {

template <auto& generate, auto& remove>
class Name {
  public:
    Name() { generate(1, &id_); }
    Name(Name&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Name& operator=(Name&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Name() {
        if (id_ != 0) remove(1, &id_);
    }
    operator GLuint() const { return id_; }

  private:
    GLuint id_ = 0;
};

using TextureName = Name<glGenTextures, glDeleteTextures>;
using BufferName = Name<glGenBuffers, glDeleteBuffers>;
using VertexArrayName = Name<glGenVertexArrays, glDeleteVertexArrays>;
using FramebufferName = Name<glGenFramebuffers, glDeleteFramebuffers>;
using RenderbufferName = Name<glGenRenderbuffers, glDeleteRenderbuffers>;
using QueryName = Name<glGenQueries, glDeleteQueries>;

}  // namespace osteomill::gl
