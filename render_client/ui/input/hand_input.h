// The operator's controls, on the thread that reads mouse and keyboard: turns their input into commands of
// the hand and sends them, at a rate of its own.
//
// Reason for its own thread: the server stops the spindle after 0.2 s without a message from the operator
// (simulation/device/permission.h). A picture that takes half a second must not count as silence, nor may a
// released pedal wait for it; but a program that no longer reads its mouse must fall silent, so no other
// thread may send for it. So the window's thread, which alone may read events (a rule of GLFW's), only reads
// and sends; another thread draws.
//
// The tool's state comes straight from the link, not from the last picture.
#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "render_client/link/session_source.h"
#include "render_client/ui/input/operator_hand.h"
#include "render_client/ui/input/window_input.h"
#include "render_client/volume/camera.h"

namespace osteomill {

/// State of the picture that the hand needs.
struct HandInputPicture {
    bool drills = false;  ///< there is a session that an operator may drill in
    std::size_t burr_count = 0;
    double reach_mm = longest_reach_mm;  ///< the hand's reach from the burr
    Camera camera{};
    glm::ivec2 size_px{1, 1};
    /// A panel has the mouse, or is about to: Dear ImGui learns the pointer's position a frame later.
    bool panels_have_mouse = false;
    std::vector<PixelBox> panels{};     ///< y down
    bool panels_have_keyboard = false;  ///< a text is being written
    /// A position with the burr clear of the bone under the cursor, patient LPS; nothing beside the bone.
    std::optional<glm::dvec3> over_bone_mm{};
    double wheel_step_mm = 0.1;  ///< along the spindle, of a notch
    bool drag_tilts = false;     ///< the mouse tilts the handpiece instead of moving it
    bool is_clutched = false;    ///< mouse and keys move the bone: the hand lets go
    bool holds_still = false;    ///< the session is paused: a pedal that was left down comes up
};

class HandInput {
  public:
    /// The source outlives it.
    explicit HandInput(SessionSource& source) : source_(source) {}

    /// Thread of the window, 50 times a second or more while is_driving(): takes the input since the last
    /// step, and sends the hand's command.
    void step(const WindowInput& input, double elapsed_s);
    /// Thread of the window: whether the hand has asked for the tool.
    bool is_driving() const { return had_tool_; }

    /// These: any thread.
    void show(const HandInputPicture& picture);
    /// The pedal of an operator who has only a mouse: down until it is switched up.
    void switch_pedal();
    void choose_burr(std::size_t burr);
    /// Releases the tool, which was placed elsewhere.
    void release();
    void choose_next_burr();
    void choose_previous_burr();
    /// The hand's command; nothing without the right to drill.
    std::optional<OperatorCommand> command() const;

  private:
    void let_go();
    bool panels_have(const WindowInput& input) const;
    /// Heeds no key from the press on that opens the field of a mark's note, until the picture says whether
    /// it is open: what is typed at once is the note's.
    void wait_for_note(const WindowInput& input);
    void move_hand(const WindowInput& input, double elapsed_s);

    SessionSource& source_;
    mutable std::mutex mutex_;  // guards the members below; held for microseconds
    HandInputPicture picture_;
    OperatorHand hand_;
    int shows_until_note_ = 0;  ///< calls of show() until the field of a note must be open
    bool pedal_switched_down_ = false;
    int pedal_switches_ = 0;  ///< one a step takes effect: the server hears of each
    bool drags_hand_ = false;
    double deeper_mm_ = 0.0;  ///< than over the bone, since the drag began

    // Thread of the window.
    glm::dvec2 cursor_{0.0};
    bool had_tool_ = false;
    bool space_was_down_ = false;
};

}  // namespace osteomill
