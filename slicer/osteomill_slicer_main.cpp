// osteomill_slicer: shows a session of haptic_server in 3D Slicer.
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "common/net/listen_address.h"
#include "common/net/tls_options.h"
#include "common/program/command_options.h"
#include "common/program/run_program.h"
#include "slicer/slicer_session.h"

namespace osteomill {

namespace {

struct Options {
    ServerAddress server{};
    std::optional<TlsFiles> tls{};  ///< nothing: in the clear
    std::uint16_t port = 18944;     ///< on loopback, for 3D Slicer; 0: a free one
};

/// Throws std::invalid_argument with one line for wrong usage.
ParseResult<Options> parsed(int argc, const char* const* argv) {
    Options options;
    CommandOptions app("Shows a session of haptic_server in 3D Slicer, by OpenIGTLink.", "osteomill_slicer",
                       "osteomill_slicer " OSTEOMILL_VERSION);
    std::string server;
    const CommandOption connect =
        app.add_option("--connect", server, "The server's HOST:PORT (127.0.0.1:7010)").type_name("HOST:PORT");
    const TlsOptions tls(app);
    app.add_option("--port", options.port,
                   "On this machine, which 3D Slicer connects to (18944); 0: a free one")
        .check(whole_within(0, 65535));
    if (auto text = app.parse_or_text(argc, argv)) return {std::nullopt, *std::move(text)};
    if (connect.count() > 0) try {
            options.server = parse_server_address(server);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument(fmt::format("--connect: {}", error.what()));
        }
    options.tls = tls.files();
    return {options, {}};
}

/// Runs until a signal asks for the end.
void run(const Options& options, const ProgramOutput& output) {
    constexpr std::chrono::milliseconds frame{33};
    const std::atomic<bool>& is_stopped = stop_on_signals();
    BoneLink link(options.server.host, options.server.port, std::nullopt, options.tls);
    SlicerSession session(link, options.port);
    output.out->say(fmt::format("listening on 127.0.0.1:{}", session.port()));
    while (!is_stopped) session.run_for(frame);
}

}  // namespace

}  // namespace osteomill

int osteomill_slicer_main(int argc, char** argv) {
    return osteomill::run_program(
        "osteomill_slicer", [&] { return osteomill::parsed(argc, argv); }, osteomill::run);
}
