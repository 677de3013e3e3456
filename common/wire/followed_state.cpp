#include "common/wire/followed_state.h"

#include <utility>

#include "common/wire/control_messages.h"
#include "common/wire/scene_messages.h"
#include "common/wire/structure_messages.h"

namespace osteomill {

std::variant<FollowedState, WireError> follow(const v1::StateFrame& frame, const SessionInfo& session,
                                              BoneReplica& replica) {
    auto tool = tool_from(frame.tool(), session.burrs.size());
    if (auto* error = std::get_if<WireError>(&tool)) return std::move(*error);
    auto events = control_events_from(frame.events());
    if (auto* error = std::get_if<WireError>(&events)) return std::move(*error);
    auto distances = structure_distances_from(frame.distances(), session.tissues.size());
    if (auto* error = std::get_if<WireError>(&distances)) return std::move(*error);
    FollowedState followed{.tool = std::get<ToolState>(std::move(tool)),
                           .events = std::get<std::vector<ControlEvent>>(std::move(events)),
                           .status = session_status_from(frame.status()),
                           .distances = std::get<std::vector<StructureDistance>>(std::move(distances))};
    for (const v1::BrickEdit& edit : frame.edits()) {
        auto written = replica.correct(edit);
        if (auto* error = std::get_if<WireError>(&written)) return std::move(*error);
        if (std::get<EditEffect>(written) == EditEffect::raises) followed.has_regained_bone = true;
    }
    for (const v1::BrickEdit& edit : frame.restored())
        if (auto error = replica.restore(edit)) return *std::move(error);
    if (frame.bone_checksum() != 0)
        followed.check =
            frame.bone_checksum() == replica.checksum() ? ReplicaCheck::equal : ReplicaCheck::differs;
    return followed;
}

}  // namespace osteomill
