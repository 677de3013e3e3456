#include "render_client/ui/panels/playback_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "render_client/ui/panels/input_panel.h"

namespace osteomill {

namespace {

/// At scale 1.
constexpr float widest_px = 600.0f;
constexpr float widest_part = 0.62f;
// In heights of a letter.
constexpr float speed_width = 6.0f;
constexpr float button_width = 4.0f;

/// "2:05.3": minutes, seconds, tenths.
std::string clock_text(double time_s) {
    const auto tenths = static_cast<long>(10.0 * time_s + 0.5);
    return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

}  // namespace

glm::vec2 playback_panel_size(const PanelPainter& painter, const glm::vec2& picture) {
    return {std::min(widest_px * painter.scale(), widest_part * picture.x),
            ImGui::GetFrameHeight() + 2.0f * ImGui::GetStyle().WindowPadding.y};
}

void draw_playback_panel(RecordingPlayer& player, const PanelPlace& place) {
    const InputPanel window("playback", place);
    const float letter = ImGui::GetFontSize();
    if (ImGui::Button(player.is_playing() ? "pause" : "play", {button_width * letter, 0.0f}))
        player.is_playing() ? player.pause() : player.play();

    ImGui::SameLine();
    auto time_s = static_cast<float>(player.time_s());
    const std::string shown = clock_text(player.time_s()) + " / " + clock_text(player.duration_s());
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - speed_width * letter -
                            ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::SliderFloat("##time", &time_s, 0.0f, static_cast<float>(player.duration_s()), shown.c_str(),
                           ImGuiSliderFlags_NoInput))
        player.seek(time_s);

    ImGui::SameLine();
    auto speed = static_cast<float>(player.speed());
    ImGui::SetNextItemWidth(speed_width * letter);
    if (ImGui::SliderFloat("##speed", &speed, static_cast<float>(RecordingPlayer::slowest),
                           static_cast<float>(RecordingPlayer::fastest), "%.1f x",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput))
        player.set_speed(speed);
}

}  // namespace osteomill
