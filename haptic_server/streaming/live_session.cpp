#include "haptic_server/streaming/live_session.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "common/log/log.h"
#include "common/scene/device_mapping.h"

namespace osteomill {

std::vector<std::string> StructureLog::lines(std::span<const StructureDistance> distances, double time_s) {
    constexpr double left_at = 1.5;
    std::vector<std::string> lines;
    std::vector<bool> is_near(tissues_.size(), false);
    for (const StructureDistance& now : distances) {
        const Tissue& tissue = tissues_[now.tissue];
        const bool was_warned_of = is_warned_of_[now.tissue];
        const double limit_mm = (was_warned_of ? left_at : 1.0) * tissue.warn_mm;
        is_near[now.tissue] = now.touches || (now.distance_mm && *now.distance_mm < limit_mm);
        if (now.touches_so_far > touches_logged_[now.tissue]) {
            touches_logged_[now.tissue] = now.touches_so_far;
            say(lines, fmt::format("the burr touches {} ({:.2f} s; touch {})", tissue.name, time_s,
                                   now.touches_so_far));
        } else if (is_near[now.tissue] && !was_warned_of && !now.touches) {
            say(lines, fmt::format("the burr is {:.2f} mm from {} ({:.2f} s)", *now.distance_mm, tissue.name,
                                   time_s));
        }
    }
    is_warned_of_ = std::move(is_near);
    return lines;
}

void StructureLog::say(std::vector<std::string>& lines, std::string line) {
    if (said_ >= most_lines) return;
    if (++said_ == most_lines) line += "; what follows of structures is left out of the log";
    lines.push_back(std::move(line));
}

SessionInfo session_info(const Scene& scene, bool accepts_operator, double force_limit_n,
                         std::string program_version) {
    return {.scene_name = scene.name,
            .server_version = std::move(program_version),
            .burrs = scene.burrs,
            .tissues = scene.tissues,
            .accepts_operator = accepts_operator,
            .force_limit_n = force_limit_n,
            .reach_mm = ArmScale(scene.device.scale).length_mm(longest_reach_mm),
            .plan = scene.plan,
            .pass = scene.pass,
            .rating = scene.rating,
            .fixtures = scene.fixtures};
}

void LiveSession::watch(StructureWatch structures, std::vector<Tissue> tissues) {
    structures_ = std::move(structures);
    structure_log_.emplace(std::move(tissues));
}

SessionState LiveSession::update(BoneReplica& mirror, std::size_t) {
    std::size_t refused = 0;
    if (controls_ != nullptr) controls_->begin_frame();
    changes_.consume_all([&](const BrickChange& change, BrickFractions fractions) {
        if (controls_ != nullptr) controls_->note(change, mirror.bone());
        if (!structures_.empty()) note_for_structures(change, fractions, mirror.bone());
        refused += mirror.apply(change, fractions) ? 0 : 1;
    });
    if (refused > 0) log_error("{} changes do not fit the bone that clients are shown", refused);
    tool_.refresh();
    SessionState state{.tool = tool_.front()};
    ToolState& tool = state.tool;
    if (cuts_ != nullptr) {
        cuts_->refresh();
        if (tool.spindle_on) tool.cut = cuts_->front();
    }
    if (!structures_.empty()) {
        structures_.update(tool);
        state.distances = structures_.distances();
        for (const std::string& line : structure_log_->lines(structures_.distances(), tool.time_s))
            log_warning("{}", line);
    }
    if (controls_ != nullptr) {
        for (; !script_.empty() && script_.front().time_s <= tool.time_s; script_.pop_front())
            controls_->control(script_.front().control);
        controls_->end_frame(mirror.bone(), tool);
        state.events = controls_->take_events();
        state.status = controls_->status();
    }
    return state;
}

void LiveSession::note_for_structures(const BrickChange& change, BrickFractions after, const Bone& bone) {
    const std::int32_t slot = bone.slot(change.brick);
    if (slot != BoneContent::no_slot)
        structures_.note(change, bone.fractions(slot), after, bone.content().tissues_of(slot));
}

void LiveSession::control(const SessionControl& control) {
    if (controls_ != nullptr) controls_->control(control);
}

std::shared_ptr<const CtVolume> LiveSession::ct() {
    if (ct_ || !make_ct_) return ct_;
    if (!ct_under_way_.valid()) ct_under_way_ = std::async(std::launch::async, make_ct_);
    if (ct_under_way_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return nullptr;
    try {
        ct_ = std::make_shared<const CtVolume>(ct_under_way_.get());
    } catch (const std::exception& error) {
        log_error("the CT cannot be shown: {}", error.what());
        make_ct_ = nullptr;
    }
    return ct_;
}

}  // namespace osteomill
