#include "haptic_server/imaging/progress.h"

#include <fmt/format.h>

#include <memory>
#include <ostream>

namespace osteomill {

Progress progress_on(std::ostream& out, bool is_terminal, std::string what) {
    auto last_shown = std::make_shared<int>(-1);
    return [&out, is_terminal, what = std::move(what), last_shown](double share) {
        const int step_percent = is_terminal ? 1 : 10;
        const int percent = static_cast<int>(share * 100.0 + 0.5) / step_percent * step_percent;
        if (percent == *last_shown) return;
        *last_shown = percent;
        if (is_terminal)
            out << fmt::format("\r{} [{:<40}] {:3} %", what,
                               std::string(static_cast<std::size_t>(percent * 2 / 5), '#'), percent)
                << (percent >= 100 ? "\n" : "") << std::flush;
        else
            out << fmt::format("{}: {} %\n", what, percent) << std::flush;
    };
}

}  // namespace osteomill
