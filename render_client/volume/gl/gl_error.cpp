#include "render_client/volume/gl/gl_error.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <stdexcept>

namespace osteomill::gl {

namespace {

const char* name_of(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "invalid enum";
        case GL_INVALID_VALUE:
            return "invalid value";
        case GL_INVALID_OPERATION:
            return "invalid operation";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "invalid framebuffer operation";
        case GL_OUT_OF_MEMORY:
            return "out of memory";
        default:
            return "unknown error";
    }
}

}  // namespace

void require_no_gl_error(const std::string& doing) {
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR) return;
    // A lost context reports an error for ever; a handful is enough to clear every flag of a live one.
    for (int flag = 0; flag < 8 && glGetError() != GL_NO_ERROR; ++flag) {
    }
    throw std::runtime_error(fmt::format("OpenGL reports {} while {}", name_of(first), doing));
}

}  // namespace osteomill::gl
