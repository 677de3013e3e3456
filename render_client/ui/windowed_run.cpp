#include "render_client/ui/windowed_run.h"

#include <epoxy/gl.h>
// GLFW comes after libepoxy, which brings OpenGL's declarations.
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "render_client/ui/commands.h"
#include "render_client/ui/operator_hand.h"
#include "render_client/ui/screenshots.h"
#include "render_client/ui/session_picture.h"
#include "render_client/ui/window.h"

namespace osteomill {

namespace {

using Clock = std::chrono::steady_clock;

constexpr glm::ivec2 default_size_px(1280, 800);
constexpr double orbit_rad_per_px = 0.008;
constexpr double zoom_per_notch = 0.88;
constexpr double advance_mm_per_s = 2.0;
constexpr double advance_mm_per_notch = 0.1;
constexpr double cut_mm_per_notch = 0.5;
/// A display without vertical synchronisation must not take the cores from a server beside it: twice the
/// rate of its frames is smooth.
constexpr std::chrono::milliseconds shortest_frame(16);

void move_camera(SessionPicture& session, float wheel_notches, bool left_turns) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse) return;  // a panel has it
    const glm::dvec2 moved_px(io.MouseDelta.x, io.MouseDelta.y);
    const bool right = io.MouseDown[ImGuiMouseButton_Right];
    if (io.MouseDown[ImGuiMouseButton_Middle] || (right && io.KeyShift))
        pan(session.camera(), moved_px, session.size_px());
    else if (right || (left_turns && io.MouseDown[ImGuiMouseButton_Left]))
        orbit(session.camera(), -orbit_rad_per_px * moved_px.x, orbit_rad_per_px * moved_px.y);
    if (wheel_notches == 0.0f || io.KeyCtrl) return;
    if (io.KeyAlt)
        session.view().cuts.move_last(cut_mm_per_notch * wheel_notches);
    else
        zoom(session.camera(), std::pow(zoom_per_notch, wheel_notches));
}

void move_hand(OperatorHand& hand, const Window& window, SessionPicture& session, float wheel_notches,
               double elapsed_s) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!window.focused()) {
        hand.let_go();
        return;
    }
    if (!io.WantCaptureMouse) {
        if (io.MouseDown[ImGuiMouseButton_Left] && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f))
            hand.move_in_picture({io.MouseDelta.x, io.MouseDelta.y}, session.camera(), session.size_px());
        if (io.KeyCtrl && wheel_notches != 0.0f) hand.advance(advance_mm_per_notch * wheel_notches);
    }
    if (window.key_down(GLFW_KEY_W)) hand.advance(advance_mm_per_s * elapsed_s);
    if (window.key_down(GLFW_KEY_S)) hand.advance(-advance_mm_per_s * elapsed_s);
    for (const int key : window.presses())
        if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9)
            hand.choose_burr(static_cast<std::size_t>(key - GLFW_KEY_1));
    hand.set_pedal(window.key_down(GLFW_KEY_SPACE));
    hand.follow(*session.tool(), session.session()->burrs.size());
}

}  // namespace

RenderReport run_in_window(const RenderOptions& options, SessionSource& source,
                           const std::function<bool()>& stop_asked) {
    Window window(options.window_size_px.value_or(default_size_px), "Osteomill");
    gl::require_opengl_3_3();
    Panels panels(window.handle());
    SessionPicture session(source, panels, window.framebuffer_size_px(), FrameQuality::on_demand,
                           options.renderer, options.look);
    session.limit_textures({.budget_bytes = options.texture_budget_bytes});
    OperatorHand hand;
    session.view().theme = options.theme;
    session.view().cuts = options.cuts;
    session.view().panels_shown = options.panels;
    Commands commands(session, hand, source.player(), options.screenshots);
    FrameTimes frame_times;
    Screenshots screenshots(options.screenshots, screenshot_interval(options));

    const Clock::time_point began = Clock::now();
    Clock::time_point previous = began;
    bool session_over = false;
    bool had_tool = false;
    while (!window.close_asked() && !stop_asked() && !commands.end_wanted() && !session_over) {
        const Clock::time_point start = Clock::now();
        const double elapsed_s = std::chrono::duration<double>(start - previous).count();
        previous = start;
        window.clear_presses();
        glfwPollEvents();
        window.require_alive();
        session.take_in();
        session_over = options.until_server_ends && session.link().status == LinkStatus::finished;

        // Without a session of this kind there is nobody who could be sent an operator's wishes.
        const bool drills = session.link().status == LinkStatus::live && session.tool() &&
                            session.session() && session.session()->accepts_operator;
        if (drills) {
            // What the hand wants is only known once it rests on the tool: an intent of its own making would
            // drag the tool away.
            hand.follow(*session.tool(), session.session()->burrs.size());
            // What is sent last lifts the pedal; then the tool is free for others.
            if (hand.wants_tool() || had_tool) source.send_operator(hand.intent());
            // It may be asked for, but must not jump to where this hand has gone meanwhile.
            if (session.tool()->driver == ToolDriver::another) hand.let_go();
        }
        had_tool = drills && hand.wants_tool();
        session.show_operator(drills ? std::optional(hand.intent()) : std::nullopt);
        if (!drills) hand.let_go();

        if (window.minimised()) {
            if (drills) hand.let_go();
            std::this_thread::sleep_for(shortest_frame);
            continue;
        }
        session.resize(window.framebuffer_size_px());
        session.view().scale = static_cast<float>(options.ui_scale.value_or(window.content_scale()));
        const gl::Framebuffer& framebuffer = session.draw(elapsed_s);
        // ImGui took the input in while the panels were drawn; it takes effect in the next frame.
        move_camera(session, panels.wheel_notches(), !drills);
        if (drills) move_hand(hand, window, session, panels.wheel_notches(), elapsed_s);
        // Letters that are typed into a panel are no commands.
        const std::span<const int> presses =
            ImGui::GetIO().WantTextInput ? std::span<const int>() : window.presses();
        for (const Action action : actions_of(presses, situation_of(drills, source.player() != nullptr)))
            commands.take(action);
        commands.write_pictures(framebuffer, std::chrono::duration<double>(start - began).count());

        if (session.has_bone()) screenshots.after_frame(framebuffer);
        if (session_over) screenshots.after_last_frame(framebuffer);
        framebuffer.copy_colour_to_window();
        window.show_frame();
        const double took_s = std::chrono::duration<double>(Clock::now() - start).count();
        session.frame_took(took_s);
        frame_times.add(1e3 * took_s);
        std::this_thread::sleep_until(start + shortest_frame);
    }
    RenderReport report = session.report();
    report.frame_times = std::move(frame_times);
    return report;
}

}  // namespace osteomill
