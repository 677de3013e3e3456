#include "haptic_server/milling/force_models.h"

#include <stdexcept>
#include <utility>

#include "haptic_server/milling/milling_model.h"

namespace osteomill {

std::vector<std::string> force_model_names() {
    return {"milling", "milling-bins", "milling-instants"};
}

std::unique_ptr<ContactModel> make_contact_model(const std::string& name, Bone bone, std::vector<Burr> burrs,
                                                 const std::vector<Tissue>& tissues) {
    const auto milling = [&](ForceSummation summation) {
        return std::make_unique<MillingModel>(std::move(bone), std::move(burrs), tissues,
                                              MillingSettings{.summation = summation});
    };
    if (name == "milling") return milling(ForceSummation::voxels);
    if (name == "milling-bins") return milling(ForceSummation::bins);
    if (name == "milling-instants") return milling(ForceSummation::instants);
    throw std::invalid_argument("unknown force model '" + name +
                                "'; choose milling, milling-bins or milling-instants");
}

}  // namespace osteomill
