#include "render_client/ui/panels/transfer_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/words/translation.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/panels/widget_panel.h"
#include "render_client/ui/view/hu_axis.h"

namespace osteomill {

namespace {

constexpr float field_height = 7.0f;  // in letters
constexpr double point_reach_px = 10.0;

/// The field of points: from its pixels to values and back.
class Field {
  public:
    Field(const glm::vec2& first, const glm::vec2& size) : first_(first), size_(size) {}

    glm::vec2 pixel_of_hu(double hu, double opacity) const {
        return first_ +
               size_ * glm::vec2(static_cast<float>(hu / highest_hu()), static_cast<float>(1.0 - opacity));
    }
    glm::vec2 pixel_of(double value, double opacity) const {
        return pixel_of_hu(std::min(hu_at_stiffness(value), highest_hu()), opacity);
    }
    double hu_at(float x) const { return highest_hu() * static_cast<double>((x - first_.x) / size_.x); }
    double value_at(float x) const { return stiffness_at_hu(hu_at(x)); }
    double opacity_at(float y) const { return 1.0 - static_cast<double>((y - first_.y) / size_.y); }
    /// How far apart in value two pixels are at x; above zero also if the relation is flat.
    double value_reach(float x, double px) const {
        const auto half = static_cast<float>(px);
        return std::max(0.5 * (value_at(x + half) - value_at(x - half)), 0.02);
    }
    double opacity_of_px(double px) const { return px / static_cast<double>(size_.y); }
    static double highest_hu() {
        static const double highest = hu_at_stiffness(TransferEditor::highest_value);
        return highest;
    }
    const glm::vec2& first() const { return first_; }
    const glm::vec2& size() const { return size_; }

  private:
    glm::vec2 first_;
    glm::vec2 size_;
};

ImU32 display_colour(const glm::vec4& linear) {
    const auto part = [](float value) {
        return std::pow(std::min(std::max(value, 0.0f), 1.0f), 1.0f / 2.2f);
    };
    return ImGui::ColorConvertFloat4ToU32({part(linear.r), part(linear.g), part(linear.b), 1.0f});
}

void draw_field(const PanelPainter& painter, const TransferEditor& editor, const Field& field) {
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    const TransferFunction& function = *editor.function();
    constexpr int strips = 60;
    for (int strip = 0; strip < strips; ++strip) {
        const double low = Field::highest_hu() * strip / strips;
        const double high = Field::highest_hu() * (strip + 1) / strips;
        const glm::vec4 look = look_of(function, stiffness_at_hu(0.5 * (low + high)));
        canvas.AddRectFilled(to_imgui(field.pixel_of_hu(low, static_cast<double>(look.a))),
                             to_imgui(field.pixel_of_hu(high, 0.0)), display_colour(look));
    }
    canvas.AddRect(to_imgui(field.first()), to_imgui(field.first() + field.size()),
                   colour_of(painter.theme().grid));
    std::vector<ImVec2> line{to_imgui(field.pixel_of(0.0, function.points.front().opacity))};
    for (const TransferPoint& point : function.points)
        line.push_back(to_imgui(field.pixel_of(point.value, point.opacity)));
    line.push_back(to_imgui(field.pixel_of(TransferEditor::highest_value, function.points.back().opacity)));
    canvas.AddPolyline(line.data(), static_cast<int>(line.size()), colour_of(painter.theme()[Tone::plain]),
                       ImDrawFlags_None, painter.scale());
    for (std::size_t i = 0; i < function.points.size(); ++i) {
        const ImVec2 place = to_imgui(field.pixel_of(function.points[i].value, function.points[i].opacity));
        const auto [red, green, blue] = function.points[i].srgb;
        canvas.AddCircleFilled(place, 5.0f * painter.scale(), IM_COL32(red, green, blue, 255));
        canvas.AddCircle(place, 5.0f * painter.scale(),
                         colour_of(painter.theme()[editor.selected() == i ? Tone::left : Tone::plain]), 0,
                         (editor.selected() == i ? 3.0f : 1.0f) * painter.scale());
    }
}

/// Numbers at ticks: CT numbers below, opacity on the left.
void draw_axes(const PanelPainter& painter, const Field& field) {
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    const ImU32 ink = colour_of(painter.theme()[Tone::dim]);
    const float letter = small_print * ImGui::GetFontSize();
    const float tick = 3.0f * painter.scale();
    const auto write = [&](const glm::vec2& middle_or_end, float part, const std::string& text) {
        const float width = small_print * painter.width_of(text);
        canvas.AddText(ImGui::GetFont(), letter, {middle_or_end.x - part * width, middle_or_end.y}, ink,
                       text.c_str());
    };
    // Ticks are as far apart as their numbers need.
    const float room = field.size().x / (1.4f * small_print * painter.width_of("2000"));
    const double step_hu = room * 500.0f > static_cast<float>(Field::highest_hu()) ? 500.0 : 1000.0;
    for (double hu = 0.0; hu <= Field::highest_hu(); hu += step_hu) {
        const glm::vec2 at = field.pixel_of_hu(hu, 0.0);
        canvas.AddLine(to_imgui(at), {at.x, at.y + tick}, ink, painter.scale());
        const std::string text = fmt::format("{:.0f}", hu);
        // The unit stands at the end.
        if (at.x + 0.5f * small_print * painter.width_of(text) >
            field.first().x + field.size().x - painter.width_of("HU"))
            continue;
        write({at.x, at.y + tick}, hu == 0.0 ? 0.0f : 0.5f, text);
    }
    write(field.first() + field.size() + glm::vec2(0.0f, tick), 1.0f, "HU");
    for (const double opacity : {0.0, 0.5, 1.0}) {
        const glm::vec2 at = field.pixel_of_hu(0.0, opacity);
        canvas.AddLine({at.x - tick, at.y}, to_imgui(at), ink, painter.scale());
        write({at.x - 1.5f * tick,
               std::clamp(at.y - 0.5f * letter, field.first().y, field.first().y + field.size().y - letter)},
              1.0f, spoken_number("{:g}", opacity));
    }
}

/// A point is taken hold of, moved, or with a double click made.
void edit_field(const PanelPainter& painter, TransferEditor& editor, const Field& field) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double value = field.value_at(mouse.x), opacity = field.opacity_at(mouse.y);
    const double reach_px = point_reach_px * static_cast<double>(painter.scale());
    if (ImGui::IsItemActivated())
        editor.select_near(value, opacity, field.value_reach(mouse.x, reach_px),
                           field.opacity_of_px(reach_px));
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !editor.selected())
        editor.add(value);
    else if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left))
        editor.move(value, opacity);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
        ImGui::SetTooltip("%s", trf("{:.0f} HU, stiffness {:.2f}, opacity {:.2f}",
                                    std::clamp(field.hu_at(mouse.x), 0.0, Field::highest_hu()), value,
                                    std::clamp(opacity, 0.0, 1.0))
                                    .c_str());
}

void draw_presets(TransferEditor& editor, float width_of_others) {
    const std::string current = editor.function() ? editor.function()->name : tr("own colours");
    ImGui::SetNextItemWidth(-1.0f - width_of_others);
    if (!ImGui::BeginCombo("##preset", current.c_str())) return;
    if (ImGui::Selectable(tr("own colours"), !editor.function())) editor.choose(std::nullopt);
    for (const TransferFunction& preset : transfer_presets())
        if (ImGui::Selectable(preset.name.c_str(), current == preset.name)) editor.choose(preset);
    ImGui::EndCombo();
}

void draw_point_controls(TransferEditor& editor) {
    ImGui::BeginDisabled(!editor.selected());
    std::array<float, 3> colour{};
    if (editor.selected())
        for (std::size_t i = 0; i < 3; ++i)
            colour[i] = static_cast<float>(editor.function()->points[*editor.selected()].srgb[i]) / 255.0f;
    if (ImGui::ColorEdit3(tr("colour"), colour.data(), ImGuiColorEditFlags_NoInputs)) {
        std::array<std::uint8_t, 3> srgb{};
        for (std::size_t i = 0; i < 3; ++i)
            srgb[i] = static_cast<std::uint8_t>(std::lround(255.0f * colour[i]));
        editor.set_colour(srgb);
    }
    ImGui::SameLine();
    if (ImGui::Button(tr("remove"))) editor.remove();
    ImGui::EndDisabled();
    ImGui::SameLine();
    bool is_translucent = editor.function()->mode == TransferMode::translucent;
    if (ImGui::Checkbox(tr("see through"), &is_translucent))
        editor.set_mode(is_translucent ? TransferMode::translucent : TransferMode::surface);
}

}  // namespace

glm::vec2 transfer_panel_size(const PanelPainter& painter) {
    const float letter = ImGui::GetFontSize();
    return {21.0f * letter, 3.0f * ImGui::GetFrameHeightWithSpacing() + field_height * letter +
                                2.0f * painter.line_height() + 3.0f * ImGui::GetStyle().ItemSpacing.y +
                                2.0f * ImGui::GetStyle().WindowPadding.y + letter};
}

void draw_transfer_panel(const PanelPainter& painter, ViewSettings& view, const PanelPlace& place) {
    const WidgetPanel window("transfer", place, WidgetPanel::Background::filled,
                             place.choice == 0 ? WidgetPanel::Size::whole : WidgetPanel::Size::scrolls);
    TransferEditor& editor = view.transfer;
    const float letter = ImGui::GetFontSize();
    const float save_width = 5.5f * letter;
    draw_presets(editor, view.transfer_has_file ? save_width + ImGui::GetStyle().ItemSpacing.x : 0.0f);
    if (view.transfer_has_file) {
        ImGui::SameLine();
        if (ImGui::Button(tr("save"), {save_width, 0.0f})) view.transfer_save_wanted = true;
    }
    ImGui::SetNextItemWidth(-3.0f * letter);
    ImGui::SliderFloat(tr("wet"), &view.specular, 0.0f, 1.0f, spoken_number("{:.2f}", view.specular).c_str(),
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat);
    if (!editor.function()) {
        ImGui::TextDisabled("%s",
                            tr("tissues, or stiffness, in their own\ncolours; choose a preset to edit it"));
        return;
    }
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float opacity_width = 2.0f * letter;
    const Field field(
        {corner.x + opacity_width, corner.y},
        {std::max(ImGui::GetContentRegionAvail().x - opacity_width, 1.0f), field_height * letter});
    ImGui::SetCursorScreenPos(to_imgui(field.first()));
    ImGui::InvisibleButton("field", to_imgui(field.size()));
    edit_field(painter, editor, field);
    draw_field(painter, editor, field);
    draw_axes(painter, field);
    ImGui::Dummy({1.0f, letter});
    draw_point_controls(editor);
    ImGui::TextDisabled("%s", tr("opacity upwards; HU by the usual relation"));
    ImGui::TextDisabled("%s",
                        trf("double click: new point; {} closes", key_of(Action::transfer_panel)).c_str());
}

}  // namespace osteomill
