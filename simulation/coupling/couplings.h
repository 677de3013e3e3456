// Table of the couplings that --coupling names. To add one is a class beside these, a kind and a row in
// couplings.cpp.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/coupling/coupling.h"

namespace osteomill {

enum class CouplingKind {
    implicit,
    hold,
    interpolate,
    sample_estimate_hold,
    corrected_sample_estimate_hold,
    sample_estimate_interpolate,
    virtual_coupling,
};

/// A virtual damper or passivity control around a coupling that takes an addition.
enum class CouplingAddition { none, damper, passivity };

/// A coupling as somebody chose it; by default the one that solves the cutting law.
struct CouplingChoice {
    CouplingKind kind = CouplingKind::implicit;
    CouplingAddition addition = CouplingAddition::none;

    friend bool operator==(const CouplingChoice&, const CouplingChoice&) = default;
};

/// One row of the table.
struct CouplingEntry {
    std::string name;
    std::string text;  ///< a few words for --help
    CouplingChoice choice;
    bool needs_cutting_law = false;  ///< it solves one: not with a force model that has none
    bool is_interpolated = false;    ///< a line between two model forces, as the published method has it
    bool takes_addition = false;     ///< it can be combined: NAME+damper, NAME+passivity
    bool takes_fixtures = false;     ///< its burr is on a spring, and fixtures act on that
    /// The coupling without the addition.
    std::unique_ptr<Coupling> (*make)(const CouplingOptions& options);
};

/// In the order of --help; the first is the default. A row for each kind, and for combinations that have a
/// name of their own.
const std::vector<CouplingEntry>& couplings();

/// The row of a kind by itself.
const CouplingEntry& entry_of(CouplingKind kind);

/// The choice of a name or a combination (NAME+damper, NAME+passivity). Throws std::invalid_argument with the
/// choices for anything else.
CouplingChoice coupling_named(std::string_view name);

/// NAME or NAME+ADDITION, which coupling_named() reads.
std::string name_of(const CouplingChoice& choice);

/// Throws std::invalid_argument for a coupling that solves a cutting law with a force model that has none.
void require_cutting_law(const CouplingChoice& choice, bool has_cutting_law);

/// Throws as require_cutting_law() does, and std::invalid_argument for a coupling that takes no fixtures
/// where there are some.
std::unique_ptr<Coupling> make_coupling(const CouplingChoice& choice, const CouplingOptions& options);

}  // namespace osteomill
