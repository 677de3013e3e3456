#include "render_client/volume/gl/full_screen.h"

namespace osteomill::gl {

void FullScreen::draw() const {
    glBindVertexArray(array_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

}  // namespace osteomill::gl
