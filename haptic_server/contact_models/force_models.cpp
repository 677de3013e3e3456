#include "haptic_server/contact_models/force_models.h"

#include <stdexcept>
#include <utility>

#include "haptic_server/contact_models/eroding_model.h"
#include "haptic_server/contact_models/hertz_contact.h"
#include "haptic_server/contact_models/milling_model.h"
#include "haptic_server/contact_models/petersik_probe.h"
#include "haptic_server/contact_models/point_spring.h"
#include "haptic_server/contact_models/voxel_tool.h"

namespace osteomill {

namespace {

ForceModelFactory milling(const MillingSettings& settings = {}) {
    return [settings](Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues) {
        return std::make_unique<MillingModel>(std::move(bone), std::move(burrs), tissues, settings);
    };
}

template <typename Law>
ForceModelFactory eroding() {
    return [](Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues) {
        return std::make_unique<ErodingModel>(std::move(bone), std::move(burrs), tissues,
                                              std::make_unique<Law>());
    };
}

}  // namespace

const std::vector<ForceModelEntry>& force_models() {
    static const std::vector<ForceModelEntry> table{
        {"milling", "the cutting law, summed over removed voxels", true, milling()},
        {"published", "the same of chips alone: the scene's edge coefficients count for nothing", true,
         milling({.has_edge_forces = false})},
        {"milling-partial", "the same with voxels of sharper edges, faster", true,
         milling({.coverage = VoxelCoverage::linear})},
        {"milling-bins", "the same over bins of angle and height, as published", true,
         milling({.summation = ForceSummation::bins})},
        {"milling-instants", "the same within the tooth period", true,
         milling({.summation = ForceSummation::instants})},
        {"point-spring", "a spring at the deepest point", false, eroding<PointSpring>()},
        {"petersik", "many points on the burr's surface", false, eroding<PetersikProbe>()},
        {"morris", "the burr as voxels", false, eroding<VoxelTool>()},
        {"agus", "Hertz contact with friction", false, eroding<HertzContact>()}};
    return table;
}

std::vector<std::string> force_model_names() {
    std::vector<std::string> names;
    for (const ForceModelEntry& model : force_models()) names.push_back(model.name);
    return names;
}

const ForceModelEntry& find_force_model(const std::string& name) {
    std::string known;
    for (const ForceModelEntry& model : force_models()) {
        if (model.name == name) return model;
        known += (known.empty() ? "" : ", ") + model.name;
    }
    throw std::invalid_argument("unknown force model '" + name + "'; choose one of " + known);
}

std::unique_ptr<ForceModel> make_force_model(const std::string& name, Bone bone, std::vector<Burr> burrs,
                                             const std::vector<Tissue>& tissues) {
    return find_force_model(name).make(std::move(bone), std::move(burrs), tissues);
}

}  // namespace osteomill
