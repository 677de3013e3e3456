// The contact models by the names that --force-model takes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "haptic_server/milling/contact_model.h"

namespace osteomill {

/// Names for --force-model, in the order of --help; the first is the default.
std::vector<std::string> force_model_names();

/// `burrs` and `tissues` as in the scene. Throws std::invalid_argument for an unknown name, listing the known
/// ones, and for what the model refuses.
std::unique_ptr<ContactModel> make_contact_model(const std::string& name, Bone bone, std::vector<Burr> burrs,
                                                 const std::vector<Tissue>& tissues);

}  // namespace osteomill
