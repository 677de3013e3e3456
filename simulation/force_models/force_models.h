// Table of the force models that --force-model names. To add one is a class beside these and a row in
// force_models.cpp.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "simulation/force_models/force_model.h"

namespace osteomill {

/// Makes a model of `burrs` and `tissues` as in the scene. Throws std::invalid_argument for anything that the
/// model refuses.
using ForceModelFactory = std::function<std::unique_ptr<ForceModel>(Bone bone, std::vector<Burr> burrs,
                                                                    const std::vector<Tissue>& tissues)>;

/// One row of the table.
struct ForceModelEntry {
    std::string name;
    std::string text;  ///< a few words for --help
    /// It mills: its results have an engagement and a cutting law, against which a coupling can solve, and
    /// with the spindle off it has no force, since the coupling provides the wall. A model without a cutting
    /// law has only the force of each result, spindle on or off.
    bool has_cutting_law = true;
    bool has_friction = true;  ///< a burr at rest rubs on bone; not as published
    ForceModelFactory make;
};

/// In the order of --help; the first is the default.
const std::vector<ForceModelEntry>& force_models();
std::vector<std::string> force_model_names();

/// Throws std::invalid_argument for an unknown name, listing the known ones.
const ForceModelEntry& find_force_model(const std::string& name);

/// The model of that name. Throws as find_force_model and ForceModelFactory do.
std::unique_ptr<ForceModel> make_force_model(const std::string& name, Bone bone, std::vector<Burr> burrs,
                                             const std::vector<Tissue>& tissues);

}  // namespace osteomill
