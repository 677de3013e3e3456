#include "analysis/replay/recording_csv.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <stdexcept>

#include "common/session/written_pose.h"
#include "common/text/append.h"
#include "common/text/csv.h"
#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

std::string xyz(const glm::dvec3& value, int decimals) {
    return fmt::format("{0:.{3}f},{1:.{3}f},{2:.{3}f}", value.x, value.y, value.z, decimals);
}

std::string nearest_of(const Playhead& playhead) {
    const StructureDistance* nearest = nearest_structure(playhead.state().distances);
    if (nearest == nullptr) return ",";
    return fmt::format("{},{:.4f}", csv_cell(playhead.session().tissues[nearest->tissue].name),
                       *nearest->distance_mm);
}

constexpr const char* state_columns =
    "time_s,session_time_s,burr_x_mm,burr_y_mm,burr_z_mm,axis_x,axis_y,axis_z,hand_x_mm,hand_y_mm,"
    "hand_z_mm,force_x_n,force_y_n,force_z_n,burr,spindle,removed_mm3,nearest_structure,"
    "nearest_structure_mm\n";

/// Appends the waypoint as the loop used it: rails lead a hand along the same poses, bit for bit.
void append_waypoint(fmt::memory_buffer& text, double time_s, const glm::dvec3& hand_mm,
                     const glm::dvec3& axis, bool pedal, std::size_t burr) {
    append_formatted(text, "{:.4f},{},{},{},{}\n", time_s, xyz(hand_mm, hand_decimals_mm),
                     xyz(axis, axis_decimals), pedal ? 1 : 0, burr);
}

/// The comment that names the arm; empty in a recording that names none.
std::string arm_line(const SessionInfo& session) {
    const auto arm = session.settings.find("arm");
    return arm == session.settings.end() ? "" : fmt::format("{}{}\n", trajectory_arm, one_line(arm->second));
}

void append_state(fmt::memory_buffer& text, const Playhead& playhead) {
    const ToolState& tool = *playhead.tool();
    append_formatted(text, "{:.4f},{:.4f},{},{},{},{},{},{},{:.5f},{}\n", playhead.time_s(), tool.time_s,
                     xyz(tool.burr_position_mm, 4), xyz(tool.spindle_axis, 6), xyz(tool.hand_position_mm, 4),
                     xyz(tool.force_n, 5), csv_cell(playhead.session().burrs[tool.burr].name),
                     tool.spindle_on ? 1 : 0, tool.removed_mm3, nearest_of(playhead));
}

}  // namespace

void RecordingCsv::add(const Playhead& playhead) {
    fmt::memory_buffer text;
    if (lines_ == CsvLines::trajectory) {
        begin_columns(fmt::format("{}{}{}\n", arm_line(playhead.session()), trajectory_columns,
                                  trajectory_burr_column));
        add_waypoints(text, playhead);
    } else if (lines_ == CsvLines::ticks && playhead.session().holds_ticks) {
        if (playhead.ticks().empty()) return;
        begin_columns(TickSample::header_line(playhead.ticks().front().shank_torque_n_mm.has_value()));
        for (const TickSample& tick : playhead.ticks()) tick.append_to(text);
    } else {
        begin_columns(state_columns);
        append_state(text, playhead);
    }
    file_.write(std::as_bytes(std::span(text.data(), text.size())));
}

void RecordingCsv::add_waypoints(fmt::memory_buffer& text, const Playhead& playhead) {
    const auto add = [&](double time_s, const auto&... rest) {
        const double since_s = std::round(1e4 * (time_s - trajectory_begins_s_.value_or(time_s))) / 1e4;
        if (since_s < waypoint_s_)
            throw std::runtime_error(
                fmt::format("{}: the recording holds more than one session, and a trajectory is of one: cut "
                            "them apart, with editcap for instance",
                            file_.path().string()));
        // The state of a session that stands still.
        if (trajectory_begins_s_ && since_s == waypoint_s_) return;
        if (!trajectory_begins_s_) trajectory_begins_s_ = time_s;
        waypoint_s_ = since_s;
        append_waypoint(text, since_s, rest...);
    };
    if (playhead.session().holds_ticks) {
        for (const TickSample& tick : playhead.ticks())
            add(tick.time_s, tick.hand_mm, tick.spindle_axis, tick.spindle_on, tick.burr);
    } else {
        const ToolState& tool = *playhead.tool();
        add(tool.time_s, tool.hand_position_mm, tool.spindle_axis, tool.spindle_on, tool.burr);
    }
}

void RecordingCsv::begin_columns(const std::string& header_line) {
    if (header_line == header_line_) return;
    if (!header_line_.empty())
        throw std::runtime_error(
            fmt::format("{}: the sessions that were joined in the recording have not the "
                        "same columns: cut them apart, with editcap for instance",
                        file_.path().string()));
    header_line_ = header_line;
    file_.write(std::as_bytes(std::span(header_line_)));
}

}  // namespace osteomill
