// Dear ImGui's context and its OpenGL 3 back end, as one RAII value. Needs a current OpenGL context.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render_client/volume/pixel_box.h"

struct GLFWwindow;

namespace osteomill {

class Panels {
  public:
    /// Without a window, for offscreen pictures: panels are drawn but take no input.
    Panels();
    /// Takes mouse and keys of this window; installs its callbacks.
    explicit Panels(GLFWwindow* window);
    Panels(const Panels&) = delete;
    Panels& operator=(const Panels&) = delete;
    ~Panels();

    /// Opens an ImGui frame. `elapsed_s` is the time since the last one.
    void begin(const glm::ivec2& size_px, double elapsed_s);
    /// Draws what was put into the frame into the bound framebuffer; returns where that is.
    std::vector<PixelBox> end();

  private:
    void start();
    GLFWwindow* window_ = nullptr;
};

}  // namespace osteomill
