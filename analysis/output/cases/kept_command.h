// The command that a file of a study keeps, of a manifest or of cases: data of which a command line is made.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/output/study_command.h"

namespace osteomill::study {

/// The words of a command line for one of `studies`: its name, its options, their values. Throws
/// std::runtime_error in one line that begins with `file` where the words name no such study or another one
/// beside it, an option that it does not have, or one that says where it writes or how it is run (--out,
/// --merge, --shard, --jobs, --database), and more values than an option takes.
std::vector<std::string> command_of_study(std::span<const StudyCommand> studies,
                                          const std::vector<std::string>& kept, const std::string& file);

}  // namespace osteomill::study
