#include "render_client/ui/panels/panel_painter.h"

#include <algorithm>

namespace osteomill {

namespace {

glm::vec2 wrapped_size(const std::string& text, float wrap_width, float font_factor = 1.0f) {
    const ImVec2 size =
        ImGui::GetFont()->CalcTextSizeA(font_factor * ImGui::GetFontSize(), 1e6f, wrap_width, text.c_str());
    return {size.x, size.y};
}

/// Only a line of one piece is ever wrapped; the others are short.
glm::vec2 size_of_line(const TextLine& line, float widest, float font_factor) {
    if (line.size() == 1) return wrapped_size(line.front().text, widest, font_factor);
    glm::vec2 size(0.0f, font_factor * ImGui::GetFontSize());
    for (const TextPiece& piece : line) size.x += wrapped_size(piece.text, 0.0f, font_factor).x;
    return size;
}

}  // namespace

// Drawn behind the windows that take input, so that these can be opened over it.
PanelPainter::PanelPainter(const Theme& theme, float scale)
    : theme_(theme), scale_(scale), canvas_(*ImGui::GetBackgroundDrawList()) {}

float PanelPainter::line_height() const {
    return 1.2f * ImGui::GetFontSize();
}

float PanelPainter::width_of(const std::string& text) const {
    return wrapped_size(text, 0.0f).x;
}

glm::vec2 PanelPainter::size_of(const PanelText& text, float widest, float font_factor) const {
    glm::vec2 size(0.0f);
    const float gap = line_height() - ImGui::GetFontSize();
    for (const TextLine& line : text) {
        const glm::vec2 line_size = size_of_line(line, widest - 2.0f * padding(), font_factor);
        size.x = std::max(size.x, line_size.x);
        size.y += line_size.y + gap;
    }
    return glm::ceil(size + glm::vec2(2.0f * padding(), 2.0f * padding() - gap));
}

void PanelPainter::draw(const PanelText& text, const PanelPlace& place, float font_factor) const {
    draw_background(place);
    const float gap = line_height() - ImGui::GetFontSize();
    const float widest = place.size.x - 2.0f * padding();
    glm::vec2 pen = place.first + padding();
    for (const TextLine& line : text) {
        float right = pen.x;
        for (const TextPiece& piece : line) {
            draw_text({right, pen.y}, theme_[piece.tone], piece.text, font_factor,
                      line.size() == 1 ? widest + 1.0f : 0.0f);
            right += font_factor * width_of(piece.text);
        }
        pen.y += size_of_line(line, widest + 1.0f, font_factor).y + gap;
    }
}

void PanelPainter::draw_background(const PanelPlace& place) const {
    // A command of its own for each panel: the space between them need not be drawn again, see
    // ImguiContext::end.
    canvas_.AddDrawCmd();
    canvas_.AddRectFilled(to_imgui(place.first), to_imgui(place.first + place.size), colour_of(theme_.panel),
                          4.0f * scale_);
}

void PanelPainter::draw_text(const glm::vec2& place, const Rgba& colour, const std::string& text,
                             float font_factor, float wrap_width) const {
    canvas_.AddText(ImGui::GetFont(), font_factor * ImGui::GetFontSize(), to_imgui(place), colour_of(colour),
                    text.c_str(), text.c_str() + text.size(), wrap_width);
}

void PanelPainter::draw_on_picture(const glm::vec2& place, const std::string& text) const {
    canvas_.AddDrawCmd();
    const glm::vec2 margin(3.0f * scale_, 1.0f * scale_);
    const glm::vec2 size(width_of(text), ImGui::GetFontSize());
    canvas_.AddRectFilled(to_imgui(place - margin), to_imgui(place + size + margin),
                          colour_of(theme_.behind_letter), 3.0f * scale_);
    draw_text(place, theme_.on_picture, text);
}

}  // namespace osteomill
