// bone_export: a bone file in, its surface for other programs out.
#include "analysis/surface/export_bone.h"
#include "common/program/run_program.h"

int main(int argc, char** argv) {
    return osteomill::run_program(
        "bone_export", [&] { return osteomill::parse_export_command_line(argc, argv, OSTEOMILL_VERSION); },
        [](const osteomill::ExportOptions& options, const osteomill::ProgramOutput& output) {
            osteomill::export_bone(options, [&](const std::string& line) { output.err->say(line); });
        });
}
