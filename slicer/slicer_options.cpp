#include "slicer/slicer_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "common/net/tls_options.h"

namespace osteomill {

ParseResult<SlicerOptions> parse_slicer_command_line(int argc, const char* const* argv,
                                                     const std::string& version) {
    SlicerOptions options;
    CLI::App app("Shows a session of haptic_server in 3D Slicer, by OpenIGTLink.", "osteomill_slicer");
    app.set_version_flag("--version", fmt::format("osteomill_slicer {}", version));
    std::string server;
    CLI::Option* const connect =
        app.add_option("--connect", server, "The server's HOST:PORT (127.0.0.1:7010)")
            ->type_name("HOST:PORT");
    const TlsOptions tls(app);
    app.add_option("--port", options.port,
                   "On this machine, which 3D Slicer connects to (18944); 0: a free one")
        ->check(CLI::Range(0, 65535));
    if (auto text = parse_or_text(app, argc, argv)) return {std::nullopt, *std::move(text)};
    if (connect->count() > 0) try {
            options.server = parse_server_address(server);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument(fmt::format("--connect: {}", error.what()));
        }
    options.tls = tls.files();
    return {options, {}};
}

}  // namespace osteomill
