// A painter of text panels and marks over the picture, with Dear ImGui's draw lists; needs an ImGui frame to
// be open. Lengths are pixels of the picture.
#pragma once

#include <epoxy/gl.h>
#include <imgui.h>

#include <cstdint>

#include "render_client/ui/panels/layout.h"
#include "render_client/ui/panels/panel_text.h"

namespace osteomill {

/// From Debian's fonts-dejavu-core. If it is missing, Dear ImGui's own letters serve: coarser, but there.
inline constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
/// Height of a letter, px of the screen at scale 1.
inline constexpr float letter_px = 14.0f;
/// Numbers at axes, in share of it: smaller than 12 px nobody reads them in a small window.
inline constexpr float small_print = 12.0f / letter_px;

inline ImU32 colour_of(const Rgba& colour) {
    return IM_COL32(colour.r, colour.g, colour.b, colour.a);
}
inline ImVec2 to_imgui(const glm::vec2& point) {
    return {point.x, point.y};
}

/// A texture by OpenGL's name: to Dear ImGui an address before 1.91.4, a number since.
inline ImTextureID texture_of(GLuint name) {
#if IMGUI_VERSION_NUM >= 19140
    return name;
#else
    return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name));
#endif
}

class PanelPainter {
  public:
    PanelPainter(const Theme& theme, float scale);

    const Theme& theme() const { return theme_; }
    float scale() const { return scale_; }
    float line_height() const;
    /// Between a panel's edge and its content.
    float padding() const { return 8.0f * scale_; }
    float width_of(const std::string& text) const;

    /// The panel that holds the text, its lines wrapped to at most `widest`; letters `font_factor` times as
    /// large as usual.
    glm::vec2 size_of(const PanelText& text, float widest, float font_factor = 1.0f) const;
    void draw(const PanelText& text, const PanelPlace& place, float font_factor = 1.0f) const;
    /// A panel with nothing in it.
    void draw_background(const PanelPlace& place) const;
    void draw_text(const glm::vec2& place, const Rgba& colour, const std::string& text,
                   float font_factor = 1.0f, float wrap_width = 0.0f) const;
    /// Letters over the picture, legible on bone and on background.
    void draw_on_picture(const glm::vec2& place, const std::string& text) const;
    ImDrawList& canvas() const { return canvas_; }

  private:
    const Theme& theme_;
    float scale_;
    ImDrawList& canvas_;
};

}  // namespace osteomill
