#include "studies/polishing/force_record.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace osteomill::study {

namespace {

/// Calls `take` with the numbers of each line after the first.
template <std::size_t columns, typename Take>
void read_rows(const std::filesystem::path& file, Take&& take) {
    std::ifstream in(file);
    std::string line;
    if (!std::getline(in, line)) throw std::runtime_error(file.string() + ": cannot be read");
    std::array<double, columns> numbers{};
    for (int line_number = 2; std::getline(in, line); ++line_number) {
        const char* at = line.c_str();
        for (std::size_t i = 0; i < columns; ++i) {
            char* end = nullptr;
            numbers[i] = std::strtod(at, &end);
            if (end == at || *end != (i + 1 < columns ? ',' : '\0'))
                throw std::runtime_error(fmt::format("{}, line {}: {} numbers were expected, found '{}'",
                                                     file.string(), line_number, columns, line));
            at = end + 1;
        }
        take(numbers);
    }
}

}  // namespace

ForceRecord read_force_log(const std::filesystem::path& file) {
    ForceRecord record;
    read_rows<14>(file, [&](const std::array<double, 14>& n) {
        record.push_back({.time_s = n[0],
                          .burr_mm = {n[4], n[5], n[6]},
                          .force_n = {n[7], n[8], n[9]},
                          .removed_mm3 = n[11]});
    });
    return record;
}

ForceRecord read_milling_log(const std::filesystem::path& file) {
    ForceRecord record;
    read_rows<9>(file, [&](const std::array<double, 9>& n) {
        record.push_back({.time_s = n[0],
                          .burr_mm = {n[1], n[2], n[3]},
                          .force_n = {n[4], n[5], n[6]},
                          .removed_mm3 = n[7]});
    });
    return record;
}

}  // namespace osteomill::study
