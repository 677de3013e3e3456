#include "devices/tracker/tracked_tool.h"

#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

TrackedTool::TrackedTool(TrackerReceiver::Parts parts, TrackedHandpiece handpiece, const ToolPose& start_pose)
    : handpiece_(std::move(handpiece)), clock_s_(parts.now_s), receiver_([&] {
          parts.pedal = handpiece_.pedal;
          return std::move(parts);
      }()) {
    state_.position_mm = start_pose.position_mm;
    state_.spindle_axis = start_pose.spindle_axis;
}

void TrackedTool::take(const TrackerReceiver::Item& item, double now_s) noexcept {
    if (item.is_pedal) {
        pedal_ = {.is_down = item.is_down,
                  .said_s = said_at(now_s, clock_s_() - item.said_s),
                  .speaker = item.connection};
        return;
    }
    const TrackerSample& sample = item.sample;
    motion_.take({.stamp_s = sample.stamp_s,
                  .arrival_s = now_s,
                  .position_mm = sample.position_mm + sample.turn * handpiece_.burr_centre_mm,
                  .turn = sample.turn});
}

const char* TrackedTool::notice() const noexcept {
    const char* const of_the_link = receiver_.notice();
    if (*of_the_link != '\0') return of_the_link;
    switch (clock_fault_.load(std::memory_order_relaxed)) {
        case SampledMotion::ClockFault::none:
            return "";
        case SampledMotion::ClockFault::ahead:
            return "the tracker's clock runs faster than this machine's, or has jumped: the tool is not "
                   "followed";
        case SampledMotion::ClockFault::behind:
            return "the tracker's samples come later and later, or its clock runs slower than "
                   "this machine's: the tool is not followed";
    }
    return "";
}

DeviceState TrackedTool::read(double now_s) noexcept {
    TrackerReceiver::Item item;
    while (receiver_.pop(item)) take(item, now_s);
    const std::optional<SampledMotion::Pose> pose = motion_.at(now_s);
    clock_fault_.store(motion_.clock_fault(), std::memory_order_relaxed);
    state_.connected = pose.has_value();
    state_.velocity_mm_per_s = glm::dvec3(0.0);
    if (pose) {
        state_.position_mm = pose->position_mm;
        state_.velocity_mm_per_s = pose->velocity_mm_per_s;
        state_.spindle_axis = pose->turn * handpiece_.spindle_axis;
        if (!was_there_) came_back_s_ = now_s;
    }
    was_there_ = pose.has_value();
    if (handpiece_.pedal.empty()) {
        state_.pedal = {.is_down = now_s - came_back_s_ >= released_s, .said_s = now_s};
    } else {
        state_.pedal = pedal_;
        state_.pedal.acts_after_s = motion_.delay_s();
    }
    return state_;
}

}  // namespace osteomill
