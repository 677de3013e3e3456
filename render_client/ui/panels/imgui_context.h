// Dear ImGui's context and its OpenGL 3 back end, as one RAII value. Needs a current OpenGL context. All
// lengths are pixels of the picture, also if a window counts in larger units.
//
// Takes the window's input as data instead of through Dear ImGui's own back end for GLFW, which reads it
// while drawing: another thread does the reading, see hand_input.h.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render_client/ui/input/clipboard.h"
#include "render_client/ui/input/window_input.h"
#include "render_client/ui/panels/imgui_input.h"
#include "render_client/ui/panels/theme.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/gl/framebuffer.h"

namespace osteomill {

class ImguiContext {
  public:
    ImguiContext();
    ImguiContext(const ImguiContext&) = delete;
    ImguiContext& operator=(const ImguiContext&) = delete;
    ~ImguiContext();

    /// Joins the panels' texts to the desktop's; it must outlive them.
    void use(Clipboard& clipboard);

    /// Mouse and keys for the next frame; whether some wait for one after it (imgui_input.h). Without it, as
    /// in offscreen pictures, panels take no input.
    bool feed(const WindowInput& input, bool holds_text = false);

    /// Opens an ImGui frame, in the colours of `theme` and with letters and controls `scale` times as large
    /// as on an ordinary display. `elapsed_s` is the time since the last one. Panels are laid out in a
    /// picture of `size_px` and drawn into pictures of `drawn_px`, which differ if two eyes share one.
    void begin(const glm::ivec2& size_px, const glm::ivec2& drawn_px, double elapsed_s, ThemeName theme,
               float scale);
    /// Draws the frame's panels into each of these pictures; returns their places in them.
    std::vector<PixelBox> end(std::span<const gl::Framebuffer* const> pictures);

    /// The boxes of the panels that caught the mouse in the last frame, pixels, y down.
    std::vector<PixelBox> input_boxes() const;

    /// Notches that the wheel was turned by in this frame: Dear ImGui forgets them when the frame ends.
    float wheel_notches() const { return wheel_notches_; }

  private:
    void set_style(ThemeName theme, float scale);
    void load_letters(float scale);

    ImguiInput input_;
    ThemeName theme_ = ThemeName::dark;
    float scale_ = 0.0f;  // none yet
    float wheel_notches_ = 0.0f;
};

}  // namespace osteomill
