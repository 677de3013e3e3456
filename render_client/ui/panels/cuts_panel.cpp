#include "render_client/ui/panels/cuts_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

void draw_row(CutSettings& cuts, std::size_t index, const Camera& camera) {
    const std::array<std::string, CutSettings::count> names{
        trf("left/right ({})", key_of(Action::cut_x)), trf("front/back ({})", key_of(Action::cut_y)),
        trf("above/below ({})", key_of(Action::cut_z)),
        trf("across the view ({})", key_of(Action::cut_view))};
    const CutSettings::Cut& cut = cuts[index];
    bool is_on = cut.is_on;
    if (ImGui::Checkbox(names[index].c_str(), &is_on))
        is_on ? cuts.step(index, camera) : cuts.switch_off(index);
    auto position_mm = static_cast<float>(cut.position_mm);
    // One that was never on has no direction yet, and so no reach.
    const float reach_mm = std::max(static_cast<float>(cuts.reach_mm(index)), 0.1f);
    ImGui::BeginDisabled(!cut.is_on);
    const float flip_width = 5.5f * ImGui::GetFontSize();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - flip_width - ImGui::GetStyle().ItemSpacing.x);
    // Not "-0.0 mm".
    const std::string shown = spoken_number("{:.1f} mm", std::abs(position_mm) < 0.05f ? 0.0f : position_mm);
    if (ImGui::SliderFloat("##position", &position_mm, -reach_mm, reach_mm, shown.c_str(),
                           ImGuiSliderFlags_NoInput | ImGuiSliderFlags_NoRoundToFormat))
        cuts.move_to(index, position_mm);
    ImGui::SameLine();
    if (ImGui::Button(tr("turn over"), {flip_width, 0.0f})) cuts.turn_over(index);
    ImGui::EndDisabled();
}

}  // namespace

glm::vec2 cuts_panel_size(const PanelPainter& painter) {
    const float rows = 2.0f * CutSettings::count;
    return {21.0f * ImGui::GetFontSize(), rows * ImGui::GetFrameHeightWithSpacing() +
                                              2.0f * ImGui::GetStyle().WindowPadding.y +
                                              painter.line_height()};
}

void draw_cuts_panel(CutSettings& cuts, const Camera& camera, const PanelPlace& place) {
    const WidgetPanel window("cuts", place, WidgetPanel::Background::filled,
                             place.choice == 0 ? WidgetPanel::Size::whole : WidgetPanel::Size::scrolls);
    for (std::size_t index = 0; index < CutSettings::count; ++index) {
        ImGui::PushID(static_cast<int>(index));
        draw_row(cuts, index, camera);
        ImGui::PopID();
    }
    ImGui::TextDisabled("%s",
                        trf("alt + wheel moves the last; {} closes", key_of(Action::cuts_panel)).c_str());
}

}  // namespace osteomill
