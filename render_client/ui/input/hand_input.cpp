#include "render_client/ui/input/hand_input.h"

// GLFW's names of keys.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "render_client/ui/input/key_bindings.h"

namespace osteomill {

namespace {

constexpr double advance_mm_per_s = 2.0;
/// Keys tilt and move it as the mouse would at this speed.
constexpr double keys_px_per_s = 100.0;
/// A held key moves the hand at most for so long at once: a thread that stood still does not catch up.
constexpr double longest_step_s = 0.1;

}  // namespace

void HandInput::step(const WindowInput& input, double elapsed_s) {
    // Without a session of this kind there is nobody who could be sent an operator's requests.
    const std::optional<ToolState> tool = source_.newest_tool();
    std::optional<OperatorCommand> request;
    {
        const std::scoped_lock lock(mutex_);
        if (tool && picture_.drills) {
            // The hand's intent is known only once the hand rests on the tool: an intent of its own making
            // would drag the tool away.
            hand_.follow(*tool, picture_.burr_count, picture_.reach_mm);
            if (input.is_focused && !input.is_minimised && !picture_.is_clutched)
                move_hand(input, std::min(elapsed_s, longest_step_s));
            else
                let_go();
            hand_.follow(*tool, picture_.burr_count, picture_.reach_mm);
            // The last command lifts the pedal; then the tool is free for others.
            if (hand_.wants_tool() || had_tool_) request = hand_.command();
            // The server believes no pedal that it has not seen up. Nothing is sent before the hand wants the
            // tool, so that the first message says it, unless the key was held before, as through a loss of
            // the connection.
            if (request && !had_tool_ && !space_was_down_) request->pedal = false;
            // It may be requested, but must not jump to where this hand has gone meanwhile.
            if (tool->driver == ToolDriver::another) let_go();
        } else {
            let_go();
        }
        had_tool_ = hand_.wants_tool();
    }
    cursor_ = input.cursor;
    space_was_down_ = input.keys_down[GLFW_KEY_SPACE];
    if (request) source_.send_operator(*request);
}

void HandInput::let_go() {
    hand_.let_go();
    pedal_switched_down_ = false;
    pedal_switches_ = 0;
}

bool HandInput::panels_have(const WindowInput& input) const {
    const glm::ivec2 at(input.cursor * input.px_per_unit());
    return picture_.panels_have_mouse || std::ranges::any_of(picture_.panels, [&](const PixelBox& box) {
               const glm::ivec2 inside = at - box.first;
               return inside.x >= 0 && inside.y >= 0 && inside.x < box.size.x && inside.y < box.size.y;
           });
}

void HandInput::wait_for_note(const WindowInput& input) {
    // A picture under way, the next, which takes the key in, and the one that shows the field.
    constexpr int shows = 3;
    const auto actions = actions_of(input.pressed_keys(), Situation::drilling);
    if (std::ranges::count(actions, Action::mark) > 0) shows_until_note_ = shows;
}

void HandInput::move_hand(const WindowInput& input, double elapsed_s) {
    wait_for_note(input);
    if (pedal_switches_ > 0) {
        --pedal_switches_;
        pedal_switched_down_ = !pedal_switched_down_;
    }
    if (picture_.holds_still) pedal_switched_down_ = false;
    if (input.went_down[WindowInput::left]) {
        drags_hand_ = !panels_have(input);
        deeper_mm_ = 0.0;
    }
    const bool has_keyboard = !picture_.panels_have_keyboard && shows_until_note_ == 0;
    const auto is_down = [&](int key) {
        return has_keyboard && input.keys_down[static_cast<std::size_t>(key)];
    };
    double advanced_mm =
        advance_mm_per_s * elapsed_s * (static_cast<double>(is_down(GLFW_KEY_W)) - is_down(GLFW_KEY_S));
    if (!input.ctrl && !input.alt && input.wheel.y != 0.0 && !panels_have(input))
        advanced_mm += picture_.wheel_step_mm * input.wheel.y;
    drags_hand_ = drags_hand_ && input.is_down[WindowInput::left];
    // A spinning burr follows the hand's motion; one that stands, as in air, follows the pointer.
    if (drags_hand_ && !picture_.drag_tilts && !hand_.command().pedal && picture_.over_bone_mm) {
        deeper_mm_ += advanced_mm;
        hand_.go_to(*picture_.over_bone_mm);
        advanced_mm = deeper_mm_;
    } else if (const glm::dvec2 moved_px = (input.cursor - cursor_) * input.px_per_unit();
               drags_hand_ && moved_px != glm::dvec2(0.0)) {
        picture_.drag_tilts ? hand_.tilt_in_picture(moved_px, picture_.camera)
                            : hand_.move_in_picture(moved_px, picture_.camera, picture_.size_px);
    }
    if (advanced_mm != 0.0) hand_.advance(advanced_mm);
    const glm::dvec2 arrows(static_cast<double>(is_down(GLFW_KEY_RIGHT)) - is_down(GLFW_KEY_LEFT),
                            static_cast<double>(is_down(GLFW_KEY_DOWN)) - is_down(GLFW_KEY_UP));
    const glm::dvec2 by_keys_px = keys_px_per_s * elapsed_s * arrows;
    if (arrows != glm::dvec2(0.0))
        input.shift ? hand_.move_in_picture(by_keys_px, picture_.camera, picture_.size_px)
                    : hand_.tilt_in_picture(by_keys_px, picture_.camera);
    const std::vector<int> pressed = input.pressed_keys();
    for (const int key : pressed)
        if (has_keyboard && key >= GLFW_KEY_1 && key <= GLFW_KEY_9)
            hand_.choose_burr(static_cast<std::size_t>(key - GLFW_KEY_1));
    // It came up and went down again since the last step.
    const bool came_up = space_was_down_ && std::ranges::count(pressed, GLFW_KEY_SPACE) > 0;
    hand_.set_pedal((is_down(GLFW_KEY_SPACE) && !came_up) || pedal_switched_down_);
}

void HandInput::show(const HandInputPicture& picture) {
    const std::scoped_lock lock(mutex_);
    picture_ = picture;
    shows_until_note_ = picture.panels_have_keyboard ? 0 : std::max(shows_until_note_ - 1, 0);
}

void HandInput::switch_pedal() {
    const std::scoped_lock lock(mutex_);
    ++pedal_switches_;
}

void HandInput::choose_burr(std::size_t burr) {
    const std::scoped_lock lock(mutex_);
    hand_.choose_burr(burr);
}

void HandInput::release() {
    const std::scoped_lock lock(mutex_);
    let_go();
    drags_hand_ = false;
}

void HandInput::choose_next_burr() {
    const std::scoped_lock lock(mutex_);
    hand_.choose_next_burr();
}

void HandInput::choose_previous_burr() {
    const std::scoped_lock lock(mutex_);
    hand_.choose_previous_burr();
}

std::optional<OperatorCommand> HandInput::command() const {
    const std::scoped_lock lock(mutex_);
    return picture_.drills ? std::optional(hand_.command()) : std::nullopt;
}

}  // namespace osteomill
