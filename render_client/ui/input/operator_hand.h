// A virtual hand, which turns mouse and keys into the wanted pose of the burr.
//
// The hand holds still until it is activated; until then its target follows the tool, so that activation
// never makes the tool jump. No clock, no window: the caller passes the motions.
//
// It comes clear of bone as a hand would. A pull back begins at the burr, however far the hand was pushed
// ahead of one that bone holds back. Where a fault or a pause takes the force off, no wall holds the burr:
// the target goes back to where the burr was last felt, and a little up its shaft, and no nearer to the bone
// along the spindle until the force is there again.
#pragma once

#include <algorithm>
#include <optional>

#include "common/session/operator_command.h"
#include "common/session/tool_state.h"
#include "render_client/volume/camera.h"

namespace osteomill {

class OperatorHand {
  public:
    /// Call before and after each motion: before activation the hand rests on the tool; afterwards the target
    /// is kept within `reach_mm` of the burr, half of that while bone pushes back, so that a returning mouse
    /// moves the tool at once (the server enforces the limit), and a burr index beyond `burr_count` is
    /// lowered to the last.
    void follow(const ToolState& tool, std::size_t burr_count, double reach_mm = longest_reach_mm);

    /// Moves the target in the plane that faces the camera by the pointer's motion (pixels, y down).
    void move_in_picture(const glm::dvec2& moved_px, const Camera& camera, const glm::ivec2& size_px);
    /// Moves the target there: patient LPS.
    void go_to(const glm::dvec3& place_mm);
    /// Moves the target along the spindle; positive is towards the tip, into the bone, where it does nothing
    /// while the force is off. Negative: out of it, from the burr if the target is ahead of that.
    void advance(double distance_mm);
    /// Tilts the handpiece as if its shank followed the pointer.
    void tilt_in_picture(const glm::dvec2& moved_px, const Camera& camera);
    void set_pedal(bool down) { command_.pedal = down; }
    void choose_burr(std::size_t burr);
    void choose_next_burr() { choose_burr(command_.burr + 1); }
    void choose_previous_burr() { choose_burr(command_.burr > 0 ? command_.burr - 1 : 0); }
    /// Releases the tool: pedal up, target back on the tool. For a window that loses focus, a lost server, or
    /// a tool that another client holds.
    void let_go();

    const OperatorCommand& command() const { return command_; }
    /// Whether anything was requested since the release: a client that only watches leaves the tool to
    /// others.
    bool wants_tool() const { return taken_up_ || command_.pedal || burr_chosen_ || tilted_; }

  private:
    OperatorCommand command_;
    glm::dvec3 burr_mm_{0.0};       // where it is,
    glm::dvec3 felt_burr_mm_{0.0};  // and where it was when the hand last felt it
    bool has_force_ = true;
    bool taken_up_ = false;
    bool burr_chosen_ = false;
    bool tilted_ = false;
};

/// How far a notch of the wheel takes the burr along its spindle: so many pixels of the picture, many in air
/// and few at the bone, hence shorter where the picture is magnified. `mm_per_px`: at the burr. `ahead_mm`:
/// from the burr to the bone along the spindle; nothing if none is near.
constexpr double wheel_step_mm(double mm_per_px, std::optional<double> ahead_mm) {
    constexpr double fine_px = 2.0, finest_mm = 0.02, coarsest_at_bone_mm = 0.3;
    constexpr double air_px = 50.0, longest_mm = 3.0;  // half of the hand's greatest lead
    constexpr double share_of_way = 0.3;
    const double fine_mm = std::clamp(fine_px * mm_per_px, finest_mm, coarsest_at_bone_mm);
    const double in_air_mm = std::clamp(air_px * mm_per_px, fine_mm, longest_mm);
    return std::clamp(ahead_mm ? share_of_way * *ahead_mm : in_air_mm, fine_mm, in_air_mm);
}

}  // namespace osteomill
