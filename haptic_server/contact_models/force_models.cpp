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

std::vector<ForceModelEntry> force_models() {
    return {
        {.name = "milling", .description = "the cutting law, summed over removed voxels"},
        {.name = "milling-partial", .description = "the same with voxels of sharper edges, faster"},
        {.name = "milling-bins", .description = "the same over bins of angle and height, as published"},
        {.name = "milling-instants", .description = "the same within the tooth period"},
        {.name = "point-spring", .description = "a spring at the deepest point", .has_cutting_law = false},
        {.name = "petersik", .description = "many points on the burr's surface", .has_cutting_law = false},
        {.name = "morris", .description = "the burr as voxels", .has_cutting_law = false},
        {.name = "agus", .description = "Hertz contact with friction", .has_cutting_law = false}};
}

std::vector<std::string> force_model_names() {
    std::vector<std::string> names;
    for (ForceModelEntry& model : force_models()) names.push_back(std::move(model.name));
    return names;
}

ForceModelEntry find_force_model(const std::string& name) {
    std::string known;
    for (ForceModelEntry& model : force_models()) {
        if (model.name == name) return std::move(model);
        known += (known.empty() ? "" : ", ") + model.name;
    }
    throw std::invalid_argument("unknown force model '" + name + "'; choose one of " + known);
}

std::unique_ptr<ForceModel> make_force_model(const std::string& name, Bone bone, std::vector<Burr> burrs,
                                             const std::vector<Tissue>& tissues) {
    const auto milling = [&](const MillingSettings& settings) {
        return std::make_unique<MillingModel>(std::move(bone), std::move(burrs), tissues, settings);
    };
    const auto eroding = [&](std::unique_ptr<ContactLaw> law) {
        return std::make_unique<ErodingModel>(std::move(bone), std::move(burrs), tissues, std::move(law));
    };
    if (name == "milling") return milling({});
    if (name == "milling-partial") return milling({.coverage = VoxelCoverage::linear});
    if (name == "milling-bins") return milling({.summation = ForceSummation::bins});
    if (name == "milling-instants") return milling({.summation = ForceSummation::instants});
    if (name == "point-spring") return eroding(std::make_unique<PointSpring>());
    if (name == "petersik") return eroding(std::make_unique<PetersikProbe>());
    if (name == "morris") return eroding(std::make_unique<VoxelTool>());
    if (name == "agus") return eroding(std::make_unique<HertzContact>());
    (void)find_force_model(name);  // throws
    throw std::logic_error("force model '" + name + "' is listed but not made");
}

}  // namespace osteomill
