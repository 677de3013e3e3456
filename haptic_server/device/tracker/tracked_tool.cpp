#include "haptic_server/device/tracker/tracked_tool.h"

#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

TrackedTool::TrackedTool(TrackerReceiver::Parts parts, TrackedHandpiece handpiece, const ToolPose& start_pose)
    : handpiece_(std::move(handpiece)), receiver_([&] {
          parts.pedal = handpiece_.pedal;
          return std::move(parts);
      }()) {
    state_.position_mm = start_pose.position_mm;
    state_.spindle_axis = start_pose.spindle_axis;
}

void TrackedTool::take(const TrackerReceiver::Item& item, double now_s) noexcept {
    if (item.is_pedal) {
        if (!item.is_down || !pedal_.holds(now_s)) is_down_ = false;
        if (item.is_down && !is_down_) pressed_s_ = now_s;
        is_down_ = item.is_down;
        pedal_.renew(now_s);
        return;
    }
    const TrackerSample& sample = item.sample;
    motion_.take({.stamp_s = sample.stamp_s,
                  .arrival_s = now_s,
                  .position_mm = sample.position_mm + sample.turn * handpiece_.burr_centre_mm,
                  .turn = sample.turn});
}

DeviceState TrackedTool::read(double now_s) noexcept {
    TrackerReceiver::Item item;
    while (receiver_.pop(item)) take(item, now_s);
    const std::optional<SampledMotion::Pose> pose = motion_.at(now_s);
    state_.connected = pose.has_value();
    state_.velocity_mm_per_s = glm::dvec3(0.0);
    if (pose) {
        state_.position_mm = pose->position_mm;
        state_.velocity_mm_per_s = pose->velocity_mm_per_s;
        state_.spindle_axis = pose->turn * handpiece_.spindle_axis;
        if (!was_there_) came_back_s_ = now_s;
    }
    was_there_ = pose.has_value();
    state_.pedal = state_.connected && is_pressed(now_s);
    return state_;
}

bool TrackedTool::is_pressed(double now_s) const noexcept {
    if (handpiece_.pedal.empty()) return now_s - came_back_s_ >= released_s;
    return is_down_ && pedal_.holds(now_s) && now_s - pressed_s_ >= motion_.delay_s();
}

}  // namespace osteomill
