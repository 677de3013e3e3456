// Table of the couplings that --coupling names. To add one is a class beside these and a row in
// couplings.cpp.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "simulation/coupling/coupling.h"

namespace osteomill {

using CouplingFactory = std::function<std::unique_ptr<Coupling>(const CouplingOptions& options)>;

/// One row of the table.
struct CouplingEntry {
    std::string name;
    std::string text;                ///< a few words for --help
    bool needs_cutting_law = false;  ///< it solves one: not with a force model that has none
    bool is_interpolated = false;    ///< a line between two model forces, as the published method has it
    bool takes_addition = false;     ///< it can be combined: NAME+damper, NAME+passivity
    bool takes_fixtures = false;     ///< its burr is on a spring, and fixtures act on that
    CouplingFactory make;
};

/// In the order of --help; the first is the default.
const std::vector<CouplingEntry>& couplings();
std::vector<std::string> coupling_names();

/// The choices of --coupling in one line: the names, and how some are combined with a virtual damper
/// (NAME+damper) or passivity control (NAME+passivity).
std::string coupling_choices();

/// The entry of a name or a combination. Throws std::invalid_argument with the choices for anything else.
CouplingEntry find_coupling(const std::string& name);

/// Throws as find_coupling does, and std::invalid_argument for a coupling that needs a cutting law with a
/// model that has none, or that takes no fixtures where there are some.
std::unique_ptr<Coupling> make_coupling(const std::string& name, const CouplingOptions& options);

}  // namespace osteomill
