#include "haptic_server/imaging/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace osteomill {

namespace {
constexpr int bar_columns = 40;
constexpr int percent_between_lines = 10;
}  // namespace

ProgressLine::ProgressLine(std::ostream& out, bool is_terminal, std::string title)
    : out_(out), is_terminal_(is_terminal), title_(std::move(title)) {}

ProgressLine::~ProgressLine() {
    if (is_terminal_ && shown_percent_ >= 0) out_ << '\n' << std::flush;
}

void ProgressLine::report(double done) {
    int percent = static_cast<int>(100.0 * std::clamp(done, 0.0, 1.0) + 1e-9);
    if (!is_terminal_) percent -= percent % percent_between_lines;
    if (percent <= shown_percent_) return;
    shown_percent_ = percent;
    if (is_terminal_) {
        const int filled = percent * bar_columns / 100;
        out_ << fmt::format("\r{:<10} [{:<{}}] {:3} %", title_,
                            std::string(static_cast<std::size_t>(filled), '#'), bar_columns, percent)
             << std::flush;
    } else if (percent > 0) {
        out_ << fmt::format("{} {} %\n", title_, percent) << std::flush;
    }
}

}  // namespace osteomill
