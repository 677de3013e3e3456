// render_client: shows what is left of the bone that haptic_server mills.
#include <fmt/format.h>

#include <csignal>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "render_client/ui/offscreen_run.h"
#include "render_client/ui/options.h"
#include "render_client/ui/windowed_run.h"

namespace {

// A signal handler may only touch a flag of this kind, and finds it nowhere but here.
volatile std::sig_atomic_t stop_signalled = 0;

bool stop_asked() {
    return stop_signalled != 0;
}

std::unique_ptr<osteomill::SessionSource> make_session(const osteomill::RenderOptions& options) {
    if (options.replay) return std::make_unique<osteomill::ReplayedSession>(*options.replay, options.speed);
    return std::make_unique<osteomill::LinkedSession>(options.host, options.port, options.record,
                                                      options.tls);
}

}  // namespace

int main(int argument_count, char** arguments) {
    using namespace osteomill;
    const ParsedOptions parsed = parse_options(argument_count, arguments, OSTEOMILL_VERSION);
    if (parsed.no_run) {
        if (parsed.no_run->exit_code == 0)
            fmt::print("{}", parsed.no_run->message);
        else
            fmt::print(stderr, "{}\n", parsed.no_run->message);
        return parsed.no_run->exit_code;
    }
    const RenderOptions& options = parsed.options;
    std::signal(SIGINT, [](int) { stop_signalled = 1; });
    std::signal(SIGTERM, [](int) { stop_signalled = 1; });
    // A file over the limit of `ulimit -f` is to fail like one on a full disk, not to end the program.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        const auto session = make_session(options);
        const RenderReport report = options.offscreen ? run_offscreen(options, *session, stop_asked)
                                                      : run_in_window(options, *session, stop_asked);
        if (!options.json.empty()) write_report(report, options.json);
        if (const std::string failure = session->finish(); !failure.empty())
            throw std::runtime_error(failure);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "render_client: {}\n", error.what());
        return 1;
    }
}
