#include "studies/force/contact_curves.h"

#include <glm/geometric.hpp>
#include <memory>

#include "common/bone/brick_change.h"
#include "simulation/force_models/force_models.h"
#include "studies/force/bone_block.h"

namespace osteomill::study {

namespace {

constexpr double block_voxel_mm = 0.1;

Burr five_millimetres() {
    return {.diameter_mm = 5.0, .sense = SpindleSense::counter_clockwise};
}

Bone flat_block() {
    return voxelised({.low_mm = {-4.0, -3.0, -5.5}, .high_mm = {4.0, 3.0, 0.0}}, block_voxel_mm);
}

glm::dvec3 place_at(double depth_mm, double x_mm) {
    return {x_mm, 0.017, five_millimetres().radius_mm() - depth_mm};
}

}  // namespace

double resting_force_n(const std::string& name, double depth_mm) {
    const auto model = make_force_model(name, flat_block(), {five_millimetres()}, {});
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();
    model->step({.pose = {place_at(depth_mm, 0.031), {0.0, 0.0, 1.0}}, .elapsed_s = 0.001}, 0.0, changes,
                *result);
    return glm::length(result->force_n);
}

std::vector<std::string> contact_models() {
    std::vector<std::string> names;
    for (const ForceModelEntry& model : force_models())
        if (!model.has_cutting_law) names.push_back(model.name);
    return names;
}

}  // namespace osteomill::study
