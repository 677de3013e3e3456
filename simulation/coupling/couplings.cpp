#include "simulation/coupling/couplings.h"

#include <algorithm>
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
CouplingFactory plain() {
    return [](const CouplingOptions& options) { return std::make_unique<Kind>(options); };
}

CouplingFactory direct(ForceEstimate estimate, ForceShape shape) {
    return [=](const CouplingOptions& options) {
        return std::make_unique<DirectCoupling>(estimate, shape, options);
    };
}

CouplingFactory with_damper(CouplingFactory base) {
    return [base = std::move(base)](const CouplingOptions& options) {
        return std::make_unique<VirtualDamper>(base(options), options);
    };
}

CouplingFactory with_passivity(CouplingFactory base) {
    return [base = std::move(base)](const CouplingOptions& options) {
        return std::make_unique<PassivityControl>(base(options), options);
    };
}

/// An addition to a coupling, chosen as NAME+ADDITION.
struct CouplingAddition {
    std::string name;
    CouplingFactory (*add_to)(CouplingFactory base);
};

const std::vector<CouplingAddition>& additions() {
    static const std::vector<CouplingAddition> table{{"damper", with_damper}, {"passivity", with_passivity}};
    return table;
}

template <typename Row>
const Row* row_named(const std::vector<Row>& table, const std::string& name) {
    const auto row =
        std::find_if(table.begin(), table.end(), [&](const Row& each) { return each.name == name; });
    return row == table.end() ? nullptr : &*row;
}

}  // namespace

const std::vector<CouplingEntry>& couplings() {
    using Estimate = ForceEstimate;
    const CouplingFactory hold = direct(Estimate::newest, ForceShape::held);
    static const std::vector<CouplingEntry> table{
        {.name = "implicit",
         .text = "a burr on a spring, solved with the milling force at the tick's end",
         .needs_cutting_law = true,
         .takes_fixtures = true,
         .make = plain<ImplicitCoupling>()},
        {.name = "hold", .text = "the newest model force, held", .takes_addition = true, .make = hold},
        {.name = "interpolate",
         .text = "a line from one model force to the next, as published",
         .is_interpolated = true,
         .takes_addition = true,
         .make = direct(Estimate::newest, ForceShape::line)},
        {.name = "sample-estimate-hold",
         .text = "an estimate of the coming period's mean force, held",
         .takes_addition = true,
         .make = direct(Estimate::trapezoid, ForceShape::held)},
        {.name = "corrected-sample-estimate-hold",
         .text = "the same, less what the last estimate got wrong",
         .takes_addition = true,
         .make = direct(Estimate::corrected, ForceShape::held)},
        {.name = "sample-estimate-interpolate",
         .text = "a line from one such estimate to the next, as published",
         .is_interpolated = true,
         .takes_addition = true,
         .make = direct(Estimate::trapezoid, ForceShape::line)},
        {.name = "virtual-coupling",
         .text = "a virtual tool with a mass under the held force, tied to the hand",
         .takes_fixtures = true,
         .make = plain<VirtualCoupling>()},
        {.name = "passivity",
         .text = "hold, damped while it has given more than it took",
         .make = with_passivity(hold)},
        {.name = "damper", .text = "hold, with a virtual damper", .make = with_damper(hold)}};
    return table;
}

std::vector<std::string> coupling_names() {
    std::vector<std::string> names;
    for (const CouplingEntry& coupling : couplings()) names.push_back(coupling.name);
    return names;
}

std::string coupling_choices() {
    std::string choices;
    for (const CouplingEntry& coupling : couplings()) choices += coupling.name + ", ";
    return choices + "or one that holds or interpolates followed by +damper or +passivity";
}

CouplingEntry find_coupling(const std::string& name) {
    if (const CouplingEntry* const coupling = row_named(couplings(), name)) return *coupling;
    if (const std::size_t plus = name.find('+'); plus != std::string::npos) {
        const CouplingEntry* const base = row_named(couplings(), name.substr(0, plus));
        const CouplingAddition* const addition = row_named(additions(), name.substr(plus + 1));
        if (base && base->takes_addition && addition)
            return {.name = name,
                    .text = base->text + ", with " + addition->name,
                    .is_interpolated = base->is_interpolated,
                    .make = addition->add_to(base->make)};
    }
    throw std::invalid_argument("unknown coupling '" + name + "'; choose " + coupling_choices());
}

std::unique_ptr<Coupling> make_coupling(const std::string& name, const CouplingOptions& options) {
    const CouplingEntry coupling = find_coupling(name);
    if (coupling.needs_cutting_law && options.model_holds_wall)
        throw std::invalid_argument("the " + name +
                                    " coupling solves a cutting law, and the force model has none; choose "
                                    "another, such as interpolate");
    if (options.fixtures && !coupling.takes_fixtures)
        throw std::invalid_argument(
            "the " + name +
            " coupling takes no [[fixture]], for its burr is rigidly the hand; choose "
            "implicit or virtual-coupling, or set the fixtures' 'on' to false");
    return coupling.make(options);
}

}  // namespace osteomill
