#include "devices/simulated/csv_trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "common/bone/patient_space.h"
#include "common/files/input_file.h"
#include "common/files/table_line.h"
#include "common/scene/session_control.h"
#include "common/scene/trajectory_columns.h"
#include "common/text/plain_text.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

constexpr std::size_t columns_without_burr = 8;

/// Reads one file line by line and knows where it is.
class CsvReader {
  public:
    CsvReader(std::istream& in, std::string name, std::size_t burr_count)
        : in_(in), name_(std::move(name)), burr_count_(burr_count) {}

    std::vector<Waypoint> read() {
        read_header();
        std::vector<Waypoint> waypoints;
        while (next_line()) {
            waypoints.push_back(waypoint());
            if (waypoints.size() > 1 && !(waypoints.back().time_s > waypoints[waypoints.size() - 2].time_s)) {
                refuse("t_s must be later than on the line before");
            }
        }
        if (in_.bad()) throw std::runtime_error(name_ + ": cannot be read");
        if (waypoints.empty()) throw std::runtime_error(name_ + ": no waypoint after the header line");
        return waypoints;
    }

  private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error(fmt::format("{}:{}: {}", name_, line_number_, what));
    }

    /// The next line that says something.
    bool next_line() {
        try {
            while (next_table_line(in_, line_, line_number_))
                if (!line_.empty() && line_.front() != '#') return true;
        } catch (const std::runtime_error& error) {
            refuse(error.what());
        }
        return false;
    }

    void read_header() {
        const std::string with_burr = fmt::format("{}{}", trajectory_columns, trajectory_burr_column);
        const bool found = next_line();
        if (found && line_ == trajectory_columns) return;
        if (found && line_ == with_burr) {
            has_burr_ = true;
            return;
        }
        line_number_ = std::max<std::size_t>(line_number_, 1);
        refuse(fmt::format("the first line must be {}[{}]", trajectory_columns, trajectory_burr_column));
    }

    Waypoint waypoint() {
        const std::vector<std::string> cells = split();
        const auto number = [&](std::size_t column) { return to_number(cells[column]); };
        Waypoint result;
        result.time_s = number(0);
        if (!(std::abs(result.time_s) <= longest_session_s))
            refuse(fmt::format("t_s must be within {:.0f} s", longest_session_s));
        result.pose.position_mm = {number(1), number(2), number(3)};
        if (!is_place(result.pose.position_mm))
            refuse(fmt::format("x_mm,y_mm,z_mm lie more than {} mm from the origin", farthest_place_mm));
        const auto axis = unit_direction({number(4), number(5), number(6)});
        if (!axis) refuse("axis_x,axis_y,axis_z must not all be zero, nor huge: a direction is about 1 long");
        result.pose.spindle_axis = *axis;
        if (cells[7] != "0" && cells[7] != "1")
            refuse(fmt::format("pedal must be 0 or 1, not '{}'", one_line(cells[7])));
        result.pedal = cells[7] == "1";
        if (has_burr_) result.burr = to_burr(cells[columns_without_burr]);
        return result;
    }

    std::vector<std::string> split() const {
        std::vector<std::string> cells = cells_of(line_);
        const std::size_t expected = columns_without_burr + (has_burr_ ? 1 : 0);
        if (cells.size() != expected)
            refuse(fmt::format("has {} columns, the header has {}", cells.size(), expected));
        return cells;
    }

    double to_number(std::string_view cell) const {
        const std::optional<double> value = finite_number(cell);
        if (!value) refuse(fmt::format("'{}' is not a finite number", one_line(cell)));
        return *value;
    }

    std::size_t to_burr(std::string_view cell) const {
        const auto value = parse_number<std::size_t>(cell);
        if (!value || *value >= burr_count_)
            refuse(fmt::format("burr '{}' is not an index into the scene's set, 0 to {}", one_line(cell),
                               burr_count_ - 1));
        return *value;
    }

    std::istream& in_;
    std::string name_;
    std::size_t burr_count_;
    bool has_burr_ = false;
    std::string line_;
    std::size_t line_number_ = 0;
};

}  // namespace

std::vector<Waypoint> read_trajectory_csv(std::istream& in, const std::string& name, std::size_t burr_count) {
    return CsvReader(in, name, burr_count).read();
}

std::vector<Waypoint> read_trajectory_csv(const std::filesystem::path& file, std::size_t burr_count) {
    std::istringstream in(read_text(file, trajectory_kind));
    return read_trajectory_csv(in, file.string(), burr_count);
}

}  // namespace osteomill
