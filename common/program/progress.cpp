#include "common/program/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace osteomill {

namespace {
constexpr int bar_columns = 40;
constexpr int percent_between_lines = 10;
constexpr double estimated_after_s = 2.0;
}  // namespace

std::string time_left(double left_s) {
    constexpr long seconds_up_to = 100;
    const long seconds = std::lround(std::ceil(left_s));
    if (seconds <= 0) return "";
    if (seconds < seconds_up_to) return fmt::format("{} s left", seconds);
    const long minutes = (seconds + 59) / 60;
    if (minutes < 60) return fmt::format("{} min left", minutes);
    return fmt::format("{} h {} min left", minutes / 60, minutes % 60);
}

double ProgressLine::steady_now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ProgressLine::ProgressLine(std::ostream& out, bool is_terminal, std::string title, Now now_s)
    : out_(out), is_terminal_(is_terminal), title_(std::move(title)), now_s_(std::move(now_s)) {}

ProgressLine::~ProgressLine() {
    if (is_terminal_ && shown_percent_ >= 0) out_ << '\n' << std::flush;
}

std::string ProgressLine::left_at(double done) const {
    const double elapsed_s = now_s_() - begin_->at_s;
    if (elapsed_s < estimated_after_s || done <= begin_->done) return "";
    return time_left(elapsed_s * (1.0 - done) / (done - begin_->done));
}

void ProgressLine::report(double done) {
    done = std::clamp(done, 0.0, 1.0);
    if (!begin_) begin_ = Begin{done, now_s_()};
    int percent = static_cast<int>(100.0 * done + 1e-9);
    if (!is_terminal_) percent -= percent % percent_between_lines;
    if (percent < shown_percent_ || (!is_terminal_ && percent == shown_percent_)) return;
    const std::string left = left_at(done);
    if (percent == shown_percent_ && left == shown_left_) return;
    const std::size_t columns_to_clear = shown_left_.empty() ? 0 : shown_left_.size() + 2;
    shown_percent_ = percent;
    shown_left_ = left;
    const std::string behind = left.empty() ? "" : ", " + left;
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
