// Progress of a long piece of work, on standard error: a line that is drawn again on a terminal, else a line
// every 10 %.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>

namespace osteomill {

/// Called with how much is done, 0 to 1, ascending, from one thread.
using ReportProgress = std::function<void(double done)>;

/// "40 s left", "3 min left", "2 h 5 min left"; "" if nothing is left.
std::string time_left(double left_s);

class ProgressLine {
  public:
    using Now = std::function<double()>;
    static double steady_now_s();

    /// `out` must outlive the line. `title` names the work ("refining"). `now_s` tells the time in seconds
    /// from any start; tests give their own.
    ProgressLine(std::ostream& out, bool is_terminal, std::string title, Now now_s = steady_now_s);
    /// Ends the line on a terminal if it was begun.
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Shows the percentage and, once the work has taken two seconds, the time left: by the pace since the
    /// first report, which may begin above 0 if a part was done before.
    void report(double done);
    ReportProgress reporter() {
        return [this](double done) { report(done); };
    }

  private:
    struct Begin {
        double done;
        double at_s;
    };
    std::string left_at(double done) const;

    std::ostream& out_;
    bool is_terminal_;
    std::string title_;
    Now now_s_;
    std::optional<Begin> begin_{};
    int shown_percent_ = -1;
    std::string shown_left_{};
};

}  // namespace osteomill
