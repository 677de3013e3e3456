// packet_replay: a recording in, a session for clients or a report out.
#include "haptic_server/replay/replay.h"
#include "common/program/run_program.h"

int main(int argc, char** argv) {
    return osteomill::run_program(
        "packet_replay", [&] { return osteomill::parse_replay_command_line(argc, argv, OSTEOMILL_VERSION); },
        [](const osteomill::ReplayOptions& options, const osteomill::ProgramOutput& output) {
            osteomill::run_replay(options, osteomill::stop_on_signals(), output);
        });
}
