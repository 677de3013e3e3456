#include "haptic_server/coupling/coupling.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "haptic_server/coupling/direct_coupling.h"
#include "haptic_server/coupling/implicit_coupling.h"
#include "haptic_server/coupling/passivity_control.h"
#include "haptic_server/coupling/virtual_coupling.h"
#include "haptic_server/coupling/virtual_damper.h"

namespace osteomill {

namespace {

constexpr const char* damper = "damper";
constexpr const char* passivity = "passivity";
/// What `damper` and `passivity` alone are added to.
constexpr const char* plain_base = "hold";

struct DirectMethod {
    const char* name;
    const char* description;
    ForceEstimate estimate;
    ForceShape shape;
};

constexpr DirectMethod direct_methods[] = {
    {plain_base, "the newest model force, held", ForceEstimate::newest, ForceShape::held},
    {"interpolate", "a line from one model force to the next, as published", ForceEstimate::newest,
     ForceShape::line},
    {"sample-estimate-hold", "an estimate of the coming period's mean force, held", ForceEstimate::trapezoid,
     ForceShape::held},
    {"corrected-sample-estimate-hold", "the same, less what the last estimate got wrong",
     ForceEstimate::corrected, ForceShape::held},
    {"sample-estimate-interpolate", "a line from one such estimate to the next, as published",
     ForceEstimate::trapezoid, ForceShape::line}};

/// A name taken apart: BASE or BASE+ADDITION.
struct Composition {
    const DirectMethod* base = nullptr;
    std::string addition;  ///< empty: none
};

std::optional<Composition> composition(const std::string& name) {
    std::string base = name;
    std::string addition;
    if (name == damper || name == passivity) {
        base = plain_base;
        addition = name;
    } else if (const std::size_t plus = name.find('+'); plus != std::string::npos) {
        base = name.substr(0, plus);
        addition = name.substr(plus + 1);
        if (addition != damper && addition != passivity) return std::nullopt;
    }
    const auto* method = std::find_if(std::begin(direct_methods), std::end(direct_methods),
                                      [&](const DirectMethod& each) { return base == each.name; });
    if (method == std::end(direct_methods)) return std::nullopt;
    return Composition{method, addition};
}

}  // namespace

std::vector<CouplingEntry> couplings() {
    std::vector<CouplingEntry> methods{
        {.name = "implicit",
         .description = "a burr on a spring, solved with the milling force at the tick's end",
         .needs_cutting_law = true}};
    for (const DirectMethod& direct : direct_methods)
        methods.push_back({.name = direct.name,
                           .description = direct.description,
                           .is_interpolated = direct.shape == ForceShape::line});
    methods.push_back({.name = "virtual-coupling",
                       .description = "a virtual tool with a mass under the held force, tied to the hand"});
    methods.push_back(
        {.name = passivity, .description = "hold, damped while it has given more than it took"});
    methods.push_back({.name = damper, .description = "hold, with a virtual damper"});
    return methods;
}

std::vector<std::string> coupling_names() {
    std::vector<std::string> names;
    for (const CouplingEntry& method : couplings()) names.push_back(method.name);
    return names;
}

std::string coupling_choices() {
    std::string choices;
    for (const std::string& name : coupling_names()) choices += name + ", ";
    return choices + "or one that holds or interpolates followed by +damper or +passivity";
}

CouplingEntry find_coupling(const std::string& name) {
    for (const CouplingEntry& method : couplings())
        if (method.name == name) return method;
    if (const auto parts = composition(name))
        return {.name = name,
                .description = std::string(parts->base->description) + ", with " + parts->addition,
                .is_interpolated = parts->base->shape == ForceShape::line};
    throw std::invalid_argument("unknown coupling '" + name + "'; choose " + coupling_choices());
}

std::unique_ptr<Coupling> make_coupling(const std::string& name, const CouplingOptions& options) {
    if (find_coupling(name).needs_cutting_law && options.model_holds_wall)
        throw std::invalid_argument("the " + name +
                                    " coupling solves a cutting law, and the force model has none; choose "
                                    "another, such as interpolate");
    if (name == "implicit") return std::make_unique<ImplicitCoupling>(options);
    if (name == "virtual-coupling") return std::make_unique<VirtualCoupling>(options);

    const Composition parts = composition(name).value();
    auto direct = std::make_unique<DirectCoupling>(parts.base->estimate, parts.base->shape, options);
    if (parts.addition == damper) return std::make_unique<VirtualDamper>(std::move(direct));
    if (parts.addition == passivity) return std::make_unique<PassivityControl>(std::move(direct), options);
    return direct;
}

}  // namespace osteomill
