#include "render_client/ui/panels/slices_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/words/translation.h"
#include "render_client/ui/input/window_input.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

/// Arrangement of the slices: three in a row over the settings, or two over one, which has the settings
/// beside it.
struct Arrangement {
    float edge;  ///< of a slice's picture, in heights of a letter
    bool is_square = false;
};

constexpr std::array<Arrangement, 5> arrangements{{{17.0f}, {13.0f}, {9.0f}, {10.5f, true}, {8.0f, true}}};
constexpr double window_hu_per_px = 8.0;
constexpr float narrowest_window_hu = 50.0f;
constexpr float widest_window_hu = 5000.0f;

/// The smallest, too, for a panel that scrolls.
const Arrangement& arrangement_of(std::size_t choice) {
    return arrangements[std::min(choice, arrangements.size() - 1)];
}

int edge_px(const Arrangement& arrangement) {
    return static_cast<int>(std::round(arrangement.edge * ImGui::GetFontSize()));
}

const char* name_of(SlicePlane plane) {
    switch (plane) {
        case SlicePlane::axial:
            return tr("axial");
        case SlicePlane::coronal:
            return tr("coronal");
        case SlicePlane::sagittal:
            break;
    }
    return tr("sagittal");
}

/// "L 12.3  P 4.0  S 56.7": which side of the origin, for people.
std::string lps_text(const glm::dvec3& position_mm) {
    const auto axis = [](double value, char positive, char negative) {
        return spoken_number("{} {:.1f}", value < 0.0 ? negative : positive, std::abs(value));
    };
    return fmt::format("{}  {}  {} mm", axis(position_mm.x, 'L', 'R'), axis(position_mm.y, 'P', 'A'),
                       axis(position_mm.z, 'S', 'I'));
}

void draw_marks(const glm::dvec3& cross_mm, const SeenSession& session, const SliceView& view,
                const ImVec2& first) {
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    const auto edge = static_cast<float>(view.edge_px);
    const ImU32 cross = IM_COL32(90, 200, 255, 160);
    const glm::vec2 middle(view.pixel(cross_mm));
    canvas.PushClipRect(first, {first.x + edge, first.y + edge}, true);
    canvas.AddLine({first.x, first.y + middle.y}, {first.x + edge, first.y + middle.y}, cross);
    canvas.AddLine({first.x + middle.x, first.y}, {first.x + middle.x, first.y + edge}, cross);
    if (const Burr* in_tool = session.burr_in_tool()) {
        const double radius_mm = in_tool->radius_mm();
        const double away_mm = glm::dot(session.tool->burr_position_mm - view.centre_mm, view.across());
        const glm::vec2 burr(view.pixel(session.tool->burr_position_mm));
        const ImU32 ink = IM_COL32(120, 255, 140, 255);
        if (std::abs(away_mm) < radius_mm)
            canvas.AddCircle(
                {first.x + burr.x, first.y + burr.y},
                static_cast<float>(std::sqrt(radius_mm * radius_mm - away_mm * away_mm) / view.mm_per_px),
                ink, 0, 1.5f);
        const glm::dvec3 up_mm = session.tool->burr_position_mm + 10.0 * session.tool->spindle_axis;
        const glm::vec2 up(view.pixel(up_mm));
        canvas.AddLine({first.x + burr.x, first.y + burr.y}, {first.x + up.x, first.y + up.y}, ink);
    }
    const std::array<char, 4> letters = edge_letters(view.plane);
    const float letter = ImGui::GetFontSize();
    const std::array<ImVec2, 4> places{
        ImVec2{2.0f, 0.5f * (edge - letter)}, ImVec2{edge - letter, 0.5f * (edge - letter)},
        ImVec2{0.5f * (edge - letter), 1.0f}, ImVec2{0.5f * (edge - letter), edge - letter - 2.0f}};
    for (std::size_t i = 0; i < 4; ++i)
        canvas.AddText({first.x + places[i].x, first.y + places[i].y}, IM_COL32(255, 230, 120, 255),
                       &letters[i], &letters[i] + 1);
    canvas.AddText({first.x + 4.0f, first.y + 2.0f}, IM_COL32(200, 200, 200, 255), name_of(view.plane));
    canvas.PopClipRect();
}

/// Left: the cross-hair; right: window and level; the wheel goes through the slices, with ctrl it zooms.
void take_mouse(SlicesView& slices, const SliceView& view, const ImVec2& first) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActive() && io.MouseDown[ImGuiMouseButton_Left])
        slices.cross_at(view.position_mm({io.MousePos.x - first.x, io.MousePos.y - first.y}));
    if (!ImGui::IsItemHovered()) return;
    if (io.MouseDown[ImGuiMouseButton_Right]) {
        HuWindow& window = slices.window();
        window.window_hu = glm::clamp(window.window_hu + window_hu_per_px * io.MouseDelta.x,
                                      double{narrowest_window_hu}, double{widest_window_hu});
        window.level_hu = glm::clamp(window.level_hu - window_hu_per_px * io.MouseDelta.y, -1000.0, 3000.0);
    }
    if (io.MouseWheel == 0.0f) return;
    if (io.KeyCtrl)
        slices.zoom(std::pow(zoom_per_notch, io.MouseWheel));
    else
        slices.cross_at(*slices.cross_mm() -
                        static_cast<double>(io.MouseWheel) * slices.ct()->grid.spacing_mm * view.across());
}

void draw_hu_window(SlicesView& slices, float width_px, bool is_in_a_row) {
    auto level = static_cast<float>(slices.window().level_hu);
    auto width = static_cast<float>(slices.window().window_hu);
    ImGui::SetNextItemWidth(width_px);
    if (ImGui::SliderFloat("##level", &level, -1000.0f, 3000.0f, trf("level {:.0f} HU", level).c_str(),
                           ImGuiSliderFlags_NoInput))
        slices.window().level_hu = level;
    if (is_in_a_row) ImGui::SameLine();
    ImGui::SetNextItemWidth(width_px);
    if (ImGui::SliderFloat("##window", &width, narrowest_window_hu, widest_window_hu,
                           trf("window {:.0f} HU", width).c_str(), ImGuiSliderFlags_NoInput))
        slices.window().window_hu = width;
}

/// Beside the button, which is to be seen whole.
float slider_width() {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float button = ImGui::CalcTextSize(tr("Place the tool here")).x + 2.0f * style.FramePadding.x;
    const float room = ImGui::GetContentRegionAvail().x - button - 2.0f * style.ItemSpacing.x;
    return std::min(0.5f * room, 10.0f * ImGui::GetFontSize());
}

void draw_place_button(SlicesView& slices, const SeenSession& session, SessionRequests* requests) {
    const bool may = requests != nullptr && session.link.controls.may_control && session.tool;
    ImGui::BeginDisabled(!may);
    if (ImGui::Button(tr("Place the tool here")) && may)
        requests->controls.push_back({.action = SessionAction::place,
                                      .text = {},
                                      .pose = {*slices.cross_mm(), session.tool->spindle_axis}});
    ImGui::EndDisabled();
}

}  // namespace

std::vector<glm::vec2> slices_panel_sizes(const PanelPainter&) {
    const ImGuiStyle& style = ImGui::GetStyle();
    std::vector<glm::vec2> sizes;
    for (const Arrangement& arrangement : arrangements) {
        const auto edge = static_cast<float>(edge_px(arrangement));
        const glm::vec2 pictures = arrangement.is_square ? glm::vec2(2.0f, 2.0f) : glm::vec2(3.0f, 1.0f);
        const glm::vec2 between(style.ItemSpacing.x, style.ItemSpacing.y);
        sizes.push_back(pictures * edge + (pictures - 1.0f) * between +
                        glm::vec2(0.0f, 2.0f * ImGui::GetFrameHeightWithSpacing() + between.y) +
                        2.0f * glm::vec2(style.WindowPadding.x, style.WindowPadding.y));
    }
    return sizes;
}

void draw_slices_panel(SlicesView& slices, const SeenSession& session, const SlicedBone& bone,
                       const PanelPlace& place, SessionRequests* requests) {
    const WidgetPanel window(
        "slices", place, WidgetPanel::Background::filled,
        place.choice < arrangements.size() ? WidgetPanel::Size::whole : WidgetPanel::Size::scrolls);
    if (slices.ct() == nullptr) {
        const bool has_ct = !session.is_recording && session.info != nullptr && session.info->has_ct;
        ImGui::TextWrapped("%s", has_ct ? tr("the CT is on its way")
                                        : tr("there is no CT to show: a recording, or a bone without one"));
        return;
    }
    const Arrangement& arrangement = arrangement_of(place.choice);
    const int edge = edge_px(arrangement);
    for (const SlicePlane plane : SlicesView::planes) {
        const bool begins_row = plane == SlicesView::planes.front() ||
                                (arrangement.is_square && plane == SlicesView::planes.back());
        if (!begins_row) ImGui::SameLine();
        const SliceView view = slices.view(plane, edge);
        const ImVec2 first = ImGui::GetCursorScreenPos();
        const GLuint id = slices.picture(plane, edge, bone.bone, bone.version).id();
        ImGui::GetWindowDrawList()->AddImage(
            texture_of(id), first, {first.x + static_cast<float>(edge), first.y + static_cast<float>(edge)});
        ImGui::InvisibleButton(name_of(plane), {static_cast<float>(edge), static_cast<float>(edge)});
        draw_marks(*slices.cross_mm(), session, view, first);
        take_mouse(slices, view, first);
    }
    if (arrangement.is_square) {
        ImGui::SameLine();
        ImGui::BeginGroup();
        draw_hu_window(slices, static_cast<float>(edge), false);
        ImGui::EndGroup();
    }
    ImGui::TextUnformatted(
        fmt::format("{}   {:.0f} HU", lps_text(*slices.cross_mm()), slices.ct()->hu_at(*slices.cross_mm()))
            .c_str());
    if (!arrangement.is_square) {
        draw_hu_window(slices, slider_width(), true);
        ImGui::SameLine();
    }
    draw_place_button(slices, session, requests);
}

void draw_slices_cross(const SlicesView& slices, const Camera& camera, const PanelPainter& painter,
                       const glm::ivec2& size_px) {
    if (!slices.cross_mm()) return;
    const glm::dvec3 at_mm = *slices.cross_mm();
    if (!camera.has_in_front(at_mm)) return;
    const glm::vec2 at(pixel_of(camera, at_mm, size_px));
    const float arm = 10.0f * painter.scale();
    const ImU32 ink = IM_COL32(90, 200, 255, 255);
    painter.canvas().AddLine({at.x - arm, at.y}, {at.x + arm, at.y}, ink, 1.5f);
    painter.canvas().AddLine({at.x, at.y - arm}, {at.x, at.y + arm}, ink, 1.5f);
}

}  // namespace osteomill
