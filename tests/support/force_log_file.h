// Files that a server wrote with --log-csv, and other files of numbers.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace osteomill::testing {

/// The lines of a CSV file behind its header, each up to the first field that is no number: a log that is
/// read while it is written may end in "-" or "1e".
inline std::vector<std::vector<double>> read_csv_numbers(std::istream& in) {
    std::vector<std::vector<double>> rows;
    std::string text;
    std::getline(in, text);
    while (std::getline(in, text)) {
        std::vector<double>& row = rows.emplace_back();
        for (const char* at = text.c_str(); *at != '\0';) {
            char* end = nullptr;
            const double number = std::strtod(at, &end);
            if (end == at) break;
            row.push_back(number);
            at = *end == ',' ? end + 1 : end;
        }
    }
    return rows;
}
inline std::vector<std::vector<double>> read_csv_numbers(const std::filesystem::path& csv) {
    std::ifstream in(csv);
    return read_csv_numbers(in);
}

struct ForceLogLine {
    double time_s = 0.0;
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};
    double removed_mm3 = 0.0;
    bool spindle_on = false;
    int fault = 0;
};

/// Columns as csv_log.h says; the first line is left out, and one that is torn at the end of a log is none.
inline std::vector<ForceLogLine> read_force_log(std::istream& csv) {
    std::vector<ForceLogLine> lines;
    for (const std::vector<double>& column : read_csv_numbers(csv)) {
        if (column.size() < 14) continue;
        lines.push_back({.time_s = column[0],
                         .burr_mm = {column[4], column[5], column[6]},
                         .force_n = {column[7], column[8], column[9]},
                         .removed_mm3 = column[11],
                         .spindle_on = column[12] != 0.0,
                         .fault = static_cast<int>(column[13])});
    }
    return lines;
}
inline std::vector<ForceLogLine> read_force_log(const std::filesystem::path& csv) {
    std::ifstream in(csv);
    return read_force_log(in);
}

}  // namespace osteomill::testing
