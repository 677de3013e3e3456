#include "analysis/output/time_left.h"

#include <fmt/format.h>

#include <cmath>

namespace osteomill::study {

std::string time_left(std::size_t done, std::size_t all, double elapsed_s) {
    if (done == 0 || done >= all) return "";
    constexpr long seconds_told_from = 100;
    const double left_s = elapsed_s * static_cast<double>(all - done) / static_cast<double>(done);
    const long seconds = std::lround(std::ceil(left_s));
    if (seconds < seconds_told_from) return fmt::format("{} s left", seconds);
    const long minutes = (seconds + 59) / 60;
    if (minutes < 60) return fmt::format("{} min left", minutes);
    return fmt::format("{} h {} min left", minutes / 60, minutes % 60);
}

}  // namespace osteomill::study
