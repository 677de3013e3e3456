#include "render_client/ui/overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "render_client/ui/playback_panel.h"

namespace osteomill {

namespace {

// Okabe and Ito's palette: told apart by every kind of colour vision.
constexpr ImU32 orange = IM_COL32(230, 159, 0, 255);
constexpr ImU32 sky_blue = IM_COL32(86, 180, 233, 255);
constexpr ImU32 bluish_green = IM_COL32(0, 190, 140, 255);
constexpr ImU32 vermillion = IM_COL32(240, 105, 30, 255);
constexpr std::array<ImU32, 3> axis_colours{orange, sky_blue, bluish_green};
constexpr std::array<const char*, 3> axis_names{"left", "back", "up"};

constexpr float margin_px = 12.0f;
constexpr ImGuiWindowFlags panel_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                         ImGuiWindowFlags_NoInputs;

/// Opens a panel that hangs at a corner or edge: `anchor` 0 to 1 from the picture's upper left.
void begin_panel(const char* name, const ImVec2& anchor, const glm::ivec2& size_px) {
    const auto place = [](float part, int length) {
        return margin_px + part * (static_cast<float>(length) - 2.0f * margin_px);
    };
    ImGui::SetNextWindowPos({place(anchor.x, size_px.x), place(anchor.y, size_px.y)}, ImGuiCond_Always,
                            anchor);
    ImGui::SetNextWindowBgAlpha(0.72f);
    ImGui::Begin(name, nullptr, panel_flags);
}

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

void coloured_text(ImU32 colour, const std::string& line) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    text(line);
    ImGui::PopStyleColor();
}

bool has_problem(LinkStatus status) {
    return status == LinkStatus::connecting || status == LinkStatus::lost || status == LinkStatus::refused;
}

/// As wide whichever it is: the panel must not jump while the view is turned.
std::string quality_in_words(const PictureQuality& quality) {
    if (quality.refined) return "full quality";
    if (quality.scale == 1.0) return "refining    ";
    return fmt::format("coarse {:3.0f} % ", 100.0 * quality.scale);
}

void draw_session_panel(const OverlayContent& content, const glm::ivec2& size_px) {
    // The status may grow from one frame to the next, a panel that fits itself follows a frame later.
    const float status_px = ImGui::CalcTextSize(content.link.status_line.c_str()).x;
    ImGui::SetNextWindowSizeConstraints(
        {status_px + 2.0f * ImGui::GetStyle().WindowPadding.x, 0.0f},
        {std::numeric_limits<float>::max(), std::numeric_limits<float>::max()});
    begin_panel("session", {0.0f, 0.0f}, size_px);
    if (content.session) text("scene   " + content.session->scene_name);
    const std::string status = content.link.status_line;
    if (has_problem(content.link.status))
        coloured_text(vermillion, status);
    else
        text(status);
    text(fmt::format("picture {:5.1f} frames/s, {}", content.render_frames_per_s,
                     quality_in_words(content.quality)));
    text(fmt::format("{} {:5.1f} frames/s {:7.1f} kB/s", content.player ? "file   " : "link   ",
                     content.link.frames_per_s, 1e-3 * content.link.bytes_per_s));
    if (const auto& delay = content.link.delay)
        text(fmt::format("delay   {:5.0f} ms by the clocks, {:.0f} over the least", 1e3 * delay->by_clocks_s,
                         1e3 * delay->over_least_s));
    if (const std::uint64_t bad = content.link.checksum_mismatches + content.link.rejected_frames; bad > 0)
        coloured_text(vermillion, fmt::format("{} bad frames; {} bricks were repaired", bad,
                                              content.link.bricks_repaired));
    if (!content.help_shown) ImGui::TextDisabled("F1 help");
    ImGui::End();
}

void draw_tool_panel(const OverlayContent& content, const glm::ivec2& size_px) {
    const ToolView& tool = *content.tool;
    begin_panel("tool", {1.0f, 0.0f}, size_px);
    if (content.session && tool.burr < content.session->burrs.size()) {
        const Burr& burr = content.session->burrs[tool.burr];
        text(fmt::format("burr    {:.1f} mm, {} edges", burr.diameter_mm, burr.edges));
        const std::string spindle =
            tool.spindle_on ? fmt::format("{:.0f} rpm", 60.0 * burr.spindle_rev_per_s) : "off";
        coloured_text(tool.spindle_on ? bluish_green : IM_COL32(190, 190, 190, 255), "spindle " + spindle);
    }
    text(fmt::format("removed {:.2f} mm3", tool.removed_mm3));
    text(fmt::format("time    {:.1f} s", tool.time_s));
    ImGui::End();
}

/// Three lines through the last seconds; the scale is symmetric and never finer than half a newton.
void plot_forces(const ToolHistory& history, const ImVec2& size) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    double largest_n = 0.5;
    for (const auto& sample : history.samples())
        for (int axis = 0; axis < 3; ++axis) largest_n = std::max(largest_n, std::abs(sample.force_n[axis]));
    const auto height_of = [&](double force_n) {
        return corner.y + size.y * static_cast<float>(0.5 - 0.5 * force_n / largest_n);
    };
    canvas.AddLine({corner.x, height_of(0.0)}, {corner.x + size.x, height_of(0.0)},
                   IM_COL32(150, 150, 150, 120));
    const double newest_s = history.samples().empty() ? 0.0 : history.samples().back().time_s;
    std::vector<ImVec2> line;
    for (int axis = 0; axis < 3; ++axis) {
        line.clear();
        for (const auto& sample : history.samples()) {
            const double age = (newest_s - sample.time_s) / ToolHistory::kept_s;
            line.push_back(
                {corner.x + size.x * static_cast<float>(1.0 - age), height_of(sample.force_n[axis])});
        }
        canvas.AddPolyline(line.data(), static_cast<int>(line.size()),
                           axis_colours[static_cast<std::size_t>(axis)], ImDrawFlags_None, 1.5f);
    }
    const std::string scale = fmt::format("{:.1f} N", largest_n);
    canvas.AddText({corner.x + 2.0f, corner.y}, IM_COL32(200, 200, 200, 200), scale.c_str());
    ImGui::Dummy(size);
}

void draw_force_panel(const OverlayContent& content, const glm::ivec2& size_px) {
    begin_panel("force", {1.0f, 1.0f}, size_px);
    const glm::dvec3& force_n = content.tool->force_n;
    text(fmt::format("force on the hand {:5.2f} N", glm::length(force_n)));
    for (int axis = 0; axis < 3; ++axis) {
        const auto index = static_cast<std::size_t>(axis);
        coloured_text(axis_colours[index], fmt::format("{} {:+.2f}", axis_names[index], force_n[axis]));
        if (axis < 2) ImGui::SameLine();
    }
    if (content.history) plot_forces(*content.history, {280.0f, 90.0f});
    ImGui::TextDisabled("last %.0f s, patient axes", ToolHistory::kept_s);
    ImGui::End();
}

void draw_warnings(const OverlayContent& content, const glm::ivec2& size_px) {
    std::vector<std::string> warnings;
    if (!content.bone_problem.empty()) warnings.push_back(content.bone_problem);
    if (!content.link.recording_error.empty()) warnings.push_back(content.link.recording_error);
    if (content.tool && !content.tool->fault.empty()) warnings.push_back("FAULT: " + content.tool->fault);
    if (content.tool && content.tool->touches_protected)
        warnings.emplace_back("PROTECTED TISSUE: the burr touches it");
    if (warnings.empty()) return;
    begin_panel("warnings", {0.5f, 0.0f}, size_px);
    for (const std::string& warning : warnings) coloured_text(vermillion, warning);
    ImGui::End();
}

void draw_operator_panel(const OverlayContent& content, const glm::ivec2& size_px) {
    begin_panel("operator", {0.0f, 1.0f}, size_px);
    const OperatorIntent& intent = *content.operator_intent;
    if (content.tool && content.tool->driver == ToolDriver::another)
        coloured_text(vermillion, "another client moves the tool; ask again when it has let go");
    coloured_text(intent.pedal ? bluish_green : IM_COL32(190, 190, 190, 255),
                  intent.pedal ? "pedal down" : "pedal up (SPACE)");
    ImGui::TextDisabled("left drag: hand   W/S: in/out   1-9 [ ]: burr");
    ImGui::End();
}

void draw_help(const OverlayContent& content, const glm::ivec2& size_px) {
    begin_panel("help", {0.5f, 0.5f}, size_px);
    text("right drag          turn the view");
    text("middle drag, or     shift it");
    text("  shift + right drag");
    text("wheel               zoom");
    text("HOME                first view again");
    text("F1                  this help");
    text("ESC                 end");
    ImGui::Separator();
    if (content.operator_intent) {
        text("left drag           move the hand in the picture's plane;");
        text("                    let go to move the mouse without the hand");
        text("W, S, ctrl + wheel  along the spindle: into the bone, out of it");
        text("SPACE (held)        pedal: the spindle turns");
        text("1 to 9, [ and ]     choose the burr");
        text("orange arrow        the force that an arm would give to the hand");
        text("blue sphere         where the hand wants the burr");
    } else if (content.player != nullptr) {
        text("left drag           turn the view");
        text("SPACE               play, pause");
        text("LEFT, RIGHT         5 s back, on");
    } else {
        text("left drag           turn the view");
        text("This server has its own device: to drill with the mouse, start");
        text("haptic_server with --device client.");
    }
    ImGui::End();
}

}  // namespace

void draw_overlay(const OverlayContent& content, const glm::ivec2& size_px) {
    draw_session_panel(content, size_px);
    if (content.tool) {
        draw_tool_panel(content, size_px);
        draw_force_panel(content, size_px);
    }
    draw_warnings(content, size_px);
    if (content.operator_intent) draw_operator_panel(content, size_px);
    if (content.player != nullptr) draw_playback_panel(*content.player, size_px);
    if (content.help_shown) draw_help(content, size_px);
}

}  // namespace osteomill
