#include "imaging/progress.h"

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

void ProgressLine::report(double done, std::string_view note) {
    int percent = static_cast<int>(100.0 * std::clamp(done, 0.0, 1.0) + 1e-9);
    if (!is_terminal_) percent -= percent % percent_between_lines;
    const bool has_news =
        percent > shown_percent_ || (is_terminal_ && percent == shown_percent_ && note != note_);
    if (!has_news) return;
    const std::size_t columns_to_clear = note_.empty() ? 0 : note_.size() + 2;
    shown_percent_ = percent;
    note_ = note;
    const std::string behind = note_.empty() ? "" : ", " + note_;
    if (is_terminal_) {
        const int filled = percent * bar_columns / 100;
        out_ << fmt::format("\r{:<10} [{:<{}}] {:3} %{:<{}}", title_,
                            std::string(static_cast<std::size_t>(filled), '#'), bar_columns, percent, behind,
                            columns_to_clear)
             << std::flush;
    } else if (percent > 0) {
        out_ << fmt::format("{} {} %{}\n", title_, percent, behind) << std::flush;
    }
}

}  // namespace osteomill
