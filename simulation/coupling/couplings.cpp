#include "simulation/coupling/couplings.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

#include "simulation/coupling/direct_coupling.h"
#include "simulation/coupling/implicit_coupling.h"
#include "simulation/coupling/passivity_control.h"
#include "simulation/coupling/virtual_coupling.h"
#include "simulation/coupling/virtual_damper.h"

namespace osteomill {

namespace {

template <typename Kind>
std::unique_ptr<Coupling> plain(const CouplingOptions& options) {
    return std::make_unique<Kind>(options);
}

template <ForceEstimate estimate, ForceShape shape>
std::unique_ptr<Coupling> direct(const CouplingOptions& options) {
    return std::make_unique<DirectCoupling>(estimate, shape, options);
}

constexpr std::array addition_names{std::pair{CouplingAddition::damper, "damper"},
                                    std::pair{CouplingAddition::passivity, "passivity"}};

std::optional<CouplingAddition> addition_named(std::string_view name) {
    for (const auto& [addition, its_name] : addition_names)
        if (name == its_name) return addition;
    return std::nullopt;
}

const CouplingEntry* row_named(std::string_view name) {
    const auto row = std::ranges::find(couplings(), name, &CouplingEntry::name);
    return row == couplings().end() ? nullptr : &*row;
}

std::string choices() {
    std::string names;
    for (const CouplingEntry& coupling : couplings()) names += coupling.name + ", ";
    return names + "or one that holds or interpolates followed by +damper or +passivity";
}

}  // namespace

const std::vector<CouplingEntry>& couplings() {
    using Kind = CouplingKind;
    using Estimate = ForceEstimate;
    static const std::vector<CouplingEntry> table{
        {.name = "implicit",
         .text = "a burr on a spring, solved with the milling force at the tick's end",
         .choice = {Kind::implicit},
         .needs_cutting_law = true,
         .takes_fixtures = true,
         .make = plain<ImplicitCoupling>},
        {.name = "hold",
         .text = "the newest model force, held",
         .choice = {Kind::hold},
         .takes_addition = true,
         .make = direct<Estimate::newest, ForceShape::held>},
        {.name = "interpolate",
         .text = "a line from one model force to the next, as published",
         .choice = {Kind::interpolate},
         .is_interpolated = true,
         .takes_addition = true,
         .make = direct<Estimate::newest, ForceShape::line>},
        {.name = "sample-estimate-hold",
         .text = "an estimate of the coming period's mean force, held",
         .choice = {Kind::sample_estimate_hold},
         .takes_addition = true,
         .make = direct<Estimate::trapezoid, ForceShape::held>},
        {.name = "corrected-sample-estimate-hold",
         .text = "the same, less what the last estimate got wrong",
         .choice = {Kind::corrected_sample_estimate_hold},
         .takes_addition = true,
         .make = direct<Estimate::corrected, ForceShape::held>},
        {.name = "sample-estimate-interpolate",
         .text = "a line from one such estimate to the next, as published",
         .choice = {Kind::sample_estimate_interpolate},
         .is_interpolated = true,
         .takes_addition = true,
         .make = direct<Estimate::trapezoid, ForceShape::line>},
        {.name = "virtual-coupling",
         .text = "a virtual tool with a mass under the held force, tied to the hand",
         .choice = {Kind::virtual_coupling},
         .takes_fixtures = true,
         .make = plain<VirtualCoupling>},
        {.name = "passivity",
         .text = "hold, damped while it has given more than it took",
         .choice = {Kind::hold, CouplingAddition::passivity},
         .make = direct<Estimate::newest, ForceShape::held>},
        {.name = "damper",
         .text = "hold, with a virtual damper",
         .choice = {Kind::hold, CouplingAddition::damper},
         .make = direct<Estimate::newest, ForceShape::held>}};
    return table;
}

const CouplingEntry& entry_of(CouplingKind kind) {
    return *std::ranges::find(couplings(), CouplingChoice{kind}, &CouplingEntry::choice);
}

CouplingChoice coupling_named(std::string_view name) {
    if (const CouplingEntry* const coupling = row_named(name)) return coupling->choice;
    if (const std::size_t plus = name.find('+'); plus != std::string_view::npos) {
        const CouplingEntry* const base = row_named(name.substr(0, plus));
        const std::optional<CouplingAddition> addition = addition_named(name.substr(plus + 1));
        if (base && base->takes_addition && addition) return {base->choice.kind, *addition};
    }
    throw std::invalid_argument("unknown coupling '" + std::string(name) + "'; choose " + choices());
}

std::string name_of(const CouplingChoice& choice) {
    std::string name = entry_of(choice.kind).name;
    for (const auto& [addition, its_name] : addition_names)
        if (addition == choice.addition) name += std::string("+") + its_name;
    return name;
}

void require_cutting_law(const CouplingChoice& choice, bool has_cutting_law) {
    if (entry_of(choice.kind).needs_cutting_law && !has_cutting_law)
        throw std::invalid_argument("the " + name_of(choice) +
                                    " coupling solves a cutting law, and the force model has none; choose "
                                    "another, such as interpolate");
}

std::unique_ptr<Coupling> make_coupling(const CouplingChoice& choice, const CouplingOptions& options) {
    const CouplingEntry& entry = entry_of(choice.kind);
    require_cutting_law(choice, !options.model_holds_wall);
    if (options.fixtures && !entry.takes_fixtures)
        throw std::invalid_argument(
            "the " + name_of(choice) +
            " coupling takes no [[fixture]], for its burr is rigidly the hand; choose "
            "implicit or virtual-coupling, or set the fixtures' 'on' to false");
    std::unique_ptr<Coupling> coupling = entry.make(options);
    switch (choice.addition) {
        case CouplingAddition::damper:
            return std::make_unique<VirtualDamper>(std::move(coupling), options);
        case CouplingAddition::passivity:
            return std::make_unique<PassivityControl>(std::move(coupling), options);
        case CouplingAddition::none:
            break;
    }
    return coupling;
}

}  // namespace osteomill
