#include "simulation/force_models/force_models.h"

#include <stdexcept>
#include <utility>

#include "simulation/force_models/eroding_model.h"
#include "simulation/force_models/hertz_contact.h"
#include "simulation/force_models/milling_model.h"
#include "simulation/force_models/petersik_probe.h"
#include "simulation/force_models/point_spring.h"
#include "simulation/force_models/voxel_tool.h"

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
        {.name = "milling", .text = "the cutting law, summed over removed voxels", .make = milling()},
        {.name = "published",
         .text = "the same of chips alone, without the edges' force and friction",
         .has_friction = false,
         .make = milling({.has_edge_forces = false})},
        {.name = "milling-partial",
         .text = "the same with voxels of sharper edges, faster",
         .make = milling({.coverage = VoxelCoverage::linear})},
        {.name = "milling-bins",
         .text = "the same over bins of angle and height, as published",
         .make = milling({.summation = ForceSummation::bins})},
        {.name = "milling-instants",
         .text = "the same within the tooth period",
         .make = milling({.summation = ForceSummation::instants})},
        {.name = "milling-scan",
         .text = "as published in all: every voxel of the burr at each step, there or gone, in bins",
         .has_friction = false,
         .make = milling({.has_edge_forces = false,
                          .summation = ForceSummation::bins,
                          .coverage = VoxelCoverage::binary,
                          .search = VoxelSearch::full_scan})},
        {.name = "point-spring",
         .text = "a spring at the deepest point",
         .has_cutting_law = false,
         .make = eroding<PointSpring>()},
        {.name = "petersik",
         .text = "many points on the burr's surface",
         .has_cutting_law = false,
         .make = eroding<PetersikProbe>()},
        {.name = "morris",
         .text = "the burr as voxels",
         .has_cutting_law = false,
         .make = eroding<VoxelTool>()},
        {.name = "agus",
         .text = "Hertz contact with friction",
         .has_cutting_law = false,
         .make = eroding<HertzContact>()}};
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
