// A main function but for what the program is: parse, run, say in one line what went wrong.
#pragma once

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <stdexcept>

namespace osteomill {

inline constexpr int exit_success = 0;
inline constexpr int exit_failure = 1;
inline constexpr int exit_wrong_usage = 2;

/// Returns the exit code. `parse()` gives an Asked (command_line.h) and throws std::invalid_argument for
/// wrong usage; `run(options)` throws for a failure.
template <typename Parse, typename Run>
int run_program(const char* name, const Parse& parse, const Run& run) {
    decltype(parse()) asked;
    try {
        asked = parse();
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return exit_wrong_usage;
    }
    if (!asked.options) {
        std::fputs(asked.text.c_str(), stdout);
        return exit_success;
    }
    try {
        // Standard output is for programs that wait for "listening on"; the log is for people.
        spdlog::set_default_logger(spdlog::stderr_color_mt(name));
        run(*asked.options);
        return exit_success;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return exit_failure;
    }
}

}  // namespace osteomill
