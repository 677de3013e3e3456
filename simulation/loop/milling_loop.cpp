#include "simulation/loop/milling_loop.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "common/text/append.h"
#include "simulation/force_models/ball_rows.h"

namespace osteomill {

std::string MillingSample::header_line() {
    return "t_s,burr_x_mm,burr_y_mm,burr_z_mm,force_x_n,force_y_n,force_z_n,removed_mm3,spindle\n";
}

void MillingSample::append_to(fmt::memory_buffer& text) const {
    append_formatted(text, "{:.5f},{:.5f},{:.5f},{:.5f},{:.6f},{:.6f},{:.6f},{:.8f},{:d}\n", time_s,
                     burr_mm.x, burr_mm.y, burr_mm.z, force_n.x, force_n.y, force_n.z, removed_mm3,
                     spindle_on ? 1 : 0);
}

namespace {

/// For the rounding of sums of periods, s.
constexpr double time_tolerance_s = 1e-7;

}  // namespace

MillingLoop::MillingLoop(const MillingLoopParts& parts, double command_period_s)
    : parts_(parts),
      command_period_s_(command_period_s),
      cut_(std::vector<Burr>(parts.burrs.begin(), parts.burrs.end()), parts.motor) {
    for (const Burr& burr : parts.burrs) hulls_.push_back(burr_hull(burr));
}

MillingLoop::MillingLoop(const MillingLoop& other, const MillingLoopParts& parts) : MillingLoop(other) {
    // References are not assigned, but made.
    std::destroy_at(&parts_);
    std::construct_at(&parts_, parts);
}

ToolPose MillingLoop::pose_on_the_way(double elapsed_s) noexcept {
    const ToolPose& target = parts_.commands.front().pose;
    const double left_s = command_period_s_ - underway_s_;
    underway_s_ += elapsed_s;
    if (elapsed_s >= left_s - time_tolerance_s) return target;
    const double share = underway_s_ / command_period_s_;
    const glm::dvec3 axis = glm::mix(start_.spindle_axis, target.spindle_axis, share);
    const double length = glm::length(axis);
    return {glm::mix(start_.position_mm, target.position_mm, share),
            length > 0.5 ? axis / length : target.spindle_axis};
}

double MillingLoop::room_for_change_mm(const BurrCommand& command) const noexcept {
    const std::size_t count = parts_.burrs.size();
    const std::size_t wanted = command.wanted_burr.value_or(count);
    if (wanted >= count || command.burr >= count || command.spindle_on) return 0.0;
    const Grid& grid = parts_.model.bone().grid();
    const double room_mm = grid.spacing_mm + 2.0 * glm::distance(command.pose.position_mm, published_mm_);
    if (!(room_mm <= most_room_mm)) return 0.0;
    const auto meets_bone = [&](const HullBall& ball) {
        const glm::dvec3 centre_mm = command.pose.position_mm + ball.height_mm * command.pose.spindle_axis;
        return has_bone_in(parts_.model.bone(), {to_voxel_coordinates(grid, centre_mm),
                                                 (ball.radius_mm + room_mm) / grid.spacing_mm});
    };
    const bool is_free = std::ranges::none_of(hulls_[wanted], meets_bone) &&
                         std::ranges::none_of(hulls_[command.burr], meets_bone);
    return is_free ? room_mm : 0.0;
}

void MillingLoop::restore(double elapsed_s) noexcept {
    if (parts_.restored == nullptr || parts_.commands.front().spindle_on) return;
    const double most =
        std::clamp(restored_bricks_per_ms * 1e3 * elapsed_s, 1.0, 10.0 * restored_bricks_per_ms);
    const std::size_t count = parts_.restored->consume_all(
        [this](const BrickChange& change, BrickFractions fractions) {
            parts_.model.restore(change, fractions, parts_.changes);
        },
        static_cast<std::size_t>(most));
    if (count == 0) return;
    restored_changes_ += count;
    parts_.gate->restored_changes.fetch_add(count, std::memory_order_release);
}

void MillingLoop::note_step(std::uint64_t command, std::uint64_t missed) noexcept {
    StepRun& newest = newest_runs_.back();
    if (newest.count > 0 && newest.command == command && missed == 0) {
        ++newest.count;
        return;
    }
    std::shift_left(newest_runs_.begin(), newest_runs_.end(), 1);
    newest_runs_.back() = {.command = command, .missed = missed, .count = 1};
}

void MillingLoop::report_cut(const MillingResult& result, double speed_share) noexcept {
    cut_.add(result, elapsed_s_);
    if (!cut_.is_due()) return;
    parts_.cuts->back() = cut_.take(result, speed_share);
    parts_.cuts->publish();
}

void MillingLoop::step(double time_s, double elapsed_s, std::uint64_t missed) noexcept {
    if (parts_.commands.refresh()) {
        if (!has_command_) pose_ = parts_.commands.front().pose;
        has_command_ = true;
        start_ = pose_;
        underway_s_ = 0.0;
    }
    if (!has_command_) {
        idle_periods_ += 1 + missed;
        return;
    }
    const bool was_underway = underway_s_ < command_period_s_ - time_tolerance_s;
    BurrCommand command = parts_.commands.front();
    command.pose = pose_ = pose_on_the_way(elapsed_s);
    command.elapsed_s = elapsed_s;
    elapsed_s_ += elapsed_s;
    // A result when the burr has arrived; and where commands stay away, still one for each of theirs.
    const bool has_arrived = was_underway && underway_s_ >= command_period_s_ - time_tolerance_s;
    const bool publishes = has_arrived || elapsed_s_ >= 1.5 * command_period_s_ ||
                           elapsed_s >= command_period_s_ - time_tolerance_s;
    command.wants_engagement = publishes;

    note_step(command.tick, missed + std::exchange(idle_periods_, 0));
    restore(elapsed_s);
    MillingResult& result = parts_.results.back();
    parts_.model.step(command, time_s, parts_.changes, result);
    parts_.changes.resend_overflowed(parts_.model.bone());
    if (parts_.log != nullptr)
        parts_.log->push({.time_s = time_s,
                          .burr_mm = command.pose.position_mm,
                          .force_n = result.force_n,
                          .removed_mm3 = result.removed_mm3,
                          .spindle_on = result.spindle_on});

    impulse_n_s_ += result.force_n * elapsed_s;
    removed_mm3_ += result.removed_mm3;
    total_removed_mm3_ = result.total_removed_mm3;
    touches_protected_ |= result.touches_protected;
    if (!publishes && result.valid) return;
    if (elapsed_s_ > elapsed_s) {
        result.force_n = impulse_n_s_ / elapsed_s_;
        result.removed_mm3 = removed_mm3_;
        result.touches_protected = touches_protected_;
    }
    result.restored_changes = restored_changes_;
    result.wanted_burr = command.wanted_burr;
    result.newest_runs = newest_runs_;
    result.room_for_change_mm = room_for_change_mm(command);
    published_mm_ = command.pose.position_mm;
    if (parts_.cuts != nullptr) report_cut(result, command.speed_share);
    parts_.results.publish();
    elapsed_s_ = removed_mm3_ = 0.0;
    impulse_n_s_ = glm::dvec3(0.0);
    touches_protected_ = false;
}

}  // namespace osteomill
