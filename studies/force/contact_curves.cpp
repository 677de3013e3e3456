#include "studies/force/contact_curves.h"

#include <fmt/format.h>

#include <array>
#include <glm/geometric.hpp>
#include <memory>

#include "common/bone/brick_change.h"
#include "simulation/cutting_force/reference_force.h"
#include "simulation/force_models/force_models.h"
#include "studies/force/bone_block.h"

namespace osteomill::study {

namespace {

constexpr double block_voxel_mm = 0.1;
constexpr std::array feeds_mm_per_s{2.0, 6.0};

Burr five_millimetres() {
    return {.diameter_mm = 5.0, .sense = SpindleSense::counter_clockwise};
}

Bone flat_block() {
    return voxelised({.low_mm = {-4.0, -3.0, -5.5}, .high_mm = {4.0, 3.0, 0.0}}, block_voxel_mm);
}

glm::dvec3 place_at(double depth_mm, double x_mm) {
    return {x_mm, 0.017, five_millimetres().radius_mm() - depth_mm};
}

double milling_force_n(double depth_mm, double feed_mm_per_s) {
    return glm::length(mean_reference_force_n({.burr = five_millimetres(),
                                               .position_mm = place_at(depth_mm, 0.0),
                                               .velocity_mm_per_s = {feed_mm_per_s, 0.0, 0.0}},
                                              flat_bone()));
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

std::vector<double> contact_depths_mm(bool quick) {
    const double step_mm = quick ? 0.5 : 0.1;
    std::vector<double> depths_mm;
    for (int i = 1; i <= static_cast<int>(2.5 / step_mm + 0.5); ++i) depths_mm.push_back(i * step_mm);
    return depths_mm;
}

ContactRow measure_contact(double depth_mm) {
    ContactRow row{.depth_mm = depth_mm};
    for (const std::string& name : contact_models()) row.force_n.push_back(resting_force_n(name, depth_mm));
    for (const double feed : feeds_mm_per_s) row.milling_force_n.push_back(milling_force_n(depth_mm, feed));
    return row;
}

Table table_of(const std::vector<ContactRow>& rows) {
    std::vector<std::string> columns{"depth_mm"};
    for (const std::string& model : contact_models()) columns.push_back(model);
    for (const double feed : feeds_mm_per_s) columns.push_back(fmt::format("milling {} mm/s", feed));
    Table table(columns);
    for (const ContactRow& row : rows) {
        std::vector<nlohmann::ordered_json> cells{row.depth_mm};
        cells.insert(cells.end(), row.force_n.begin(), row.force_n.end());
        cells.insert(cells.end(), row.milling_force_n.begin(), row.milling_force_n.end());
        table.add(std::move(cells));
    }
    return table;
}

}  // namespace osteomill::study
