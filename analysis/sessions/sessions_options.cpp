#include "analysis/sessions/sessions_options.h"

namespace osteomill::study {

CLI::App* add_sessions(CLI::App& app, SessionsStudyOptions& options) {
    CLI::App* sessions = app.add_subcommand(
        "sessions",
        "recorded sessions of several trainees: tables, learning curves, an overview, a tidy CSV");
    sessions
        ->add_option("DIR", options.from,
                     "recordings, folders of recordings, or folders of folders of haptic_server --report")
        ->required();
    sessions->add_option("--out", options.out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
    return sessions;
}

}  // namespace osteomill::study
