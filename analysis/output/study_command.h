// A study as a subcommand of its program.
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "analysis/output/surroundings.h"

namespace CLI {
class App;
}

namespace osteomill::study {

struct StudyCommand {
    CLI::App* subcommand;
    /// Does what the subcommand's options say, once they are parsed. Throws std::exception in one line.
    std::function<void(const StudySurroundings&)> run;
    /// Cases that run at a time unless --jobs says otherwise; one where times are measured.
    int jobs = 1;
    bool runs_one_by_one = false;   ///< whatever --jobs says: it draws, or measures this machine
    bool writes_elsewhere = false;  ///< than into the folder of --out: `repeat` does not run it
    /// Names (fnmatch) of what it writes into that folder, of a study that reads files.
    std::vector<const char*> writes{};
};

/// Throws std::invalid_argument where a file that an option of a parsed study names is one of those that it
/// will write (distinct_files.h).
void require_distinct_files(const StudyCommand& study);

/// For cases that measure no times: as many as there are processors.
inline int jobs_of_processors() {
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// The folder that every study writes into, as its option --out.
void add_out(CLI::App& subcommand, std::filesystem::path& out);

}  // namespace osteomill::study
