#include "render_client/ui/panels/playback_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "common/words/translation.h"
#include "render_client/ui/panels/widget_panel.h"

namespace osteomill {

namespace {

/// At scale 1.
constexpr float widest_px = 600.0f;
constexpr float widest_part = 0.62f;
constexpr float tick_width_px = 2.0f;
// In heights of a letter.
constexpr float speed_width = 6.0f;
constexpr float button_width = 4.0f;

/// "2:05.3": minutes, seconds, tenths.
std::string clock_text(double time_s) {
    const auto tenths = static_cast<long>(10.0 * time_s + 0.5);
    return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

/// Over the slider that was drawn last: marks from above, touches from below.
void draw_moments(const RecordingPlayer& player, const PanelPainter& painter) {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    // The grab's middle is so far from either end when it stands there.
    const float inset = 2.0f + 0.5f * ImGui::GetStyle().GrabMinSize;
    const float half = 0.5f * (high.y - low.y);
    for (const auto& [time_s, kind] : player.moments()) {
        const double part = player.duration_s() > 0.0 ? std::min(1.0, time_s / player.duration_s()) : 0.0;
        const float x = low.x + inset + static_cast<float>(part) * (high.x - low.x - 2.0f * inset);
        const bool is_mark = kind == RecordedMoment::Kind::mark;
        ImGui::GetWindowDrawList()->AddLine({x, is_mark ? low.y : high.y - half},
                                            {x, is_mark ? low.y + half : high.y},
                                            colour_of(painter.theme()[is_mark ? Tone::good : Tone::warning]),
                                            tick_width_px * painter.scale());
    }
}

}  // namespace

glm::vec2 playback_panel_size(const PanelPainter& painter, const glm::vec2& picture) {
    return {std::min(widest_px * painter.scale(), widest_part * picture.x),
            ImGui::GetFrameHeight() + 2.0f * ImGui::GetStyle().WindowPadding.y};
}

void draw_playback_panel(RecordingPlayer& player, const PanelPainter& painter, const PanelPlace& place) {
    const WidgetPanel window("playback", place);
    const float letter = ImGui::GetFontSize();
    if (ImGui::Button(player.is_playing() ? tr("pause") : tr("play"), {button_width * letter, 0.0f}))
        player.is_playing() ? player.pause() : player.play();

    ImGui::SameLine();
    auto time_s = static_cast<float>(player.time_s());
    const std::string shown =
        with_decimal_sign(clock_text(player.time_s()) + " / " + clock_text(player.duration_s()));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - speed_width * letter -
                            ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::SliderFloat("##time", &time_s, 0.0f, static_cast<float>(player.duration_s()), shown.c_str(),
                           ImGuiSliderFlags_NoInput))
        player.seek(time_s);
    draw_moments(player, painter);

    ImGui::SameLine();
    auto speed = static_cast<float>(player.speed());
    ImGui::SetNextItemWidth(speed_width * letter);
    if (ImGui::SliderFloat(
            "##speed", &speed, static_cast<float>(RecordingPlayer::slowest),
            static_cast<float>(RecordingPlayer::fastest), spoken_number("{:.1f} x", speed).c_str(),
            ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput | ImGuiSliderFlags_NoRoundToFormat))
        player.set_speed(speed);
}

}  // namespace osteomill
