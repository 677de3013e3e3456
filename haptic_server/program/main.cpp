// The haptic server: parse, run, say in one line what went wrong.
#include <atomic>
#include <csignal>

#include "haptic_server/command_line/run_program.h"
#include "haptic_server/program/server.h"
#include "haptic_server/program/server_options.h"

namespace {

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
    return osteomill::run_program(
        "haptic_server", [&] { return osteomill::parse_command_line(argc, argv, OSTEOMILL_VERSION); },
        [](const osteomill::ServerOptions& options) {
            stop_on_signals();
            osteomill::run_server(options, OSTEOMILL_VERSION, stop_requested);
        });
}
