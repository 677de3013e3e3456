#include "studies/render/phantom_session.h"

#include <cmath>
#include <utility>

#include "imaging/case/bone_source.h"
#include "imaging/phantoms/phantom.h"
#include "studies/swept_changes.h"

namespace osteomill {

namespace {

constexpr double frame_s = 1.0 / 30.0;
constexpr double feed_mm_per_s = 6.0;
constexpr double circle_radius_mm = 1.5;
constexpr std::size_t five_mm_burr = 5;

}  // namespace

Bone phantom_bone(const std::string& phantom) {
    return load_bone(phantom_scene(phantom)).bone;
}

PhantomSession::PhantomSession(const std::string& phantom) : bone_(phantom_bone(phantom)) {
    const Scene scene = phantom_scene(phantom);
    middle_mm_ = scene.trajectory.start_mm;
    info_.scene_name = scene.name;
    info_.burrs = scene.burrs;
    info_.tissues = scene.tissues;
    tool_.burr = five_mm_burr;
    tool_.spindle_on = true;
    tool_.burr_position_mm = middle_mm_ + glm::dvec3(circle_radius_mm, 0.0, 2.0);
    tool_.force_n = {0.3, -0.2, 0.8};
}

void PhantomSession::step() {
    changes_.clear();
    tool_.time_s += frame_s;
    if (!mills_) return;
    const glm::dvec3 from_mm = tool_.burr_position_mm;
    way_mm_ += feed_mm_per_s * frame_s;
    const double angle_rad = way_mm_ / circle_radius_mm;
    // 0.5 mm deeper a turn: there is bone ahead at every step.
    const double sunk_mm = way_mm_ / (2.0 * 3.14159265358979 * circle_radius_mm) * 0.5;
    tool_.burr_position_mm = middle_mm_ + glm::dvec3(circle_radius_mm * std::cos(angle_rad),
                                                     circle_radius_mm * std::sin(angle_rad), 2.0 - sunk_mm);
    changes_ = study::swept_changes(bone_, from_mm, tool_.burr_position_mm,
                                    0.5 * info_.burrs[five_mm_burr].diameter_mm);
}

LinkUpdate PhantomSession::poll() {
    LinkUpdate update;
    update.status = LinkStatus::live;
    update.status_line = "benchmark";
    update.bone_replaced = std::exchange(first_, false);
    update.frames_per_s = 30.0;
    update.tool = tool_;
    update.changes = std::exchange(changes_, {});
    return update;
}

}  // namespace osteomill
