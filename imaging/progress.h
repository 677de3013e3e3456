// Progress of a long piece of work, on standard error: a bar on a terminal, else a line every 10 %.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <string_view>

namespace osteomill {

/// Called with how much is done, 0 to 1, ascending, from one thread.
using ReportProgress = std::function<void(double done)>;

class ProgressLine {
  public:
    /// `out` must outlive the line. `title` names the work ("refining").
    ProgressLine(std::ostream& out, bool is_terminal, std::string title);
    /// Ends the bar's line if it was begun.
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `note` stands behind the percentage ("2 min left"); a new one alone draws the bar anew.
    void report(double done, std::string_view note = {});
    ReportProgress reporter() {
        return [this](double done) { report(done); };
    }

  private:
    std::ostream& out_;
    bool is_terminal_;
    std::string title_;
    int shown_percent_ = -1;
    std::string note_{};
};

}  // namespace osteomill
