#include "render_client/ui/panels/imgui_context.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
// Which windows there are, only this header knows.
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <limits>
#include <stdexcept>

#include "render_client/ui/panels/imgui_input.h"
#include "render_client/ui/panels/panel_painter.h"

namespace osteomill {

namespace {

constexpr float built_in_letter_px = 13.0f;

/// Latin letters, and the signs on the tool bar.
constexpr std::array<ImWchar, 11> letters{0x20,   0x17F,  0x2190, 0x21FF, 0x2300, 0x231F,
                                          0x25A0, 0x25FF, 0x2600, 0x27BF, 0};

ImVec4 imgui_colour(const Rgba& colour) {
    return ImGui::ColorConvertU32ToFloat4(colour_of(colour));
}

void set_colours(const Theme& theme, ImGuiStyle& style) {
    const auto set = [&](std::initializer_list<ImGuiCol> places, const Rgba& colour) {
        for (const ImGuiCol place : places) style.Colors[place] = imgui_colour(colour);
    };
    set({ImGuiCol_Text, ImGuiCol_CheckMark}, theme[Tone::plain]);
    set({ImGuiCol_NavHighlight}, theme[Tone::warning]);
    set({ImGuiCol_TextDisabled}, theme[Tone::dim]);
    // A slider's number is written over its handle.
    set({ImGuiCol_SliderGrab}, theme.control_active);
    set({ImGuiCol_WindowBg, ImGuiCol_PopupBg}, theme.panel);
    set({ImGuiCol_Button, ImGuiCol_FrameBg, ImGuiCol_Header}, theme.control);
    set({ImGuiCol_ButtonHovered, ImGuiCol_FrameBgHovered, ImGuiCol_HeaderHovered}, theme.control_hovered);
    set({ImGuiCol_ButtonActive, ImGuiCol_FrameBgActive, ImGuiCol_HeaderActive, ImGuiCol_SliderGrabActive},
        theme.control_active);
}

/// The box that a draw command covers, in pixels of the framebuffer, y up.
PixelBox box_of(const ImDrawData& drawn, const ImDrawList& list, const ImDrawCmd& command) {
    glm::vec2 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (unsigned int i = 0; i < command.ElemCount; ++i) {
        const int index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
        const ImVec2& place = list.VtxBuffer[static_cast<int>(command.VtxOffset) + index].pos;
        low = glm::min(low, {place.x, place.y});
        high = glm::max(high, {place.x, place.y});
    }
    low = glm::max(low, {command.ClipRect.x, command.ClipRect.y});
    high = glm::min(high, {command.ClipRect.z, command.ClipRect.w});
    if (low.x >= high.x || low.y >= high.y) return {};
    const glm::vec2 origin(drawn.DisplayPos.x, drawn.DisplayPos.y);
    const glm::vec2 scale(drawn.FramebufferScale.x, drawn.FramebufferScale.y);
    const glm::ivec2 first(glm::floor((low - origin) * scale));
    const glm::ivec2 end(glm::ceil((high - origin) * scale));
    const int height = static_cast<int>(std::lround(drawn.DisplaySize.y * scale.y));
    return {{first.x, height - end.y}, end - first};
}

std::vector<PixelBox> boxes_of(const ImDrawData& drawn) {
    std::vector<PixelBox> boxes;
    for (int list = 0; list < drawn.CmdListsCount; ++list)
        for (const ImDrawCmd& command : drawn.CmdLists[list]->CmdBuffer)
            boxes.push_back(box_of(drawn, *drawn.CmdLists[list], command));
    return boxes;
}

}  // namespace

ImguiContext::ImguiContext() {
    ImGui::CreateContext();
    // No file is written beside the program.
    ImGui::GetIO().IniFilename = nullptr;
    prepare_imgui_input(ImGui::GetIO());
    if (ImGui_ImplOpenGL3_Init("#version 330 core")) return;
    ImGui::DestroyContext();
    throw std::runtime_error("Dear ImGui finds no OpenGL 3 (libGL.so.1); install it: apt-get install libgl1");
}

ImguiContext::~ImguiContext() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void ImguiContext::set_style(ThemeName theme, float scale) {
    if (scale != scale_) load_letters(scale);
    theme_ = theme;
    scale_ = scale;
    ImGuiStyle style;
    theme == ThemeName::dark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
    set_colours(theme_of(theme), style);
    style.WindowRounding = 4.0f;
    style.FrameRounding = 3.0f;
    style.WindowBorderSize = 0.0f;
    style.WindowMinSize = {1.0f, 1.0f};
    style.ScaleAllSizes(scale);
    // From Dear ImGui 1.92 on its base size of 0 takes that of the new letters.
    ImGui::GetStyle() = style;
}

void ImguiContext::load_letters(float scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    ImFontConfig config;
    if (std::filesystem::exists(font_file)) {
        atlas.AddFontFromFileTTF(font_file, std::round(letter_px * scale), nullptr, letters.data());
    } else {
        config.SizePixels = std::round(built_in_letter_px * scale);
        // Its strokes are a pixel high: in small print one row of the texture would be passed over, and every
        // minus lost.
        config.OversampleV = 2;
        atlas.AddFontDefault(&config);
    }
    // The back end uploads the first letters by itself, from 1.92 on all others, too. Not all of its objects
    // are made anew for others: it would go on to write into buffers of the old ones' size.
#if IMGUI_VERSION_NUM < 19200
    if (scale_ == 0.0f) return;
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
#endif
}

void ImguiContext::use(Clipboard& clipboard) {
    give_clipboard(clipboard, ImGui::GetIO());
}

bool ImguiContext::feed(const WindowInput& input, bool holds_text) {
    return input_.feed(input, ImGui::GetIO(), holds_text);
}

void ImguiContext::begin(const glm::ivec2& size_px, const glm::ivec2& drawn_px, double elapsed_s,
                         ThemeName theme, float scale) {
    if (theme != theme_ || scale != scale_) set_style(theme, scale);
    ImGui_ImplOpenGL3_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = static_cast<float>(std::max(elapsed_s, 1e-4));
    io.DisplaySize = {static_cast<float>(size_px.x), static_cast<float>(size_px.y)};
    io.DisplayFramebufferScale = {static_cast<float>(drawn_px.x) / io.DisplaySize.x,
                                  static_cast<float>(drawn_px.y) / io.DisplaySize.y};
    ImGui::NewFrame();
    wheel_notches_ = io.MouseWheel;
}

std::vector<PixelBox> ImguiContext::input_boxes() const {
    std::vector<PixelBox> boxes;
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        if (!window->WasActive || window->Hidden || window->IsFallbackWindow) continue;
        boxes.push_back({{static_cast<int>(window->Pos.x), static_cast<int>(window->Pos.y)},
                         {static_cast<int>(window->Size.x), static_cast<int>(window->Size.y)}});
    }
    return boxes;
}

std::vector<PixelBox> ImguiContext::end(std::span<const gl::Framebuffer* const> pictures) {
    ImGui::Render();
    const ImDrawData* drawn = ImGui::GetDrawData();
    for (const gl::Framebuffer* picture : pictures) {
        picture->bind();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    }
    return boxes_of(*drawn);
}

}  // namespace osteomill
