#include "render_client/ui/input/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "common/words/translation.h"
#include "render_client/link/recording_player.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/surface_points.h"

namespace osteomill {

namespace {

/// A burr is lifted out two or three frames of the server's after the bone came back.
constexpr double lift_follows_s = 2.0;

const char* words_for(SessionAction done) {
    const std::array words{std::pair{SessionAction::mark, tr("marked")},
                           std::pair{SessionAction::resume, tr("the session goes on")},
                           std::pair{SessionAction::undo, tr("undone, given back:")},
                           std::pair{SessionAction::redo, tr("redone, taken again:")},
                           std::pair{SessionAction::reset, tr("all undone, given back:")},
                           std::pair{SessionAction::save, tr("the server saves the bone")},
                           std::pair{SessionAction::finish, tr("the session ends;")},
                           std::pair{SessionAction::place, tr("the tool is")},
                           std::pair{SessionAction::speed, tr("the spindle's speed:")},
                           std::pair{SessionAction::fixture, tr("help by force:")}};
    for (const auto& [action, word] : words)
        if (action == done) return word;
    return tr("the server did what this program does not know");
}

/// Translates "on" and "off" behind a name, which stays as it is: "NAME: on".
std::string switched_words(const std::string& text) {
    const std::size_t end = text.rfind(' ');
    return end == std::string::npos ? text : text.substr(0, end + 1) + tr(text.substr(end + 1));
}

bool gives_bone_back(SessionAction action) {
    return action == SessionAction::undo || action == SessionAction::reset;
}

/// In the window's language.
std::string words_of(const ControlEvent& event) {
    if (event.action == SessionAction::mark) return event.text;
    if (event.action == SessionAction::fixture && !event.is_refused) return switched_words(event.text);
    // The others of these have names of files.
    const bool has_only_numbers = gives_bone_back(event.action) || event.action == SessionAction::redo ||
                                  event.action == SessionAction::place ||
                                  event.action == SessionAction::speed;
    const std::string text = tr_filled(event.text);
    return has_only_numbers ? with_decimal_sign(text) : text;
}

}  // namespace

std::string ControlNotices::notice_of(const ControlEvent& event, double now_s) {
    const std::string text = words_of(event);
    if (event.is_refused) return trf("no {}: {}", tr(name_of(event.action)), text);
    if (event.action == SessionAction::pause) return {};
    std::string notice = fmt::format("{} {}", words_for(event.action), text);
    const std::string before = std::exchange(came_back_, {});
    if (gives_bone_back(event.action)) {
        came_back_ = notice;
        came_back_s_ = now_s;
    } else if (event.action == SessionAction::place && !before.empty() &&
               now_s - came_back_s_ <= lift_follows_s) {
        notice = before + "; " + notice;
    }
    return notice;
}

namespace {

constexpr double seek_s = 5.0;
constexpr double notice_s = 4.0;
/// Between a burr that is placed and the bone under it.
constexpr double gap_mm = 1.0;

/// Actions that switch a setting on and off.
constexpr std::array switches{std::pair{Action::help, &ViewSettings::help_shown},
                              std::pair{Action::panels, &ViewSettings::panels_shown},
                              std::pair{Action::cuts_panel, &ViewSettings::cuts_panel_shown},
                              std::pair{Action::transfer_panel, &ViewSettings::transfer_panel_shown},
                              std::pair{Action::slices, &ViewSettings::slices_shown},
                              std::pair{Action::light_field, &ViewSettings::light_field},
                              std::pair{Action::sound, &ViewSettings::sound},
                              std::pair{Action::warnings, &ViewSettings::warns},
                              std::pair{Action::details, &ViewSettings::details_shown},
                              std::pair{Action::fullscreen, &ViewSettings::is_fullscreen},
                              std::pair{Action::tilt, &ViewSettings::drag_tilts}};

/// Actions that first ask a question, if the user may control the session.
constexpr std::array questions{std::pair{Action::save_surface, SessionQuestion::surface},
                               std::pair{Action::mark, SessionQuestion::mark},
                               std::pair{Action::finish, SessionQuestion::finish}};

}  // namespace

Commands::Commands(SessionPicture& session, HandInput& desk, SessionSource& source,
                   const std::filesystem::path& pictures_folder)
    : session_(session),
      desk_(desk),
      source_(source),
      player_(source.player()),
      pictures_(pictures_folder.empty() ? std::filesystem::path(".") : pictures_folder) {}

void Commands::take(Action action) {
    ViewSettings& view = session_.view();
    for (const auto& [switching, is_on] : switches)
        if (action == switching) view.*is_on = !(view.*is_on);
    for (const auto& [asking, question] : questions)
        if (action == asking && session_.link().controls.may_control) view.question = question;
    switch (action) {
        case Action::theme:
            view.theme = other_theme(view.theme);
            break;
        case Action::cut_x:
        case Action::cut_y:
        case Action::cut_z:
        case Action::cut_view:
            view.cuts.step(static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::cut_x),
                           session_.camera());
            break;
        case Action::first_view:
            session_.reset_camera();
            break;
        case Action::magnify:
        case Action::widen:
            magnify_by_step(session_.camera(), action == Action::magnify);
            break;
        case Action::inset:
            view.inset = static_cast<InsetKind>((static_cast<int>(view.inset) + 1) % 3);
            break;
        case Action::screenshot:
            picture_wanted_ = true;
            break;
        case Action::export_frames:
            export_wanted_ = !export_wanted_;
            break;
        case Action::end:
            view.question == SessionQuestion::none ? ask_to_end()
                                                   : void(view.question = SessionQuestion::none);
            break;
        case Action::place:
            view.click_places = !view.click_places && session_.link().controls.may_control;
            break;
        case Action::move_bone:
            view.moves_bone = !view.moves_bone && session_.link().controls.may_control;
            break;
        case Action::undo:
            ask(SessionAction::undo);
            break;
        case Action::redo:
            ask(SessionAction::redo);
            break;
        case Action::hold:
            ask(session_.link().controls.is_paused ? SessionAction::resume : SessionAction::pause);
            break;
        case Action::save:
            ask(SessionAction::save);
            break;
        case Action::next_burr:
            desk_.choose_next_burr();
            break;
        case Action::previous_burr:
            desk_.choose_previous_burr();
            break;
        case Action::faster:
            change_speed(1.1);
            break;
        case Action::slower:
            change_speed(1.0 / 1.1);
            break;
        case Action::play_or_pause:
            player_->is_playing() ? player_->pause() : player_->play();
            break;
        case Action::back_5_s:
            player_->seek(player_->time_s() - seek_s);
            break;
        case Action::on_5_s:
            player_->seek(player_->time_s() + seek_s);
            break;
        default:
            break;
    }
}

void Commands::ask(SessionAction action) {
    source_.send_control({action});
}

void Commands::change_speed(double factor) {
    const auto& tool = session_.tool();
    const SessionInfo* scene = source_.session();
    const Burr* burr = tool && scene ? scene->burr_of(tool->burr) : nullptr;
    if (burr == nullptr) return;
    const double rpm = factor * spindle_rpm(*tool, *burr);
    source_.send_control({.action = SessionAction::speed,
                          .spindle_rpm = std::clamp(rpm, least_spindle_rpm, most_spindle_rpm)});
}

void Commands::ask_to_end() {
    const bool goes_on = player_ == nullptr && session_.link().status == LinkStatus::live;
    if (goes_on)
        session_.view().question = SessionQuestion::end;
    else
        end_wanted_ = true;
}

void Commands::take(const SessionRequests& requests) {
    for (const Action action : requests.actions) take(action);
    for (const SessionControl& control : requests.controls) source_.send_control(control);
    if (requests.burr) desk_.choose_burr(*requests.burr);
    if (requests.switches_pedal) desk_.switch_pedal();
    end_wanted_ = end_wanted_ || requests.ends_program;
}

std::optional<ToolPose> Commands::over_bone(const glm::dvec2& pixel) const {
    const Bone* bone = source_.bone();
    const auto& tool = session_.tool();
    if (bone == nullptr || !tool) return std::nullopt;
    const auto found =
        pick_surface(*bone, session_.camera(), pixel, session_.size_px(), session_.view().cuts.planes());
    if (!found) return std::nullopt;
    const SessionInfo* scene = source_.session();
    const Burr* burr = scene ? scene->burr_of(tool->burr) : nullptr;
    const double radius_mm = burr ? burr->radius_mm() : 0.0;
    return ToolPose{found->position_mm + (radius_mm + gap_mm) * found->normal, found->normal};
}

void Commands::place_at(const glm::dvec2& pixel, bool upright) {
    std::optional<ToolPose> pose = over_bone(pixel);
    if (!pose) return;
    session_.view().click_places = false;
    if (!upright) pose->spindle_axis = session_.tool()->spindle_axis;
    source_.send_control({.action = SessionAction::place, .pose = *pose});
}

void Commands::work_clutch() {
    ViewSettings& view = session_.view();
    const LinkUpdate& link = session_.link();
    const auto& tool = session_.tool();
    const bool can = link.status == LinkStatus::live && link.controls.may_control && tool;
    if (view.moves_bone && !can) view.moves_bone = false;
    if (view.moves_bone && !clutch_.is_held()) {
        clutch_.hold(session_.camera(), {tool->burr_position_mm, tool->spindle_axis});
        clutch_paused_ = !link.controls.is_paused;
        if (clutch_paused_) ask(SessionAction::pause);
    }
    if (!clutch_.is_held()) {
        // Nobody answers any more.
        if (link.status != LinkStatus::live && std::exchange(waits_for_place_, false))
            session_.show_tool_at(std::nullopt);
        return;
    }
    const ToolPose pose = clutch_.pose(session_.camera());
    session_.show_tool_at(pose);
    if (view.moves_bone) return;
    waits_for_place_ = can && clutch_.has_moved(session_.camera());
    clutch_.let_go();
    if (waits_for_place_)
        source_.send_control({.action = SessionAction::place, .pose = pose});
    else
        session_.show_tool_at(std::nullopt);
    if (clutch_paused_ && link.status == LinkStatus::live) ask(SessionAction::resume);
}

void Commands::turn_bone(double azimuth_change_rad, double elevation_change_rad) {
    Camera& camera = session_.camera();
    const glm::dvec3 before_mm = clutch_.pose(camera).position_mm;
    orbit(camera, azimuth_change_rad, elevation_change_rad);
    camera.target_mm += before_mm - clutch_.pose(camera).position_mm;
}

void Commands::tell(const std::vector<ControlEvent>& events, double now_s) {
    for (const ControlEvent& event : events) {
        // The hand would pull the tool back to where it was.
        if (event.action == SessionAction::place && !event.is_refused) desk_.release();
        if (event.action == SessionAction::place && std::exchange(waits_for_place_, false) &&
            !clutch_.is_held())
            session_.show_tool_at(std::nullopt);
        say(notices_.notice_of(event, now_s), now_s);
    }
}

void Commands::write_pictures(const gl::Framebuffer& picture, double now_s) {
    try {
        if (std::exchange(picture_wanted_, false))
            say(trf("written: {}", pictures_.write(picture.read_back()).string()), now_s);
        if (export_wanted_ && !pictures_.is_exporting())
            say(trf("writing every frame into {} until {}", pictures_.begin_frames().string(),
                    key_of(Action::export_frames)),
                now_s);
        if (!export_wanted_ && pictures_.is_exporting()) {
            pictures_.end_frames();
            say(tr("no more frames are written"), now_s);
        }
        if (pictures_.is_exporting()) pictures_.add_frame(picture.read_back(), now_s);
    } catch (const std::runtime_error& error) {
        export_wanted_ = false;
        pictures_.end_frames();
        say(error.what(), now_s);
    }
    if (now_s > notice_until_s_) session_.view().notice.clear();
}

void Commands::say(std::string notice, double now_s) {
    session_.view().notice = std::move(notice);
    notice_until_s_ = now_s + notice_s;
}

}  // namespace osteomill
