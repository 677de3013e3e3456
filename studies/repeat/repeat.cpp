#include "studies/repeat/repeat.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "analysis/output/cases/kept_command.h"
#include "analysis/output/repeated/manifest.h"
#include "analysis/output/repeated/repeated_tables.h"
#include "common/program/child_program.h"
#include "common/program/commit.h"
#include "common/text/plain_text.h"

namespace osteomill::study {

namespace {

namespace fs = std::filesystem;

/// A folder for the runs, which goes with it.
class Scratch {
  public:
    Scratch() {
        std::string name = (fs::temp_directory_path() / "osteomill-repeat-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
        folder_ = name;
    }
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    const fs::path& folder() const { return folder_; }

  private:
    fs::path folder_;
};

void run_into(const fs::path& folder, const std::vector<std::string>& study) {
    std::vector<std::string> command{fs::read_symlink("/proc/self/exe").string()};
    command.insert(command.end(), study.begin(), study.end());
    command.insert(command.end(), {"--out", folder.string()});
    ChildProgram child(command);
    while (child.is_running()) {
        child.poll();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    child.poll();
    if (*child.status() != 0) throw std::runtime_error("the study failed: " + child.last_line());
}

/// The folder may be from elsewhere: what its manifest names must be a study, which writes into its folder
/// alone.
bool repeat(const fs::path& kept, const std::vector<StudyCommand>& studies, std::ostream& said) {
    const Manifest manifest = read_manifest(kept);
    const std::vector<std::string> command =
        command_of_study(studies, manifest.command, manifest_of(kept).string());
    fmt::print(said, "{}: {}\nmade by version {} of commit {}, repeated by commit {}\n",
               printable(kept.string()), printable(fmt::format("{}", fmt::join(command, " "))),
               printable(manifest.version), printable(manifest.commit), built_from_commit());
    const Scratch scratch;
    const fs::path once = scratch.folder() / "once";
    const fs::path again = scratch.folder() / "again";
    for (const fs::path& run : {once, again}) {
        run_into(run, command);
        fmt::print(said, "run {} of 2 is done\n", run == once ? 1 : 2);
        said.flush();
    }
    const RepeatedTables tables = compare_tables(kept, once, again);
    for (const std::string& line : tables.other) fmt::print(said, "{}\n", line);
    for (const RepeatedColumn& column : tables.different)
        fmt::print(said, "{}: cells that differ: {}, by up to {:.3g}; its noise is {:.3g}\n", column.name,
                   column.differ, column.difference, column.noise);
    const std::size_t alike = tables.columns - tables.different.size();
    fmt::print(said, "{} of {} columns are as they were\n", alike, tables.columns);
    return tables.other.empty() && tables.different.empty() && tables.columns > 0;
}

}  // namespace

std::function<bool(std::ostream&)> add_repeat(CLI::App& app, std::vector<StudyCommand> studies) {
    const auto kept = std::make_shared<fs::path>();
    CLI::App* const subcommand = app.add_subcommand(
        "repeat", "run a study again, twice, and say what differs from its folder by more than its noise");
    subcommand->add_option("dir", *kept, "the folder that the study wrote")->required();
    return [subcommand, kept, studies = std::move(studies)](std::ostream& said) {
        return !subcommand->parsed() || repeat(*kept, studies, said);
    };
}

}  // namespace osteomill::study
