// The common body of every main function: parse, run, report a failure in one line.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>

#include "common/log/line_stream.h"
#include "common/text/foreign_text.h"

namespace osteomill {

/// Options to run with, or a text (help, version) to print and be done.
template <typename Options>
struct ParseResult {
    std::optional<Options> options;
    std::string text;
};

/// The value that `read` makes of an option. If it throws std::invalid_argument, the message names the
/// option.
template <typename Read>
auto said_of_option(const char* option, Read&& read) {
    try {
        return read();
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("{}: {}", option, error.what()));
    }
}

// The signals that end a program, as a flag, so that it can save its data first.

/// From now on SIGINT, SIGTERM and SIGHUP (lost terminal; not under nohup) set the flag, and do nothing more,
/// however often they come. A pipe without a reader, and a file over the limit of `ulimit -f`, fail like a
/// full disk instead of ending the program.
const std::atomic<bool>& stop_on_signals();

/// From now on these signals end the program at once: for a program with nothing to save that may have to
/// wait.
void end_on_signals();

/// The second half of stop_on_signals() alone.
void ignore_signals_of_streams();

inline constexpr int exit_success = 0;
inline constexpr int exit_failure = 1;
inline constexpr int exit_wrong_usage = 2;

/// Success if all that was printed has arrived; else prints why not. A reader that has enough may leave.
inline int exit_code_of_prints(const char* name) {
    if ((std::fflush(stdout) == 0 && std::ferror(stdout) == 0) || errno == EPIPE) return exit_success;
    std::fprintf(stderr, "%s: standard output: %s\n", name, std::strerror(errno));
    return exit_failure;
}

/// Returns the exit code. `parse()` gives a ParseResult and throws std::invalid_argument for
/// wrong usage; `run(options, output)` throws for a failure. Ends even if a terminal blocks its output, at
/// most a moment later.
template <typename Parse, typename Run>
int run_program(const char* name, const Parse& parse, const Run& run) {
    ignore_signals_of_streams();
    decltype(parse()) parsed;
    try {
        parsed = parse();
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "%s: %s\n", name, printable(error.what()).c_str());
        return exit_wrong_usage;
    }
    if (!parsed.options) {
        std::fputs(parsed.text.c_str(), stdout);
        return exit_code_of_prints(name);
    }
    const ProgramOutput output;
    int exit_code = exit_success;
    try {
        // Standard output is for programs that wait for "listening on"; the log is for people.
        log_to(output.err, name);
        run(*parsed.options, output);
    } catch (const std::exception& error) {
        output.err->say(fmt::format("{}: {}", name, error.what()), "error");
        exit_code = exit_failure;
    }
    output.finish();
    return std::max(exit_code, exit_code_of_prints(name));
}

}  // namespace osteomill
