#include "render_client/ui/view/session_news.h"

#include <glm/geometric.hpp>

#include "common/session/tool_state.h"

namespace osteomill {

namespace {

bool is_as_drawn(const std::optional<OperatorCommand>& drawn, const std::optional<OperatorCommand>& now) {
    if (drawn.has_value() != now.has_value()) return false;
    return !now || (drawn->pedal == now->pedal &&
                    glm::distance(drawn->hand_target_mm, now->hand_target_mm) <= quiet_motion_mm);
}

}  // namespace

SessionNews news_since(const DrawnSession& drawn, const LinkUpdate& link,
                       const std::optional<ToolState>& tool,
                       const std::optional<OperatorCommand>& operator_command,
                       const std::optional<int>& preparation_percent) {
    const LinkUpdate& was = drawn.link;
    const bool has_moved = tool && !(drawn.tool && looks_the_same(*drawn.tool, *tool));
    if (has_moved || link.ct || !is_as_drawn(drawn.operator_command, operator_command) ||
        link.status != was.status || link.status_line != was.status_line ||
        link.recording_error != was.recording_error || link.controls != was.controls ||
        link.distances != was.distances || link.checksum_mismatches != was.checksum_mismatches ||
        link.rejected_frames != was.rejected_frames || link.bricks_repaired != was.bricks_repaired)
        return SessionNews::change;
    const bool time_goes_on = tool && tool->time_s != drawn.tool->time_s;
    const bool is_figure_new = time_goes_on || link.snapshot_bricks != was.snapshot_bricks ||
                               preparation_percent != drawn.preparation_percent ||
                               link.frames_per_s != was.frames_per_s || link.bytes_per_s != was.bytes_per_s;
    return is_figure_new ? SessionNews::figures : SessionNews::none;
}

}  // namespace osteomill
