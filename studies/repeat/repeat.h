// A study that is run again from its folder's manifest, and what differs.
#pragma once

#include <functional>
#include <iosfwd>
#include <vector>

#include "analysis/output/study_command.h"

namespace CLI {
class App;
}

namespace osteomill::study {

/// The subcommand `repeat DIR`: runs what DIR's manifest says (kept_command.h), one of `studies`, twice with
/// this program and says in which columns of its tables DIR differs from both by more than they differ from
/// one another. What it returns does that once the options are parsed, and says whether nothing differs; it
/// throws std::runtime_error in one line where DIR has no manifest or the command fails.
std::function<bool(std::ostream& said)> add_repeat(CLI::App& app, std::vector<StudyCommand> studies);

}  // namespace osteomill::study
