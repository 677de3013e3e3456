#include "analysis/sessions/sessions_options.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/sessions/sessions_study.h"
#include "common/text/address_text.h"

namespace osteomill::study {

StudyCommand add_sessions(CLI::App& app, const std::string& version) {
    const auto shared = std::make_shared<SessionsStudyOptions>();
    SessionsStudyOptions& options = *shared;
    options.version = version;
    CLI::App* sessions = app.add_subcommand(
        "sessions",
        "recorded sessions of several trainees: tables, learning curves, an overview, a tidy CSV");
    sessions
        ->add_option("DIR", options.from,
                     "recordings, folders of recordings, or folders of folders of haptic_server --report")
        ->required();
    sessions
        ->add_option("--groups", options.groups,
                     "which group each trainee is in: a CSV of lines TRAINEE,GROUP (default: groups.csv in "
                     "DIR); \"expert\" is the group that others are shown against")
        ->check(CLI::ExistingFile);
    sessions->add_option("--compare", options.compare, "two groups to compare, if there are more")
        ->expected(2);
    sessions
        ->add_option("--database", options.database,
                     "add the sessions to this PostgreSQL database, too: postgresql://USER@HOST/NAME")
        ->check([](const std::string& url) {
            return holds_password(url) ? std::string(
                                             "holds a password, which everybody on this machine "
                                             "could read; write it into ~/.pgpass, the file of "
                                             "PGPASSFILE, or a service (service=NAME)")
                                       : std::string();
        });
    add_out(*sessions, options.out);
    return {
        .subcommand = sessions,
        .run = [shared](const StudySurroundings& surroundings) { run_sessions_study(*shared, surroundings); },
        .jobs = jobs_of_processors(),
        .writes_elsewhere = true,
        .writes = {"sessions.*", "cases-*.jsonl", "*.svg"}};
}

}  // namespace osteomill::study
