// Progress of long work, for people: a bar on a terminal, a line every tenth otherwise.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace osteomill {

/// Called with the share of the work that is done, 0 to 1.
using Progress = std::function<void(double)>;

/// Writes progress of `what` to `out`.
Progress progress_on(std::ostream& out, bool is_terminal, std::string what);

}  // namespace osteomill
