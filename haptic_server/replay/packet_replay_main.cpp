// packet_replay: a recording in, a session for clients, a report or a film out.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "common/program/run_program.h"
#include "haptic_server/replay/replay.h"

namespace {

/// Becomes the program that draws, which lies beside this one. Throws if it cannot be run.
[[noreturn]] void become_render_client(const osteomill::ReplayOptions& options) {
    const std::string program =
        std::filesystem::read_symlink("/proc/self/exe").replace_filename("render_client").string();
    ::execl(program.c_str(), "render_client", "--replay", options.recording.c_str(), "--film",
            options.film->c_str(), "--from-s", fmt::format("{}", options.from_s).c_str(), "--speed",
            fmt::format("{}", options.speed).c_str(), nullptr);
    throw std::runtime_error(
        fmt::format("--film: {} cannot be run; it is in Debian's package osteomill-client", program));
}

}  // namespace

int packet_replay_main(int argc, char** argv) {
    return osteomill::run_program(
        "packet_replay", [&] { return osteomill::parse_replay_command_line(argc, argv, OSTEOMILL_VERSION); },
        [](const osteomill::ReplayOptions& options, const osteomill::ProgramOutput& output) {
            if (options.film) become_render_client(options);
            osteomill::run_replay(options, osteomill::stop_on_signals(), output);
        });
}
