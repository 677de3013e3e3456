// Progress of a session for people: a status line a second on a terminal, a line every five seconds
// elsewhere, and a line of its own whenever the force goes off or comes back, or a change of burr has to
// wait. How it went while the terminal took nothing is out of date: there is no status line until the earlier
// lines have been taken.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "common/log/line_stream.h"
#include "common/session/tool_state.h"

namespace osteomill {

class StatusLine {
  public:
    using Clock = std::chrono::steady_clock;

    /// Writes to `out`, which outlives it; `is_terminal` decides between rewriting one line and adding lines.
    StatusLine(LineStream& out, bool is_terminal) : out_(out), is_terminal_(is_terminal) {}

    /// To be called often; `now` is the time of people, not of the session. `done`: how much of a session is
    /// done that runs as fast as it can, 0 to 1, if that is known; each line says it, and there is one
    /// whenever a tenth has been done, too.
    void show(const ToolState& tool, Clock::time_point now, std::optional<double> done = std::nullopt);
    /// Shows the device's notice on a line of its own whenever it changes; empty: nothing.
    void show_notice(const ToolState& tool, std::string_view notice);
    /// Ends the status line.
    void finish();

  private:
    void show_fault(const ToolState& tool);
    void show_wait(const ToolState& tool);

    LineStream& out_;
    bool is_terminal_;
    int tenths_shown_ = 0;
    bool is_line_open_ = false;
    BoundedLine fault_;
    BoundedLine wait_;
    std::string notice_;
    Clock::time_point next_{};
};

}  // namespace osteomill
