#include "render_client/ui/panels.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <stdexcept>

namespace osteomill {

namespace {

/// What a draw command covers, in pixels of the framebuffer, y up.
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
    const int height = static_cast<int>(drawn.DisplaySize.y * scale.y);
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

Panels::Panels() {
    start();
}

Panels::Panels(GLFWwindow* window) : window_(window) {
    start();
    ImGui_ImplGlfw_InitForOpenGL(window, true);
}

void Panels::start() {
    ImGui::CreateContext();
    // No file is written beside the program.
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 4.0f;
    ImGui::GetStyle().WindowBorderSize = 0.0f;
    if (ImGui_ImplOpenGL3_Init("#version 330 core")) return;
    ImGui::DestroyContext();
    throw std::runtime_error("Dear ImGui finds no OpenGL 3 (libGL.so.1); install it: apt-get install libgl1");
}

Panels::~Panels() {
    ImGui_ImplOpenGL3_Shutdown();
    if (window_) ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Panels::begin(const glm::ivec2& size_px, double elapsed_s) {
    ImGui_ImplOpenGL3_NewFrame();
    if (window_) {
        ImGui_ImplGlfw_NewFrame();
    } else {
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {static_cast<float>(size_px.x), static_cast<float>(size_px.y)};
        io.DeltaTime = static_cast<float>(std::max(elapsed_s, 1e-4));
    }
    ImGui::NewFrame();
}

std::vector<PixelBox> Panels::end() {
    ImGui::Render();
    const ImDrawData* drawn = ImGui::GetDrawData();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    return boxes_of(*drawn);
}

}  // namespace osteomill
