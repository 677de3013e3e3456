#include "haptic_server/program/status_line.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

namespace osteomill {

void StatusLine::show(const ToolState& tool, Clock::time_point now, std::optional<double> done) {
    show_fault(tool);
    show_wait(tool);
    const int tenths = done ? static_cast<int>(10.0 * *done + 1e-6) : 0;
    if ((now < next_ && tenths <= tenths_shown_) || !out_.has_caught_up()) return;
    tenths_shown_ = tenths;
    next_ = now + (is_terminal_ ? std::chrono::seconds(1) : std::chrono::seconds(5));
    const std::string line = fmt::format(
        "{:7.1f} s{}   force {:5.2f} N   removed {:8.2f} mm^3   spindle {}{}", tool.time_s,
        done ? fmt::format(" ({:.0f} %)", 100.0 * *done) : "", glm::length(tool.force_n), tool.removed_mm3,
        tool.spindle_on ? "on " : "off", tool.touches_protected ? "   PROTECTED TISSUE" : "");
    // To the line's start, and erase the rest of the last one.
    out_.write(is_terminal_ ? fmt::format("\r{}\033[K", line) : line + "\n");
    is_line_open_ = is_terminal_;
}

void StatusLine::show_fault(const ToolState& tool) {
    if (tool.fault == fault_) return;
    finish();
    fault_ = tool.fault;
    out_.say(
        fmt::format("{:7.1f} s   {}", tool.time_s, fault_.empty() ? "the force comes back" : fault_.text()));
}

void StatusLine::show_wait(const ToolState& tool) {
    if (tool.notice == wait_) return;
    wait_ = tool.notice;
    if (wait_.empty()) return;  // the requested state is there
    finish();
    out_.say(fmt::format("{:7.1f} s   {}", tool.time_s, wait_.text()));
}

void StatusLine::show_notice(const ToolState& tool, std::string_view notice) {
    if (notice == notice_) return;
    finish();
    notice_ = notice;
    out_.say(fmt::format("{:7.1f} s   {}", tool.time_s, notice.empty() ? "the device is ready" : notice));
}

void StatusLine::finish() {
    if (is_line_open_) out_.write("\n");
    is_line_open_ = false;
}

}  // namespace osteomill
