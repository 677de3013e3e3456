#include "analysis/output/study_command.h"

#include <CLI/CLI.hpp>

namespace osteomill::study {

void add_out(CLI::App& subcommand, std::filesystem::path& out) {
    subcommand.add_option("--out", out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
}

}  // namespace osteomill::study
