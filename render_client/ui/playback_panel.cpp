#include "render_client/ui/playback_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace osteomill {

namespace {

constexpr float margin_px = 12.0f;
constexpr float widest_slider_px = 420.0f;
constexpr float speed_width_px = 90.0f;
constexpr float button_width_px = 56.0f;

/// "2:05.3": minutes, seconds, tenths.
std::string clock_text(double time_s) {
    const auto tenths = static_cast<long>(10.0 * time_s + 0.5);
    return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

}  // namespace

void draw_playback_panel(RecordingPlayer& player, const glm::ivec2& size_px) {
    const auto width = static_cast<float>(size_px.x);
    ImGui::SetNextWindowPos({margin_px, static_cast<float>(size_px.y) - margin_px}, ImGuiCond_Always,
                            {0.0f, 1.0f});
    ImGui::SetNextWindowBgAlpha(0.72f);
    ImGui::Begin("playback", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoNav);
    if (ImGui::Button(player.is_playing() ? "pause" : "play", {button_width_px, 0.0f}))
        player.is_playing() ? player.pause() : player.play();

    ImGui::SameLine();
    auto time_s = static_cast<float>(player.time_s());
    const std::string shown = clock_text(player.time_s()) + " / " + clock_text(player.duration_s());
    ImGui::SetNextItemWidth(std::min(widest_slider_px, 0.4f * width));
    if (ImGui::SliderFloat("##time", &time_s, 0.0f, static_cast<float>(player.duration_s()), shown.c_str(),
                           ImGuiSliderFlags_NoInput))
        player.seek(time_s);

    ImGui::SameLine();
    auto speed = static_cast<float>(player.speed());
    ImGui::SetNextItemWidth(speed_width_px);
    if (ImGui::SliderFloat("##speed", &speed, static_cast<float>(RecordingPlayer::slowest),
                           static_cast<float>(RecordingPlayer::fastest), "%.1f x",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput))
        player.set_speed(speed);
    ImGui::End();
}

}  // namespace osteomill
