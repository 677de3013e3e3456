#include "render_client/volume/gl/full_screen.h"

#include <utility>

namespace osteomill::gl {

FullScreen::FullScreen() {
    glGenVertexArrays(1, &array_);
}

FullScreen::FullScreen(FullScreen&& other) noexcept : array_(std::exchange(other.array_, 0)) {}

FullScreen& FullScreen::operator=(FullScreen&& other) noexcept {
    std::swap(array_, other.array_);
    return *this;
}

FullScreen::~FullScreen() {
    if (array_ != 0) glDeleteVertexArrays(1, &array_);
}

void FullScreen::draw() const {
    glBindVertexArray(array_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

}  // namespace osteomill::gl
