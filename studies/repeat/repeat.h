// A study that is run again from its folder's manifest, and what differs.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace osteomill::study {

/// The subcommand `repeat DIR`: runs the command of DIR's manifest, one of `studies`, twice with this program
/// and says in which columns of its tables DIR differs from both by more than they differ from one another.
/// What it returns does that once the options are parsed, and says whether nothing differs; it throws
/// std::runtime_error in one line where DIR has no manifest or the command fails.
std::function<bool(std::ostream& said)> add_repeat(CLI::App& app, std::vector<std::string> studies);

}  // namespace osteomill::study
