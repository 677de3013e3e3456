#include "haptic_server/milling/force_models.h"

#include <stdexcept>
#include <utility>

#include "haptic_server/milling/milling_model.h"

namespace osteomill {

std::vector<std::string> force_model_names() {
    return {"milling", "milling-bins"};
}

std::unique_ptr<ContactModel> make_contact_model(const std::string& name, Bone bone, std::vector<Burr> burrs,
                                                 const std::vector<Tissue>& tissues) {
    if (name == "milling")
        return std::make_unique<MillingModel>(std::move(bone), std::move(burrs), tissues,
                                              ForceSummation::voxels);
    if (name == "milling-bins")
        return std::make_unique<MillingModel>(std::move(bone), std::move(burrs), tissues,
                                              ForceSummation::bins);
    throw std::invalid_argument("unknown force model '" + name + "'; choose milling or milling-bins");
}

}  // namespace osteomill
