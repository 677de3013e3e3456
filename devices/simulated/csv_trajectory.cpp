#include "devices/simulated/csv_trajectory.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "common/bone/patient_space.h"
#include "common/files/input_file.h"
#include "common/session/session_control.h"
#include "common/session/written_pose.h"
#include "common/text/csv.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

constexpr std::size_t columns_without_burr = 8;

class CsvReader {
  public:
    CsvReader(const std::string& text, const std::string& name, std::size_t burr_count)
        : lines_(text, name), name_(name), burr_count_(burr_count) {}

    std::vector<Waypoint> read() {
        read_header();
        std::vector<Waypoint> waypoints;
        while (lines_.next()) {
            waypoints.push_back(waypoint());
            if (waypoints.size() > 1 && !(waypoints.back().time_s > waypoints[waypoints.size() - 2].time_s)) {
                lines_.fail("t_s must be later than on the line before");
            }
        }
        if (waypoints.empty()) throw std::runtime_error(name_ + ": no waypoint after the header line");
        return waypoints;
    }

  private:
    void read_header() {
        const std::string with_burr = fmt::format("{}{}", trajectory_columns, trajectory_burr_column);
        const std::string header = lines_.next() ? lines_.line() : "";
        has_burr_ = header == with_burr;
        if (header == trajectory_columns || has_burr_) return;
        lines_.fail(fmt::format("the first line must be {}[{}]", trajectory_columns, trajectory_burr_column));
    }

    Waypoint waypoint() {
        const std::vector<std::string> cells = split();
        const auto number = [&](std::size_t column) { return to_number(cells[column]); };
        Waypoint result;
        result.time_s = number(0);
        if (!(std::abs(result.time_s) <= longest_session_s))
            lines_.fail(fmt::format("t_s must be within {:.0f} s", longest_session_s));
        result.pose.position_mm = {number(1), number(2), number(3)};
        if (!is_place(result.pose.position_mm))
            lines_.fail(fmt::format("x_mm,y_mm,z_mm lie more than {} mm from the origin", farthest_place_mm));
        const auto axis = unit_direction({number(4), number(5), number(6)});
        if (!axis)
            lines_.fail("axis_x,axis_y,axis_z must not all be zero, nor huge: a direction is about 1 long");
        result.pose.spindle_axis = *axis;
        if (cells[7] != "0" && cells[7] != "1")
            lines_.fail(fmt::format("pedal must be 0 or 1, not '{}'", one_line(cells[7])));
        result.pedal = cells[7] == "1";
        if (has_burr_) result.burr = to_burr(cells[columns_without_burr]);
        return result;
    }

    std::vector<std::string> split() const {
        std::vector<std::string> cells = cells_of(lines_.line());
        const std::size_t expected = columns_without_burr + (has_burr_ ? 1 : 0);
        if (cells.size() != expected)
            lines_.fail(fmt::format("has {} columns, the header has {}", cells.size(), expected));
        return cells;
    }

    double to_number(std::string_view cell) const {
        const std::optional<double> value = finite_number(cell);
        if (!value) lines_.fail(fmt::format("'{}' is not a finite number", one_line(cell)));
        return *value;
    }

    std::size_t to_burr(std::string_view cell) const {
        const auto value = parse_number<std::size_t>(cell);
        if (!value || *value >= burr_count_)
            lines_.fail(fmt::format("burr '{}' is not an index into the scene's set, 0 to {}", one_line(cell),
                                    burr_count_ - 1));
        return *value;
    }

    TableLines lines_;
    std::string name_;
    std::size_t burr_count_;
    bool has_burr_ = false;
};

}  // namespace

std::vector<Waypoint> read_trajectory_csv(const std::string& text, const std::string& name,
                                          std::size_t burr_count) {
    return CsvReader(text, name, burr_count).read();
}

std::vector<Waypoint> read_trajectory_csv(const std::filesystem::path& file, std::size_t burr_count) {
    return read_trajectory_csv(read_text(file, trajectory_kind), file.string(), burr_count);
}

}  // namespace osteomill
