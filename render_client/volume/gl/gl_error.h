// OpenGL's error flag, as an exception.
#pragma once

#include <string>

namespace osteomill::gl {

/// Throws std::runtime_error naming `doing` and the error if OpenGL has recorded one since the last call
/// (glGetError, all flags). Waits for nothing.
void require_no_gl_error(const std::string& doing);

}  // namespace osteomill::gl
