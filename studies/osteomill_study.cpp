// osteomill_study: what the simulator's choices cost and what they are worth. Parses, runs a study, says
// where its files are.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/output/cases/kept_command.h"
#include "analysis/output/repeated/manifest.h"
#include "common/program/commit.h"
#include "common/program/option_checks.h"
#include "common/text/address_text.h"
#include "common/text/plain_text.h"
#include "studies/render/render_study.h"
#include "studies/repeat/repeat.h"

int main(int argc, char** argv) {
    using namespace osteomill;
    using namespace osteomill::study;
    constexpr int exit_failure = 1;
    constexpr int exit_usage = 2;
    CLI::App app("Studies of the simulator: numbers and charts.", "osteomill_study");
    app.set_version_flag("--version", OSTEOMILL_VERSION);
    app.require_subcommand(0, 1);
    const std::vector<StudyCommand> studies{add_render(app)};
    std::vector<std::string> names;
    std::vector<StudyCommand> repeated;
    for (const StudyCommand& study : studies) {
        names.push_back(study.subcommand->get_name());
        if (!study.writes_elsewhere) repeated.push_back(study);
    }
    const auto repeats_alike = add_repeat(app, repeated);
    StudyParts parts;
    for (const StudyCommand& study : studies) add_parts(*study.subcommand, parts, study.jobs);
    try {
        const std::vector<std::string> words = command_line({argv + 1, argv + argc}, parts);
        if (parts.joined) (void)command_of_study(studies, parts.command, "the parts of --merge");
        std::vector<const char*> arguments{argv[0]};
        for (const std::string& word : words) arguments.push_back(word.c_str());
        parse_arguments(app, static_cast<int>(arguments.size()), arguments.data());
        if (app.get_subcommands().empty())
            throw CLI::RequiredError(fmt::format("a study to run: {} or repeat", fmt::join(names, ", ")));
        for (const StudyCommand& study : studies)
            if (study.subcommand->parsed()) require_distinct_files(study);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "osteomill_study: " << without_passwords(printable(error.what())) << " (see --help)\n";
        return exit_usage;
    } catch (const std::invalid_argument& error) {
        std::cerr << "osteomill_study: " << without_passwords(printable(error.what())) << " (see --help)\n";
        return exit_usage;
    } catch (const std::exception& error) {
        std::cerr << "osteomill_study: " << without_passwords(printable(error.what())) << '\n';
        return exit_failure;
    }
    try {
        for (const StudyCommand& study : studies) {
            if (!study.subcommand->parsed()) continue;
            if (study.runs_one_by_one || study.subcommand->count("--jobs") == 0) parts.jobs = study.jobs;
            study.run({.said = std::cout,
                       .progress = std::cerr,
                       .is_terminal = ::isatty(STDERR_FILENO) != 0,
                       .parts = parts});
            if (parts.shard.of == 1)
                write_manifest({parts.command, OSTEOMILL_VERSION, std::string(built_from_commit())},
                               *study.subcommand, study.subcommand->get_option("--out")->as<std::string>());
        }
        return repeats_alike(std::cout) ? 0 : exit_failure;
    } catch (const std::exception& error) {
        std::cerr << "osteomill_study: " << without_passwords(printable(error.what())) << '\n';
        return exit_failure;
    }
}
