#include "analysis/calibration/run_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string_view>

#include "common/files/input_file.h"
#include "common/files/table_line.h"
#include "common/text/words.h"

namespace osteomill::study {

namespace {

constexpr std::string_view groove_column = "previous_groove_mm_higher";

constexpr std::array<std::string_view, 17> columns{"run",           "material",
                                                   "diameter_mm",   "edges",
                                                   "turns",         "rpm",
                                                   "feed_mm_per_s", "depth_mm",
                                                   "tilt_deg",      groove_column,
                                                   "force_feed_n",  "force_across_n",
                                                   "force_up_n",    "tilt_direction_deg",
                                                   "spread_feed_n", "spread_across_n",
                                                   "spread_up_n"};

/// The names of the columns, checked.
std::vector<std::string> header_of(const TableLines& lines) {
    const std::vector<std::string> names = cells_of(lines.line());
    for (auto name = names.begin(); name != names.end(); ++name) {
        if (std::find(columns.begin(), columns.end(), *name) == columns.end())
            lines.fail(fmt::format("unknown column '{}'; there are {}", *name, fmt::join(columns, ", ")));
        if (std::find(names.begin(), name, *name) != name)
            lines.fail(fmt::format("column '{}' is there twice; each must be there once", *name));
    }
    for (const std::string_view column : columns)
        if (column != groove_column && std::find(names.begin(), names.end(), column) == names.end())
            lines.fail(fmt::format("column '{}' is missing; the first line must name it", column));
    return names;
}

/// One line of the table, and how to complain about it.
class Line {
  public:
    Line(const std::vector<std::string>& header, const TableLines& lines)
        : header_(header), values_(cells_of(lines.line())), lines_(lines) {
        if (values_.size() != header.size())
            lines.fail(fmt::format("{} values; there must be {}, one for each column", values_.size(),
                                   header.size()));
    }

    const std::string& text(std::string_view column) const {
        if (value(column).empty()) wrong(column, "a text");
        return value(column);
    }

    double number(std::string_view column, std::string_view wanted, bool (*is_good)(double)) const {
        const std::optional<double> number = finite_number(value(column));
        if (!number || !is_good(*number)) wrong(column, wanted);
        return *number;
    }

    bool is_empty(std::string_view column) const {
        return std::find(header_.begin(), header_.end(), column) == header_.end() || value(column).empty();
    }

    [[noreturn]] void wrong(std::string_view column, std::string_view wanted) const {
        lines_.fail(fmt::format("{} is '{}'; it must be {}", column, value(column), wanted));
    }

  private:
    const std::string& value(std::string_view column) const {
        const auto found = std::find(header_.begin(), header_.end(), column);
        return values_[static_cast<std::size_t>(found - header_.begin())];
    }

    const std::vector<std::string>& header_;
    std::vector<std::string> values_;
    const TableLines& lines_;
};

glm::dvec3 vector_of(const Line& line, std::string_view what, std::string_view wanted,
                     bool (*is_good)(double)) {
    glm::dvec3 vector(0.0);
    constexpr std::array axes{"feed", "across", "up"};
    for (int axis = 0; axis < 3; ++axis)
        vector[axis] =
            line.number(fmt::format("{}_{}_n", what, axes[static_cast<std::size_t>(axis)]), wanted, is_good);
    return vector;
}

RunSetting setting_of(const Line& line) {
    RunSetting s;
    s.diameter_mm =
        line.number("diameter_mm", "a number from 0.2 to 20", [](double v) { return v >= 0.2 && v <= 20.0; });
    s.edges = static_cast<int>(line.number("edges", "a whole number from 1 to 64", [](double v) {
        return v >= 1.0 && v <= 64.0 && v == std::floor(v);
    }));
    const std::string& turns = line.text("turns");
    if (turns != "clockwise" && turns != "counter-clockwise")
        line.wrong("turns", "clockwise or counter-clockwise, seen from the handpiece");
    s.turns = turns == "clockwise" ? SpindleSense::clockwise : SpindleSense::counter_clockwise;
    s.rpm = line.number("rpm", "a number from 100 to 500000",
                        [](double v) { return v >= 100.0 && v <= 500'000.0; });
    s.feed_mm_per_s = line.number("feed_mm_per_s", "a number above 0, at most 1000",
                                  [](double v) { return v > 0.0 && v <= 1000.0; });
    constexpr const char* good_depth = "a number above 0, at most the burr's radius";
    s.depth_mm = line.number("depth_mm", good_depth, [](double v) { return v > 0.0; });
    if (s.depth_mm > 0.5 * s.diameter_mm) line.wrong("depth_mm", good_depth);
    s.tilt_deg =
        line.number("tilt_deg", "a number from 0 to 85", [](double v) { return v >= 0.0 && v <= 85.0; });
    s.tilt_direction_deg = line.number("tilt_direction_deg", "a number from -360 to 360",
                                       [](double v) { return std::abs(v) <= 360.0; });
    if (!line.is_empty(groove_column))
        s.previous_groove_mm_higher =
            line.number(groove_column, "a number above 0, or empty", [](double v) { return v > 0.0; });
    return s;
}

}  // namespace

std::vector<MeasuredRun> read_runs(const std::filesystem::path& file) {
    TableLines lines(read_text(file, table_kind), file.string());
    std::vector<std::string> header;
    std::vector<MeasuredRun> runs;
    std::set<std::string> names;
    while (lines.next()) {
        if (header.empty()) {
            header = header_of(lines);
            continue;
        }
        const Line line(header, lines);
        MeasuredRun run{.name = line.text("run"),
                        .material = line.text("material"),
                        .setting = setting_of(line),
                        .force_n = vector_of(line, "force", "a number, N", [](double) { return true; }),
                        .spread_n = vector_of(line, "spread",
                                              "a number above 0, N, the standard deviation "
                                              "of the mean force",
                                              [](double v) { return v > 0.0; })};
        if (!names.insert(run.name).second) line.wrong("run", "a name that no other line has");
        runs.push_back(std::move(run));
    }
    if (runs.empty())
        throw std::runtime_error(file.string() +
                                 ": holds no run; the first line names the columns, each other is a run");
    return runs;
}

std::string table_to_fill_in(const std::vector<RunSetting>& settings, const std::string& material) {
    std::string csv =
        "run,material,diameter_mm,edges,turns,rpm,feed_mm_per_s,depth_mm,tilt_deg,tilt_direction_deg,"
        "force_feed_n,force_across_n,force_up_n,spread_feed_n,spread_across_n,spread_up_n\n";
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const RunSetting& s = settings[i];
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},,,,,,\n", i + 1, material, s.diameter_mm, s.edges,
                           s.turns == SpindleSense::clockwise ? "clockwise" : "counter-clockwise", s.rpm,
                           s.feed_mm_per_s, s.depth_mm, s.tilt_deg, s.tilt_direction_deg);
    }
    return csv;
}

}  // namespace osteomill::study
