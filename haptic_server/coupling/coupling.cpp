#include "haptic_server/coupling/coupling.h"

#include <stdexcept>

#include "haptic_server/coupling/implicit_coupling.h"
#include "haptic_server/coupling/interpolated_coupling.h"

namespace osteomill {

std::vector<std::string> coupling_names() {
    return {"implicit", "interpolate"};
}

std::unique_ptr<Coupling> make_coupling(const std::string& name, const CouplingOptions& options) {
    if (name == "implicit" && options.model_holds_wall)
        throw std::invalid_argument(
            "the implicit coupling solves a cutting law, and the force model has none; choose interpolate");
    if (name == "implicit") return std::make_unique<ImplicitCoupling>(options);
    if (name == "interpolate") return std::make_unique<InterpolatedCoupling>(options);
    throw std::invalid_argument("unknown coupling '" + name + "'; choose implicit or interpolate");
}

}  // namespace osteomill
