#include "render_client/ui/panels.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <stdexcept>

namespace osteomill {

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

void Panels::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace osteomill
