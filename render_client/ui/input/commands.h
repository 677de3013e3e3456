// Commands given by single key presses: to the view, the session, the player, and for pictures in files.
#pragma once

#include <filesystem>
#include <string>

#include "common/session/session_control.h"
#include "render_client/ui/input/hand_input.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/view/bone_clutch.h"
#include "render_client/ui/view/picture_export.h"
#include "render_client/ui/view/session_picture.h"

namespace osteomill {

/// The lines of a window on the outcome of requests to the session, in its language.
class ControlNotices {
  public:
    /// The line for an event that the window hears of at `now_s`; empty for a pause, which is said for as
    /// long as it lasts. A burr that stood in the bone that undo
    /// gave back is lifted out of it, which is an event, too: its line begins with how much came back.
    std::string notice_of(const ControlEvent& event, double now_s);

  private:
    std::string came_back_;
    double came_back_s_ = 0.0;
};

class Commands {
  public:
    /// Pictures go into `pictures_folder`; an empty one is the current folder.
    Commands(SessionPicture& session, HandInput& desk, SessionSource& source,
             const std::filesystem::path& pictures_folder);

    void take(Action action);
    /// Sends the requests made with buttons.
    void take(const SessionRequests& requests);
    /// A pose with the burr clear of the bone seen at a pixel, the handpiece upright on it; nothing beside
    /// the bone, and without a tool.
    std::optional<ToolPose> over_bone(const glm::dvec2& pixel) const;
    /// Moves the tool there, with the handpiece as it is or upright on the bone; a click beside the bone does
    /// nothing.
    void place_at(const glm::dvec2& pixel, bool upright);
    /// Before and after each frame: grips the tool while the bone is moved under it, and requests its new
    /// place afterwards. Meanwhile the session is paused.
    void work_clutch();
    /// Whether mouse and keys move the bone.
    bool is_clutched() const { return clutch_.is_held(); }
    /// Turns the bone about the burr, which stays where it is.
    void turn_bone(double azimuth_change_rad, double elevation_change_rad);
    /// Shows the outcome of requests to the session.
    void tell(const std::vector<ControlEvent>& events, double now_s);
    /// Call after each frame: writes the requested pictures, and shows a line about success or failure for a
    /// few seconds.
    void write_pictures(const gl::Framebuffer& picture, double now_s);

    bool end_wanted() const { return end_wanted_; }
    /// Ending the program needs a second confirmation while a session goes on.
    void ask_to_end();
    /// Whether every frame is written, so that frames must be drawn without pause.
    bool is_exporting() const { return export_wanted_; }

    /// One line, for a few seconds.
    void say(std::string notice, double now_s);

  private:
    void ask(SessionAction action);
    /// Changes the spindle's speed.
    void change_speed(double factor);

    SessionPicture& session_;
    HandInput& desk_;
    SessionSource& source_;
    RecordingPlayer* player_;  // null if no recording is shown
    PictureExport pictures_;
    ControlNotices notices_;
    BoneClutch clutch_;
    bool clutch_paused_ = false;    // the session, which goes on afterwards
    bool waits_for_place_ = false;  // the requested place is shown until the server has answered
    bool picture_wanted_ = false;
    bool export_wanted_ = false;
    bool end_wanted_ = false;
    double notice_until_s_ = 0.0;
};

}  // namespace osteomill
