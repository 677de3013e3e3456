// Finding of haptic_server --check: the thing checked, its fault, the fault's cost, the remedy.
#pragma once

#include <string>
#include <vector>

namespace osteomill {

struct CheckRow {
    std::string what;    ///< such as "page locking"
    std::string found;   ///< as it is: "allowed", "not allowed"
    std::string cost{};  ///< the effect that a user notices; empty: nothing is wrong
    std::string mend{};  ///< a command, or advice if none helps
    /// A session goes without: it costs comfort, not safety or data.
    bool can_wait = false;

    bool is_right() const { return cost.empty(); }
};

/// A line for each that is right, three for each that is not, and a last one that says how many are wrong.
std::string text_of(const std::vector<CheckRow>& rows);

/// Whether something is wrong that cannot wait.
bool must_be_mended(const std::vector<CheckRow>& rows);

}  // namespace osteomill
