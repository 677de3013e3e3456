#include "common/program/run_program.h"

#include <array>
#include <csignal>

namespace osteomill {

namespace {

constexpr std::array stop_signals{SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> stop_requested{false};  // a signal handler may use nothing else
static_assert(std::atomic<bool>::is_always_lock_free);

void handle(int signal, void (*handler)(int)) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    // nohup, or a shell that is to leave it running when it ends.
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) return;
    struct sigaction action {};
    action.sa_handler = handler;
    // Libraries that write files take an interrupted call for a failure.
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
}

}  // namespace

const std::atomic<bool>& stop_on_signals() {
    ignore_signals_of_streams();
    for (const int signal : stop_signals) handle(signal, [](int) { stop_requested.store(true); });
    return stop_requested;
}

void end_on_signals() {
    for (const int signal : stop_signals) handle(signal, SIG_DFL);
}

void ignore_signals_of_streams() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace osteomill
