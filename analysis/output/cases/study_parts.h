// Choice of the cases of a study to run: all or one part, how many at a time, or joined from parts that ran
// before.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/output/cases/joined_parts.h"
#include "analysis/output/cases/shard.h"

namespace CLI {
class App;
}

namespace osteomill::study {

struct StudyParts {
    Shard shard{};
    int jobs = 1;                         ///< cases at a time
    std::vector<std::string> command{};   ///< the study and its options; without what is said here, and --out
    std::optional<JoinedParts> joined{};  ///< nothing is run, but taken from these
};

/// --shard, --merge and --jobs of a study, into `parts`, which outlives the parsing.
void add_parts(CLI::App& study, StudyParts& parts, int usual_jobs);

/// A command line of a study, "STUDY OPTIONS": with --merge the parts are read into `parts.joined`, and what
/// they say of the study's options is put in. Throws std::runtime_error as JoinedParts does, and
/// std::invalid_argument where there are options beside --merge and --out, or the parts are of another study.
std::vector<std::string> command_line(std::vector<std::string> words, StudyParts& parts);

}  // namespace osteomill::study
