// Runs a real program for an integration test: its standard output and error are collected, and waiting has a
// deadline, so a test fails instead of hanging.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/eventually.h"

namespace osteomill::testing {

class ChildProcess {
  public:
    /// Descriptors that a program gets in place of collected streams; -1: the stream is collected.
    struct Streams {
        int out = -1;
        int err = -1;
    };

    /// Starts a program (absolute path first, then arguments). Throws std::system_error if it cannot.
    explicit ChildProcess(const std::vector<std::string>& command) : ChildProcess(command, Streams{}) {}
    ChildProcess(const std::vector<std::string>& command, const Streams& instead);
    ~ChildProcess();  ///< kills what still runs
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Reads output until a line begins with `prefix`; gives the rest of that line, or nullopt at the
    /// deadline or the program's end.
    std::optional<std::string> line_after(const std::string& prefix,
                                          std::chrono::seconds deadline = far_too_long);

    /// HOST:PORT at which a server listens, as it says it; nullopt at the deadline or its end.
    std::optional<std::string> address() { return line_after("listening on "); }

    /// Reads its output since the last call; waits up to 0.1 s for more.
    void read_output() { pump(std::chrono::milliseconds(100)); }

    /// Waits for the end; the exit status, 128 + the signal that ended it, or nullopt at the deadline.
    std::optional<int> wait(std::chrono::seconds deadline = far_too_long);

    void send_signal(int signal) const;
    pid_t pid() const { return pid_; }

    /// The text on standard output and standard error so far.
    const std::string& out() const { return streams_[0].text; }
    const std::string& err() const { return streams_[1].text; }

  private:
    struct Stream {
        int descriptor = -1;
        std::string text;
    };
    bool pump(std::chrono::milliseconds at_most);  // false once both streams are closed

    pid_t pid_ = -1;
    Stream streams_[2];
    std::optional<int> status_;
};

/// Runs a program to its end.
struct Finished {
    int status = -1;
    std::string out;
    std::string err;
};
Finished run_program(const std::vector<std::string>& command, std::chrono::seconds deadline = far_too_long);

}  // namespace osteomill::testing
