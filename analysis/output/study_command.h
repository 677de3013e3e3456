// A study as a subcommand of its program.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct StudyCommand {
    CLI::App* subcommand;
    /// Does what the subcommand's options say, once they are parsed. Throws std::exception in one line.
    std::function<void(const StudySurroundings&)> run;
};

/// The folder that every study writes into.
inline CLI::Option* add_out(CLI::App& subcommand, std::filesystem::path& out) {
    return subcommand.add_option("--out", out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
}

}  // namespace osteomill::study
