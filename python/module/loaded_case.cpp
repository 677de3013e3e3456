#include "python/module/loaded_case.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/session/structure_distance.h"
#include "haptic_server/streaming/live_session.h"
#include "simulation/device/haptic_device.h"

namespace osteomill::python {

namespace {

std::vector<LoadedCase::NamedLabel> labels_of(const SessionScene& scene) {
    std::vector<LoadedCase::NamedLabel> labels;
    for (const Tissue& tissue : scene.scene.tissues) labels.push_back({tissue.name, tissue.label});
    if (!labels.empty() && scene.source.loaded_mm3.front() > 0.0) labels.push_back({"unlabelled", 0});
    return labels;
}

}  // namespace

LoadedCase::LoadedCase(std::string name, SceneChoice choice, const LoadedCase* similar)
    : name_(std::move(name)),
      choice_(std::move(choice)),
      scene_(load_session_scene(choice_, similar != nullptr ? &similar->scene_ : nullptr)),
      bone_checksum_(checksum(scene_.bone)),
      labels_(labels_of(scene_)) {
    scene_.bone.share();
    const std::vector<double>& loaded_mm3 = scene_.source.loaded_mm3;
    for (std::size_t label = 0; label < loaded_mm3.size(); ++label)
        if (loaded_mm3[label] > 0.0) labels_of_bone_.push_back(label);
    felt_burrs_ = osteomill::felt_burrs(settings());
    double largest_radius_mm = 0.0;
    for (const Burr& burr : settings().burrs) {
        heads_.emplace_back(burr);
        largest_radius_mm = std::max(largest_radius_mm, heads_.back().largest_radius_mm());
    }
    for (const Structure& structure : scene_.structures) {
        const Tissue& tissue = settings().tissues[structure.tissue];
        structure_names_.push_back(tissue.name);
        reach_mm_.push_back(watched_mm(tissue));
        fields_.emplace_back(structure.mask, reach_mm_.back() + largest_radius_mm);
    }
    auto names = std::make_shared<StepNames>();
    for (const NamedLabel& one : labels_) names->tissues.push_back(one.name);
    names->structures = structure_names_;
    step_names_ = std::move(names);
}

double LoadedCase::plan_distance_mm(const glm::dvec3& place_mm) const {
    std::call_once(planned_once_, [this] {
        planned_ = std::make_unique<Planned>(
            scene_.bone, session_info(scene_.scene, false, DeviceLimits{}.max_force_n, std::string()));
    });
    const double distance_mm = planned_->region.distance_mm(place_mm);
    return planned_->region.holds(place_mm) ? -std::abs(distance_mm) : distance_mm;
}

double LoadedCase::distance_mm(std::size_t i, const ToolState& tool) const noexcept {
    const std::optional<double> distance_mm =
        heads_[tool.burr].clearance_mm(fields_[i], {tool.burr_position_mm, tool.spindle_axis});
    return distance_mm && *distance_mm <= reach_mm_[i] ? *distance_mm
                                                       : std::numeric_limits<double>::infinity();
}

}  // namespace osteomill::python
