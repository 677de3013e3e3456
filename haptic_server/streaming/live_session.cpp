#include "haptic_server/streaming/live_session.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace osteomill {

namespace {

ToolView view_of(const ToolSnapshot& tool) {
    return {.time_s = tool.time_s,
            .burr_position_mm = tool.burr_pose.position_mm,
            .spindle_axis = tool.burr_pose.spindle_axis,
            .hand_position_mm = tool.hand_pose.position_mm,
            .force_n = tool.force_n,
            .burr = tool.burr,
            .spindle_on = tool.spindle_on,
            .removed_mm3 = tool.removed_mm3,
            .touches_protected = tool.touches_protected,
            .fault = describe(tool.fault),
            .depth_mm = tool.depth_mm};
}

}  // namespace

SessionInfo session_info(const Scene& scene, bool accepts_operator, double force_limit_n,
                         std::string program_version) {
    return {.scene_name = scene.name,
            .server_version = std::move(program_version),
            .burrs = scene.burrs,
            .tissues = scene.tissues,
            .accepts_operator = accepts_operator,
            .force_limit_n = force_limit_n};
}

ToolView LiveSession::update(BoneReplica& mirror, std::size_t) {
    std::size_t refused = 0;
    edits_.consume_all([&](const EditRun& run) { refused += mirror.apply(run) ? 0 : 1; });
    if (refused > 0) spdlog::error("{} edits do not fit the bone that clients are shown", refused);
    tool_.refresh();
    return view_of(tool_.front());
}

}  // namespace osteomill
