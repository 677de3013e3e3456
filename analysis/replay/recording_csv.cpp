#include "analysis/replay/recording_csv.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/text/csv_cell.h"

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

}  // namespace

RecordingCsv::RecordingCsv(const std::filesystem::path& file) : file_(file), out_(file_.part()) {
    if (!out_)
        throw std::runtime_error(fmt::format("{}: cannot write: {}", file.string(), std::strerror(errno)));
    out_ << "time_s,session_time_s,burr_x_mm,burr_y_mm,burr_z_mm,axis_x,axis_y,axis_z,hand_x_mm,hand_y_mm,"
            "hand_z_mm,force_x_n,force_y_n,force_z_n,burr,spindle,removed_mm3,nearest_structure,"
            "nearest_structure_mm\n";
}

void RecordingCsv::add(const Playhead& playhead) {
    const ToolState& tool = *playhead.tool();
    out_ << fmt::format("{:.4f},{:.4f},{},{},{},{},{},{},{:.5f},{}\n", playhead.time_s(), tool.time_s,
                        xyz(tool.burr_position_mm, 4), xyz(tool.spindle_axis, 6),
                        xyz(tool.hand_position_mm, 4), xyz(tool.force_n, 5),
                        csv_cell(playhead.session().burrs[tool.burr].name), tool.spindle_on ? 1 : 0,
                        tool.removed_mm3, nearest_of(playhead));
}

void RecordingCsv::close() {
    out_.close();
    if (!out_)
        throw std::runtime_error(
            fmt::format("{}: cannot write: {}", file_.path().string(), std::strerror(errno)));
    file_.commit();
}

}  // namespace osteomill
