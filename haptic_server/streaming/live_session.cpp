#include "haptic_server/streaming/live_session.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace osteomill {

SessionInfo session_info(const Scene& scene, bool accepts_operator, double force_limit_n,
                         std::string program_version) {
    return {.scene_name = scene.name,
            .server_version = std::move(program_version),
            .burrs = scene.burrs,
            .tissues = scene.tissues,
            .accepts_operator = accepts_operator,
            .force_limit_n = force_limit_n};
}

ToolState LiveSession::update(BoneReplica& mirror, std::size_t) {
    std::size_t refused = 0;
    changes_.consume_all([&](const BrickChange& change, BrickFractions fractions) {
        refused += mirror.apply(change, fractions) ? 0 : 1;
    });
    if (refused > 0) spdlog::error("{} changes do not fit the bone that clients are shown", refused);
    tool_.refresh();
    return tool_.front();
}

}  // namespace osteomill
