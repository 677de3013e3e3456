// The contact models by the names that --force-model takes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "haptic_server/contact_models/force_model.h"

namespace osteomill {

struct ForceModelEntry {
    std::string name;
    std::string description;  ///< a few words for --help
    /// It mills: its results carry an engagement and a cutting law, against which a coupling can solve, and
    /// with the spindle off it has no force, the wall being the coupling's. If not, it has neither, and the
    /// force of each result is all there is, spindle on or off.
    bool has_cutting_law = true;
};

/// In the order of --help; the first is the default.
std::vector<ForceModelEntry> force_models();
std::vector<std::string> force_model_names();

/// Throws std::invalid_argument for an unknown name, listing the known ones.
ForceModelEntry find_force_model(const std::string& name);

/// `burrs` and `tissues` as in the scene. Throws std::invalid_argument for an unknown name, listing the known
/// ones, and for what the model refuses.
std::unique_ptr<ForceModel> make_force_model(const std::string& name, Bone bone, std::vector<Burr> burrs,
                                             const std::vector<Tissue>& tissues);

}  // namespace osteomill
