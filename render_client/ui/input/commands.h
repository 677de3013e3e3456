// Commands that a key gives once: to the view, the operator's desk, the player, and for pictures in files.
#pragma once

#include <filesystem>
#include <string>

#include "render_client/ui/input/hand_input.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/view/bone_clutch.h"
#include "render_client/ui/view/picture_export.h"
#include "render_client/ui/view/session_picture.h"

namespace osteomill {

class Commands {
  public:
    /// Pictures go into `pictures_folder`; an empty one is the current folder.
    Commands(SessionPicture& session, HandInput& desk, SessionSource& source,
             const std::filesystem::path& pictures_folder);

    void take(Action action);
    /// Passes on what was requested with buttons.
    void take(const SessionRequests& requests);
    /// Where the burr stands clear of the bone that is seen at a pixel, the handpiece upright on it; nothing
    /// beside the bone, and without a tool.
    std::optional<ToolPose> over_bone(const glm::dvec2& pixel) const;
    /// Puts the tool there, the handpiece as it is or upright on the bone; a click beside it does nothing.
    void place_at(const glm::dvec2& pixel, bool upright);
    /// Before and after each frame: takes hold of the tool while the bone is moved under it, and has it
    /// placed when that is over. Meanwhile the session is paused.
    void work_clutch();
    /// Whether mouse and keys move the bone.
    bool is_clutched() const { return clutch_.is_held(); }
    /// Turns the bone about the burr, which stays where it is.
    void turn_bone(double azimuth_change_rad, double elevation_change_rad);
    /// Says what came of what was asked of the session.
    void tell(const std::vector<ControlEvent>& events, double now_s);
    /// Call after each frame: writes what was requested, and says so, or what went wrong, for a few seconds.
    void write_pictures(const gl::Framebuffer& picture, double now_s);

    bool end_wanted() const { return end_wanted_; }
    /// Whoever wants to end has to say so again, where a session goes on.
    void ask_to_end();
    /// Whether every frame is written, so that they have to come.
    bool is_exporting() const { return export_wanted_; }

    /// One line, for a few seconds.
    void say(std::string notice, double now_s);

  private:
    void ask(SessionAction action);
    /// Of the spindle.
    void change_speed(double factor);

    SessionPicture& session_;
    HandInput& desk_;
    SessionSource& source_;
    RecordingPlayer* player_;  // null where no recording is shown
    PictureExport pictures_;
    BoneClutch clutch_;
    bool clutch_paused_ = false;    // the session, which goes on afterwards
    bool waits_for_place_ = false;  // what was requested is shown until the server has answered
    bool picture_wanted_ = false;
    bool export_wanted_ = false;
    bool end_wanted_ = false;
    double notice_until_s_ = 0.0;
};

}  // namespace osteomill
