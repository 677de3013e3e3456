// A program run by this one: its output is read as it comes, and it ends with its owner.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace osteomill {

class ChildProgram {
  public:
    /// Runs without a shell; `command[0]` is a path. Throws std::runtime_error with one line if it cannot be
    /// run. `longest_end`: time that it gets to end when requested.
    explicit ChildProgram(const std::vector<std::string>& command,
                          std::chrono::seconds longest_end = std::chrono::seconds(2));
    /// Requests its end, waits for it, and then kills it.
    ~ChildProgram();
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    /// Reads new output, and whether it has ended; never waits. True if there is news.
    bool poll();
    /// The newest part of the output on both of its streams.
    const std::string& output() const { return output_; }
    /// The last line of that which says something.
    std::string last_line() const;
    bool is_running() const { return !status_.has_value(); }
    /// Nothing while it runs; minus the signal's number if a signal ended it.
    const std::optional<int>& status() const { return status_; }
    /// Asks it to end, the way CTRL-C does.
    void ask_to_end() const;
    /// Ends it at once, though it stands still.
    void kill() const;
    /// From now on it gets little of a processor that another program wants.
    void yield_to_others() const;

    static constexpr std::size_t most_output_bytes = 64 * 1024;

  private:
    bool read_output();
    bool look_for_end(bool waits);

    std::chrono::seconds longest_end_;
    int pid_ = -1;
    int pipe_ = -1;
    std::string output_;
    std::optional<int> status_;
};

}  // namespace osteomill
