#include "render_client/ui/windowed_run.h"

#include <epoxy/gl.h>
// GLFW comes after libepoxy, which brings OpenGL's declarations.
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <thread>

#include "common/log/log.h"
#include "common/scene/scene_file.h"
#include "render_client/dataset/pinhole.h"
#include "render_client/sound/session_sound.h"
#include "render_client/ui/input/clipboard.h"
#include "render_client/ui/input/commands.h"
#include "render_client/ui/input/hand_input.h"
#include "render_client/ui/input/input_mailbox.h"
#include "render_client/ui/input/operator_hand.h"
#include "render_client/ui/input/window_input.h"
#include "render_client/ui/panels/sight_panel.h"
#include "render_client/ui/panels/start_panel.h"
#include "render_client/ui/view/drawing_thread.h"
#include "render_client/ui/view/kept_settings.h"
#include "render_client/ui/view/picture_export.h"
#include "render_client/ui/view/picture_options.h"
#include "render_client/ui/view/recording_camera.h"
#include "render_client/ui/view/redraw.h"
#include "render_client/ui/view/session_picture.h"
#include "render_client/ui/view/transfer_file.h"
#include "render_client/ui/view/window.h"
#include "render_client/volume/surface_points.h"

namespace osteomill {

namespace {

using Clock = std::chrono::steady_clock;

constexpr glm::ivec2 default_size_px(1280, 800);
constexpr double orbit_rad_per_px = 0.008;
/// A share of the picture's height, while a key is held.
constexpr double view_motion_a_s = 0.5;
constexpr double cut_mm_per_notch = 0.5;
/// A display without vertical synchronisation must not take the cores from a server beside it: twice the
/// rate of its frames is smooth. The link is polled as often, even if nothing is drawn.
constexpr std::chrono::milliseconds shortest_frame(16);

/// How often the mouse is read and its command sent while the operator has the tool: four in five messages
/// may be lost before the server counts that as silence.
constexpr std::chrono::milliseconds driving_period(10);
/// Otherwise events wake the thread, but a mouse that reports a thousand times a second no oftener than this.
constexpr std::chrono::milliseconds shortest_period(4);
constexpr double longest_wait_s = 0.1;
/// Between two viewpoints that are sent to the server.
constexpr std::chrono::milliseconds view_period(33);

void move_camera(SessionPicture& session, Commands& commands, float wheel_notches, bool left_turns) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse) return;  // a panel has it
    const glm::dvec2 moved_px(io.MouseDelta.x, io.MouseDelta.y);
    const bool right = io.MouseDown[ImGuiMouseButton_Right];
    const bool moves_bone = commands.is_clutched();
    const bool left = io.MouseDown[ImGuiMouseButton_Left];
    if (moves_bone && (left || right) && !io.KeyShift)
        commands.turn_bone(-orbit_rad_per_px * moved_px.x, orbit_rad_per_px * moved_px.y);
    else if (io.MouseDown[ImGuiMouseButton_Middle] || ((right || (moves_bone && left)) && io.KeyShift))
        pan(session.camera(), moved_px, session.size_px());
    else if (right || (left_turns && io.MouseDown[ImGuiMouseButton_Left]))
        orbit(session.camera(), -orbit_rad_per_px * moved_px.x, orbit_rad_per_px * moved_px.y);
    if (wheel_notches == 0.0f) return;
    if (io.KeyAlt)
        session.view().cuts.move_last(cut_mm_per_notch * wheel_notches);
    else if (left_turns || io.KeyCtrl || moves_bone)  // else it is the hand's
        zoom(session.camera(), std::pow(zoom_per_notch, wheel_notches));
}

/// A session of this machine can be started from the window, whose link speaks no TLS.
bool can_start_here(const RenderOptions& options) {
    return !options.replay && !options.tls && !options.until_server_ends;
}

std::filesystem::path home_of(const RenderOptions& options) {
    return options.home.value_or(home_of_cases());
}

/// The state that the two threads of a window share.
struct Shared {
    InputMailbox mailbox{};
    Clipboard clipboard;
    HandInput desk;
    std::atomic<bool> is_over{false};          ///< asked for by either thread
    std::atomic<bool> close_requested{false};  ///< somebody wants to close the window
    std::atomic<bool> is_fullscreen{false};
};

/// The thread that draws: reads the source's news, and shows them.
class Drawing {
  public:
    /// The window's context is current here, for as long as this lives.
    Drawing(const RenderOptions& options, SessionSource& source, Window& window, Shared& shared)
        : options_(options),
          source_(source),
          window_(window),
          shared_(shared),
          session_(source, panels_, shared.mailbox.take().framebuffer_size_px, FrameQuality::on_demand,
                   options.renderer, options.look, options.stereo),
          commands_(session_, shared.desk, source, options.screenshots),
          screenshots_(options.screenshots, screenshot_interval(options)) {
        panels_.use(shared.clipboard);
        if (auto second = window.second_context()) {
            storage_.emplace(std::move(second));
            session_.make_storage_by(*storage_);
        }
        take_over(session_, options);
        take_over_kept();
        if (!settings_.wrong().empty()) {
            log_warning("{}", settings_.wrong());
            commands_.say(settings_.wrong(), 0.0);
        }
        session_.view().transfer_has_file = look_.has_file();
        session_.offer_controls();
        if (can_start_here(options)) {
            start_.emplace(StartPlaces{.programs = folder_of_this_program(),
                                       .home = home_of(options),
                                       .connects_to = {options.host, options.port}});
            session_.offer_start(*start_);
            if (!settings_.settings().tour_seen) start_->page.tour_card = 0;
        }
        redraw_.note_change(began_);
    }

    RenderReport run() {
        while (!shared_.is_over && !commands_.end_wanted() && !session_over_) {
            const Clock::time_point start = Clock::now();
            window_.require_drawable();
            take_in(start);
            const bool draws = !input_.is_minimised && (redraw_.is_due(start) || session_over_);
            if (draws) draw(start);
            // At rest an input is shown at once, but the mouse may report a thousand times a second.
            if (draws)
                std::this_thread::sleep_until(start + shortest_frame);
            else
                shared_.mailbox.wait_until(start + shortest_frame);
        }
        RenderReport report = session_.report();
        report.frame_times = std::move(frame_times_);
        shared_.is_over = true;  // what a session of this window still saves is waited for without it
        return report;
    }

  private:
    void take_in(Clock::time_point now) {
        WindowInput happened = shared_.mailbox.take();
        if (shared_.close_requested.exchange(false)) {
            commands_.ask_to_end();
            redraw_.note_change(now);
        }
        const double now_s = std::chrono::duration<double>(now - began_).count();
        view_motion_ = is_at_a_page() ? glm::ivec2(0) : held_view_.motion(input_.keys_down, now_s);
        const bool view_moves = view_motion_ != glm::ivec2(0);
        if (happened.has_news || view_moves || (start_ && start_->page.poll())) redraw_.note_change(now);
        input_.append(happened);
        if (start_)
            if (const auto server = start_->page.take_server()) source_.connect_to(*server);
        const bool stands_alone = start_ && start_->stands_alone(session_.link().status);
        if (std::exchange(page_stands_alone_, stands_alone) != stands_alone)
            source_.leave_alone(stands_alone);

        work_look(std::chrono::duration<double>(now - began_).count());
        work_sound(std::chrono::duration<double>(now - began_).count());
        keep_settings(std::chrono::duration<double>(now - began_).count());

        const SessionNews news = session_.take_in();
        // Not before the session's bone is there: a server may wait for that.
        if (session_.elements().controls && now - view_told_ >= view_period) {
            source_.send_view(viewpoint_of(session_.camera()));
            view_told_ = now;
        }
        const LinkUpdate& link = session_.link();
        if (start_)
            start_->page.link_line = options_.names_server && link.status == LinkStatus::connecting
                                         ? link.status_line + ". " + advice_before_first_answer()
                                         : std::string();
        session_over_ = options_.until_server_ends && link.status == LinkStatus::finished;
        commands_.tell(link.events, std::chrono::duration<double>(now - began_).count());
        drills_ = source_.player() == nullptr && session_.elements().controls && session_.tool() &&
                  session_.session() && session_.session()->accepts_operator &&
                  (!asks() || session_.view().question == SessionQuestion::mark);
        shared_.desk.show({.drills = drills_,
                           .burr_count = session_.session() ? session_.session()->burrs.size() : 0,
                           .reach_mm = session_.session() ? session_.session()->reach_mm : longest_reach_mm,
                           .camera = session_.camera(),
                           .size_px = session_.size_px(),
                           .panels_have_mouse = ImGui::GetIO().WantCaptureMouse ||
                                                session_.view().click_places || session_.view().moves_bone,
                           .panels = panels_.input_boxes(),
                           .panels_have_keyboard = has_keyboard(),
                           .over_bone_mm = over_bone_mm(),
                           .wheel_step_mm = step_of_wheel_mm(),
                           .drag_tilts = session_.view().drag_tilts,
                           .is_clutched = commands_.is_clutched(),
                           .holds_still = link.controls.is_paused});
        session_.show_operator(shared_.desk.command());

        const RecordingPlayer* player = source_.player();
        if (news == SessionNews::change || commands_.is_exporting() ||
            (player != nullptr && player->is_playing()))
            redraw_.note_change(now);
        // A notice goes after some seconds.
        if (news == SessionNews::figures || !session_.view().notice.empty()) redraw_.note_figures();
    }

    /// Another case brings another transfer table; an edited one is saved if that is requested.
    void work_look(double now_s) {
        ViewSettings& view = session_.view();
        try {
            if (start_ && !start_->page.look_file().empty())
                if (const auto look = look_.open(start_->page.look_file())) view.transfer.choose(*look);
        } catch (const SceneError& error) {
            commands_.say(error.what(), now_s);
        }
        view.transfer_has_file = look_.has_file();
        if (std::exchange(view.transfer_save_wanted, false))
            commands_.say(look_.save(view.transfer.function()), now_s);
    }

    /// The command line has precedence.
    void take_over_kept() {
        const KeptSettings& kept = settings_.settings();
        ViewSettings& view = session_.view();
        if (!options_.theme) view.theme = kept.theme;
        view.sound = options_.sound || kept.sound;
        view.warns = kept.warns;
        view.details_shown = kept.details_shown;
    }

    void keep_settings(double now_s) {
        const ViewSettings& view = session_.view();
        // Who is in a session has found the way.
        if (start_ && session_.link().status == LinkStatus::live) start_->page.tour_card.reset();
        const bool tour_seen = settings_.settings().tour_seen || (start_ && !start_->page.tour_card);
        if (const std::string wrong = settings_.keep({.theme = view.theme,
                                                      .sound = view.sound,
                                                      .warns = view.warns,
                                                      .details_shown = view.details_shown,
                                                      .tour_seen = tour_seen});
            !wrong.empty())
            commands_.say(wrong, now_s);
    }

    /// On and off as a person wants it; without a loudspeaker it is off again.
    void work_sound(double now_s) {
        bool& wanted = session_.view().sound;
        if (wanted != sound_.is_on()) commands_.say(sound_.switch_to(wanted), now_s);
        if (const std::string lost = sound_.hear(session_.tool(), session_.session(),
                                                 session_.link().distances, session_.view().warns);
            !lost.empty())
            commands_.say(lost, now_s);
        wanted = sound_.is_on();
    }

    void draw(Clock::time_point start) {
        const double elapsed_s = std::chrono::duration<double>(start - drawn_).count();
        drawn_ = start;
        session_.resize(input_.framebuffer_size_px);
        session_.view().scale = static_cast<float>(options_.ui_scale.value_or(input_.content_scale));
        if (start_) start_->page.window_size = glm::ivec2(glm::round(input_.size));
        std::optional<WindowInput> of_note;
        if (const auto presses = presses_until_note()) of_note = input_.take_after(*presses);
        if (panels_.feed(input_, opens_note_field())) redraw_.note_change(start);
        commands_.work_clutch();
        camera_.aim(session_);
        had_popup_ = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
        const gl::Framebuffer& framebuffer = session_.draw(elapsed_s);
        // Dear ImGui took the input in while the panels were drawn; it takes effect in the next frame.
        move_camera(session_, commands_, panels_.wheel_notches(), !drills_);
        pan(session_.camera(),
            -view_motion_a_s * std::min(elapsed_s, longest_wait_s) * session_.size_px().y *
                glm::dvec2(view_motion_),
            session_.size_px());
        for (const Action action : actions_of(input_.pressed_keys(), situation()))
            if (may_act(action) && !(action == Action::end && (steps_back() || asks_at_page())))
                commands_.take(action);
        if (session_.view().click_places && ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
            !ImGui::GetIO().WantCaptureMouse)
            commands_.place_at({ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y},
                               ImGui::GetIO().KeyShift);
        commands_.take(session_.take_requests());
        shared_.is_fullscreen = session_.view().is_fullscreen;
        commands_.work_clutch();
        input_.forget_events();
        if (of_note) input_.append(*of_note);
        const std::string notice = session_.view().notice;
        commands_.write_pictures(framebuffer, std::chrono::duration<double>(start - began_).count());
        const bool has_new_notice = session_.view().notice != notice;

        if (session_.has_bone()) screenshots_.after_frame(framebuffer);
        if (session_over_) screenshots_.after_last_frame(framebuffer);
        session_.copy_to_window();
        window_.show_frame();
        const Clock::duration took = Clock::now() - start;
        const double took_s = std::chrono::duration<double>(took).count();
        redraw_.drew(start, took);
        if (has_new_notice) redraw_.note_change(start + took);
        session_.frame_took(took_s);
        frame_times_.add(1e3 * took_s);
    }

    /// The place to which a drag would take the burr in air.
    std::optional<glm::dvec3> over_bone_mm() const {
        const ImGuiIO& io = ImGui::GetIO();
        if (!drills_ || !io.MouseDown[ImGuiMouseButton_Left] || io.WantCaptureMouse) return std::nullopt;
        const auto pose = commands_.over_bone({io.MousePos.x, io.MousePos.y});
        return pose ? std::optional(pose->position_mm) : std::nullopt;
    }

    double step_of_wheel_mm() const {
        const std::optional<ToolState> tool = session_.tool();
        if (!drills_ || !tool || source_.bone() == nullptr) return HandInputPicture{}.wheel_step_mm;
        const double mm_per_px = mm_per_px_at(session_.camera(), tool->burr_position_mm, session_.size_px());
        // Then the burr is to come clear, and goes no deeper.
        if (!tool->fault.empty()) return wheel_step_mm(mm_per_px, std::nullopt);
        const Burr* burr = session_.session()->burr_of(tool->burr);
        return wheel_step_mm(
            mm_per_px, bone_ahead_mm(*source_.bone(), *tool, burr != nullptr ? burr->radius_mm() : 0.0));
    }

    bool is_at_a_page() const { return has_keyboard() || situation() == Situation::starting; }

    bool shows_start_page() const { return start_ && start_->is_due(session_.link().status); }

    /// Keys belong to a question that is asked, or to a field that is written in; ESC goes back from either,
    /// and a field has no use for F1.
    bool may_act(Action action) const {
        return action == Action::end || (!asks() && (action == Action::help || !has_keyboard()));
    }
    bool asks() const { return session_.view().question != SessionQuestion::none; }

    /// Closes a panel over the picture, or shows the hidden page again. Only if there is neither does ESC end
    /// the window.
    bool steps_back() {
        ViewSettings& view = session_.view();
        if (asks()) return false;
        if (had_popup_) ImGui::ClosePopupToLevel(0, false);
        if (had_popup_ || has_keyboard()) return true;  // Dear ImGui leaves a field by itself
        if (shows_start_page() && start_->page.tour_card)
            start_->page.tour_card.reset();
        else if (shows_start_page() && !view.help_shown && !start_->page.shows_cases())
            start_->page.go_back();
        else if (view.click_places || view.moves_bone)
            view.click_places = view.moves_bone = false;
        else if (view.help_shown)
            view.help_shown = false;
        else if (start_ && start_->is_hidden(session_.link().status))
            start_->page.is_hidden = false;
        else
            return false;
        return true;
    }

    /// The start page asks before it ends the window, too.
    bool asks_at_page() {
        if (!shows_start_page() || asks()) return false;
        session_.view().question = SessionQuestion::end;
        return true;
    }

    Situation situation() const {
        if (shows_start_page()) return Situation::starting;
        const bool plays = source_.player() != nullptr;
        return plays || session_.elements().controls ? situation_of(drills_, plays) : Situation::waiting;
    }

    /// How many keys went down until one opens the field of a mark's note, if one does.
    std::optional<std::size_t> presses_until_note() const {
        if (has_keyboard() || !session_.link().controls.may_control) return std::nullopt;
        const auto opens = std::ranges::find_if(input_.presses, [&](const KeyPress& press) {
            return std::ranges::count(actions_of(std::array{press.key}, situation()), Action::mark) > 0;
        });
        if (opens == input_.presses.end()) return std::nullopt;
        return static_cast<std::size_t>(opens - input_.presses.begin()) + 1;
    }

    /// The field of a note has been asked for, and Dear ImGui has not given it the keyboard yet.
    bool opens_note_field() {
        if (session_.view().question != SessionQuestion::mark)
            is_note_field_open_ = false;
        else if (ImGui::GetIO().WantTextInput)
            is_note_field_open_ = true;
        return session_.view().question == SessionQuestion::mark && !is_note_field_open_;
    }

    /// A text is being written, or its field is about to open: letters are no commands.
    bool has_keyboard() const {
        return ImGui::GetIO().WantTextInput || session_.view().question == SessionQuestion::mark;
    }

    const RenderOptions& options_;
    SessionSource& source_;
    Window& window_;
    Shared& shared_;
    const Clock::time_point began_ = Clock::now();
    ImguiContext panels_;
    std::optional<StartScreen> start_;
    std::optional<gl::StorageThread> storage_;
    HeldViewMotion held_view_;
    glm::ivec2 view_motion_{0};
    SettingsFile settings_{home_of(options_) / "window.toml"};
    TransferFile look_{options_.look_file, options_.look.transfer};
    SessionPicture session_;
    Commands commands_;
    RecordingCamera camera_{options_, source_.player()};
    SessionSound sound_;
    Screenshots screenshots_;
    FrameTimes frame_times_;
    Redraw redraw_;
    WindowInput input_;
    Clock::time_point drawn_ = began_;
    Clock::time_point view_told_{};
    bool drills_ = false;
    bool had_popup_ = false;  // before this frame, whose ESC closes it
    bool page_stands_alone_ = false;
    bool is_note_field_open_ = false;
    bool session_over_ = false;
};

}  // namespace

RenderReport run_in_window(const RenderOptions& options, SessionSource& source,
                           const std::function<bool()>& stop_requested) {
    Window window(options.window_size_px.value_or(default_size_px), "Osteomill",
                  options.stereo.layout == StereoLayout::quad_buffer);
    Shared shared{.clipboard = Clipboard([&window] { window.wake(); }), .desk = HandInput(source)};
    shared.mailbox.post(window.take_input());
    RenderReport report;
    DrawingThread drawing(shared.is_over, [&] {
        const CurrentContext context(window);
        gl::require_opengl_3_3();
        report = Drawing(options, source, window, shared).run();
    });
    for (Clock::time_point previous = Clock::now(); !shared.is_over && !stop_requested();) {
        if (shared.desk.is_driving()) {
            std::this_thread::sleep_until(previous + driving_period);
            window.read_events(0.0);
        } else {
            window.read_events(longest_wait_s);
            std::this_thread::sleep_until(previous + shortest_period);
        }
        window.fill_screen(shared.is_fullscreen);
        const Clock::time_point now = Clock::now();
        WindowInput input = window.take_input();
        window.serve(shared.clipboard);
        // Pointed at is the left eye's picture, which is the left, or the upper, half of the window.
        if (options.stereo.layout == StereoLayout::side_by_side) input.cursor.x *= 2.0;
        if (options.stereo.layout == StereoLayout::top_bottom) input.cursor.y *= 2.0;
        if (window.take_close_request()) {
            shared.close_requested = true;
            input.has_news = true;
        }
        shared.desk.step(input, std::chrono::duration<double>(now - previous).count());
        shared.mailbox.post(input);
        previous = now;
    }
    if (shared.is_over) window.hide();
    drawing.finish();
    return report;
}

}  // namespace osteomill
