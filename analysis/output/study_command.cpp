#include "analysis/output/study_command.h"

#include <CLI/CLI.hpp>

#include "common/files/distinct_files.h"

namespace osteomill::study {

void add_out(CLI::App& subcommand, std::filesystem::path& out) {
    subcommand.add_option("--out", out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
}

void require_distinct_files(const StudyCommand& study) {
    std::vector<NamedFile> files;
    std::filesystem::path out;
    for (const CLI::Option* const option : study.subcommand->get_options()) {
        if (option->get_name() == "--out") {
            out = option->as<std::string>();
            continue;
        }
        std::error_code failed;
        for (const std::string& text : option->results())
            if (std::filesystem::is_regular_file(text, failed))
                files.push_back({option->get_name(), text, false});
    }
    std::vector<const char*> names = study.writes;
    names.push_back("manifest.json");
    const std::vector<NamedFile> written = files_written_in("--out", out, names);
    files.insert(files.end(), written.begin(), written.end());
    require_distinct(files);
}

}  // namespace osteomill::study
