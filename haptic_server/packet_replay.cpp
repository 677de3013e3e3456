// packet_replay: a recording in, a session for clients or a report out.
#include <atomic>
#include <csignal>

#include "haptic_server/command_line/run_program.h"
#include "haptic_server/replay/replay.h"

namespace {

std::atomic<bool> stop_requested{false};  // what a signal handler may touch
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

int main(int argc, char** argv) {
    return osteomill::run_program(
        "packet_replay", [&] { return osteomill::parse_replay_command_line(argc, argv, OSTEOMILL_VERSION); },
        [](const osteomill::ReplayOptions& options) {
            std::signal(SIGINT, [](int) { stop_requested.store(true); });
            std::signal(SIGTERM, [](int) { stop_requested.store(true); });
            osteomill::run_replay(options, stop_requested);
        });
}
