// Controls of a session besides moving the tool, their outcomes, and what can be done now. Plain data; on the
// wire these are the messages SessionControl, SessionEvent and SessionStatus.
#pragma once

#include <cstdint>
#include <string>

#include "common/scene/scene.h"

namespace osteomill {

enum class SessionAction : std::uint8_t {
    none,     ///< a newer program's, which this one does not know
    mark,     ///< this moment, with a note
    pause,    ///< force and spindle off
    resume,   ///< the force comes back once the burr is clear of bone
    undo,     ///< the last slice of a stroke (stroke_span.h); one under way ends with it
    redo,     ///< the slice undone last
    reset,    ///< undoes all slices; each can be redone
    save,     ///< the bone as it is, or its surface
    finish,   ///< ends the session, everything saved
    place,    ///< the tool somewhere else: the patient is moved and turned under the device
    speed,    ///< of the spindle, in place of the burrs' own
    fixture,  ///< one of the scene's is switched on or off, while the session is paused
};

/// For people: "undo".
const char* name_of(SessionAction action);

struct SessionControl {
    static constexpr std::size_t longest_text = 200;  ///< bytes

    SessionAction action = SessionAction::none;
    /// A mark's note; for save ".stl", ".ply" or ".obj" to get the surface; a fixture's name.
    std::string text{};
    ToolPose pose{};           ///< of place: where the burr shall be, patient LPS; the axis is a unit vector
    double spindle_rpm = 0.0;  ///< of speed; 0: each burr's own
    bool is_on = false;        ///< of a fixture

    bool operator==(const SessionControl&) const = default;
};

/// Ten days: a later time in a session is a slip.
inline constexpr double longest_session_s = 864'000.0;

/// Speeds that can be set on a spindle, rev/min, as a scene's burrs have them.
inline constexpr double least_spindle_rpm = 100.0;
inline constexpr double most_spindle_rpm = 500'000.0;
inline bool is_spindle_speed(double rpm) {
    return rpm == 0.0 || (rpm >= least_spindle_rpm && rpm <= most_spindle_rpm);
}

/// Something that was requested has been done, or refused.
struct ControlEvent {
    double time_s = 0.0;  ///< session time
    SessionAction action = SessionAction::none;
    std::string text{};  ///< a mark's note; the tool's place; the bone of an undo; why it was refused
    bool is_refused = false;

    bool operator==(const ControlEvent&) const = default;
};

struct SessionStatus {
    std::uint32_t undo_steps = 0;  ///< slices that can be undone
    std::uint32_t redo_steps = 0;
    bool is_paused = false;
    bool may_control = false;  ///< this client's controls are taken now
    /// Why nothing is recorded at present, one line; empty while all is well, and if nothing is to be.
    std::string recording_problem{};

    bool operator==(const SessionStatus&) const = default;
};

}  // namespace osteomill
