// osteomill_slicer: shows a session of haptic_server in 3D Slicer.
#include <spdlog/spdlog.h>

#include <chrono>

#include "common/program/run_program.h"
#include "slicer/slicer_options.h"
#include "slicer/slicer_session.h"

namespace {

/// Runs until a signal asks for the end.
void run(const osteomill::SlicerOptions& options, const osteomill::ProgramOutput& output) {
    constexpr std::chrono::milliseconds frame{33};
    const std::atomic<bool>& is_stopped = osteomill::stop_on_signals();
    osteomill::BoneLink link(options.server.host, options.server.port, std::nullopt, options.tls);
    osteomill::SlicerSession session(link, options.port);
    output.out->say(fmt::format("listening on 127.0.0.1:{}", session.port()));
    while (!is_stopped) session.run_for(frame);
}

}  // namespace

int main(int argc, char** argv) {
    return osteomill::run_program(
        "osteomill_slicer",
        [&] { return osteomill::parse_slicer_command_line(argc, argv, OSTEOMILL_VERSION); }, run);
}
