// bone_export: a bone file in, its surface for other programs out.
#include <atomic>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>

#include "analysis/surface/export_bone.h"
#include "common/log/line_stream.h"
#include "common/program/run_program.h"

namespace {

/// Draws the progress on a terminal only: the work has three parts, whose progress is of no use in a log.
/// Throws once a signal asks for the end.
void run(const osteomill::ExportOptions& options, const osteomill::ProgramOutput& output) {
    const std::atomic<bool>& is_stopped = osteomill::stop_on_signals();
    osteomill::LineStreamBuffer buffer(*output.err);
    std::ostream messages(&buffer);
    std::optional<osteomill::ProgressLine> line;
    if (output.err->is_terminal()) line.emplace(messages, true, "exporting");
    std::string made;
    osteomill::export_bone(
        options, [&](const std::string& text) { made += (made.empty() ? "" : "\n") + text; },
        [&](double done) {
            if (is_stopped) throw std::runtime_error("stopped; nothing was written");
            if (line) line->report(done);
        });
    if (line) line->report(1.0);
    line.reset();
    output.err->say(made);
}

}  // namespace

int bone_export_main(int argc, char** argv) {
    return osteomill::run_program(
        "bone_export", [&] { return osteomill::parse_export_command_line(argc, argv, OSTEOMILL_VERSION); },
        run);
}
