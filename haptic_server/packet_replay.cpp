// packet_replay: a recording in, a session for clients or a report out.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "haptic_server/replay/replay.h"

namespace {

constexpr int exit_success = 0;
constexpr int exit_failure = 1;
constexpr int exit_wrong_usage = 2;

std::atomic<bool> stop_requested{false};  // what a signal handler may touch
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

int main(int argc, char** argv) {
    osteomill::ReplayCommandLine command_line;
    try {
        command_line = osteomill::parse_replay_command_line(argc, argv, OSTEOMILL_VERSION);
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "packet_replay: %s\n", error.what());
        return exit_wrong_usage;
    }
    if (!command_line.options) {
        std::fputs(command_line.text.c_str(), stdout);
        return exit_success;
    }
    try {
        // Standard output is for programs that wait for "listening on"; the log is for people.
        spdlog::set_default_logger(spdlog::stderr_color_mt("packet_replay"));
        std::signal(SIGINT, [](int) { stop_requested.store(true); });
        std::signal(SIGTERM, [](int) { stop_requested.store(true); });
        osteomill::run_replay(*command_line.options, stop_requested);
        return exit_success;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "packet_replay: %s\n", error.what());
        return exit_failure;
    }
}
