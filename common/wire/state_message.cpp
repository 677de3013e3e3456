#include "common/wire/state_message.h"

#include <utility>

#include "common/wire/control_messages.h"
#include "common/wire/scene_messages.h"
#include "common/wire/structure_messages.h"
#include "common/wire/viewpoint_message.h"

namespace osteomill {

std::variant<SessionState, WireError> session_state_from(const v2::StateFrame& message,
                                                         std::size_t burr_count, std::size_t tissue_count) {
    auto tool = tool_from(message.tool(), burr_count);
    if (auto* error = std::get_if<WireError>(&tool)) return std::move(*error);
    auto events = control_events_from(message.events());
    if (auto* error = std::get_if<WireError>(&events)) return std::move(*error);
    auto distances = structure_distances_from(message.distances(), tissue_count);
    if (auto* error = std::get_if<WireError>(&distances)) return std::move(*error);
    std::optional<Viewpoint> view;
    if (message.has_view()) {
        auto looked = viewpoint_from(message.view());
        if (auto* error = std::get_if<WireError>(&looked)) return std::move(*error);
        view = std::get<Viewpoint>(looked);
    }
    return SessionState{.tool = std::get<ToolState>(std::move(tool)),
                        .events = std::get<std::vector<ControlEvent>>(std::move(events)),
                        .status = session_status_from(message.status()),
                        .distances = std::get<std::vector<StructureDistance>>(std::move(distances)),
                        .view = view};
}

}  // namespace osteomill
