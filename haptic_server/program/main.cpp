// The haptic server: parse, run, say in one line what went wrong.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "haptic_server/program/server.h"
#include "haptic_server/program/server_options.h"

namespace {

constexpr int exit_success = 0;
constexpr int exit_failure = 1;
constexpr int exit_wrong_usage = 2;

std::atomic<bool> stop_requested{false};  // what a signal handler may touch
static_assert(std::atomic<bool>::is_always_lock_free);

void stop_on_signals() {
    struct sigaction action {};
    action.sa_handler = [](int) { stop_requested.store(true); };
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // A file over the limit of `ulimit -f` is to fail like one on a full disk, not to end the program.
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace

int main(int argc, char** argv) {
    osteomill::CommandLine command_line;
    try {
        command_line = osteomill::parse_command_line(argc, argv, OSTEOMILL_VERSION);
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "haptic_server: %s\n", error.what());
        return exit_wrong_usage;
    }
    if (!command_line.options) {
        std::fputs(command_line.text.c_str(), stdout);
        return exit_success;
    }
    try {
        // Standard output is for programs that wait for "listening on"; the log is for people.
        spdlog::set_default_logger(spdlog::stderr_color_mt("haptic_server"));
        stop_on_signals();
        osteomill::run_server(*command_line.options, OSTEOMILL_VERSION, stop_requested);
        return exit_success;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "haptic_server: %s\n", error.what());
        return exit_failure;
    }
}
