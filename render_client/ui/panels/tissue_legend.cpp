#include "render_client/ui/panels/tissue_legend.h"

#include <algorithm>
#include <glm/common.hpp>

#include "common/words/translation.h"

namespace osteomill {

namespace {

std::string name_of(const Tissue& tissue) {
    const std::string words = tissue_words(tissue.name);
    return tissue.is_protected ? trf("{} (protected)", words) : words;
}

}  // namespace

glm::vec2 legend_size(const PanelPainter& painter, std::span<const Tissue> tissues) {
    glm::vec2 size(0.0f, static_cast<float>(tissues.size()) * painter.line_height());
    for (const Tissue& tissue : tissues) size.x = std::max(size.x, painter.width_of(name_of(tissue)));
    size.x += 1.6f * ImGui::GetFontSize();
    return glm::ceil(size + 2.0f * painter.padding());
}

void draw_legend(const PanelPainter& painter, std::span<const Tissue> tissues, const PanelPlace& place) {
    painter.draw_background(place);
    const float side = ImGui::GetFontSize();
    glm::vec2 pen = place.first + painter.padding();
    for (const Tissue& tissue : tissues) {
        const auto [red, green, blue] = tissue.colour_rgb;
        painter.canvas().AddRectFilled(to_imgui(pen), to_imgui(pen + side), IM_COL32(red, green, blue, 255));
        painter.canvas().AddRect(to_imgui(pen), to_imgui(pen + side), colour_of(painter.theme().grid));
        painter.draw_text({pen.x + 1.6f * side, pen.y}, painter.theme()[Tone::plain], name_of(tissue));
        pen.y += painter.line_height();
    }
}

}  // namespace osteomill
