// The haptic server: parses, runs, reports an error in one line.
#include "common/program/run_program.h"
#include "haptic_server/program/server.h"
#include "haptic_server/program/server_options.h"

int haptic_server_main(int argc, char** argv) {
    return osteomill::run_program(
        "haptic_server", [&] { return osteomill::parse_command_line(argc, argv, OSTEOMILL_VERSION); },
        [](const osteomill::ServerOptions& options, const osteomill::ProgramOutput& output) {
            osteomill::run_server(options, OSTEOMILL_VERSION, &osteomill::stop_on_signals, output);
        });
}
