#include "studies/polishing/force_record.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace osteomill::study {

ForceRecord read_force_log(const std::filesystem::path& file) {
    constexpr std::size_t columns = 14;
    std::ifstream in(file);
    std::string line;
    if (!std::getline(in, line)) throw std::runtime_error(file.string() + ": cannot be read");
    ForceRecord record;
    std::array<double, columns> n{};
    for (int line_number = 2; std::getline(in, line); ++line_number) {
        const char* at = line.c_str();
        for (std::size_t i = 0; i < columns; ++i) {
            char* end = nullptr;
            n[i] = std::strtod(at, &end);
            if (end == at || *end != (i + 1 < columns ? ',' : '\0'))
                throw std::runtime_error(fmt::format("{}, line {}: {} numbers were expected, found '{}'",
                                                     file.string(), line_number, columns, line));
            at = end + 1;
        }
        record.push_back({.time_s = n[0],
                          .burr_mm = {n[4], n[5], n[6]},
                          .force_n = {n[7], n[8], n[9]},
                          .removed_mm3 = n[11]});
    }
    return record;
}

}  // namespace osteomill::study
