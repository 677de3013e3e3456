#include "haptic_server/milling/milling_model.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "common/bone/finite.h"
#include "haptic_server/milling/carve.h"
#include "haptic_server/milling/cutting_force.h"

namespace osteomill {

namespace {

void require_valid(const Burr& burr) {
    const glm::dvec3& k = burr.cutting_coefficients_n_per_mm2;
    const bool good = std::isfinite(burr.diameter_mm) && burr.diameter_mm > 0.0 && burr.edges > 0 &&
                      std::isfinite(burr.spindle_rev_per_s) && burr.spindle_rev_per_s > 0.0 && is_finite(k) &&
                      k.x >= 0.0 && k.y >= 0.0 && k.z >= 0.0;
    if (!good)
        throw std::invalid_argument("burr '" + burr.name +
                                    "' needs a diameter, edges and a spindle speed above zero and finite "
                                    "cutting coefficients that are not negative");
}

bool is_usable(const BurrCommand& command, std::size_t burr_count) {
    return is_finite(command.pose.position_mm) && is_finite(command.pose.spindle_axis) &&
           std::abs(glm::length(command.pose.spindle_axis) - 1.0) < 1e-6 &&
           std::isfinite(command.elapsed_s) && command.elapsed_s > 0.0 && command.burr < burr_count;
}

}  // namespace

MillingModel::MillingModel(Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues,
                           ForceSummation summation)
    : bone_(std::move(bone)), burrs_(std::move(burrs)), summation_(summation), chips_(ChipBins{}) {
    if (burrs_.empty()) throw std::invalid_argument("the milling model needs at least one burr");
    probes_.reserve(burrs_.size());
    for (const Burr& burr : burrs_) {
        require_valid(burr);
        probes_.emplace_back(burr, bone_.grid().spacing_mm);
    }
    for (const Tissue& tissue : tissues) protected_[tissue.label] = tissue.is_protected;
}

template <typename Force>
void MillingModel::carve_and_sum(const BurrCommand& command, EditSink& edits, Force& force,
                                 MillingResult& result) noexcept {
    const Grid& grid = bone_.grid();
    const BoneContent& content = bone_.content();
    const Sweep sweep{to_voxel_coordinates(grid, position_mm_),
                      to_voxel_coordinates(grid, command.pose.position_mm),
                      burrs_[command.burr].radius_mm() / grid.spacing_mm};
    const double homogeneous = content.homogeneous_stiffness / 255.0;
    const double per_code = content.stiffness_per_code / 255.0;
    const double mm3_per_code = voxel_volume_mm3(grid) / 255.0;
    std::int64_t removed_codes = 0;
    carve(bone_, sweep, carved_at_position_ ? CarveHistory::carved_at_from : CarveHistory::none, edits,
          [&](const glm::ivec3& voxel, std::size_t slot, std::size_t offset, int codes) {
              const double stiffness =
                  content.stiffness.empty() ? homogeneous : per_code * content.stiffness[slot][offset];
              force.add(glm::dvec3(voxel), stiffness * codes);
              removed_codes += codes;
              const std::uint8_t label =
                  content.tissue.empty() ? std::uint8_t{0} : content.tissue[slot][offset];
              removed_mm3_[label] += codes * mm3_per_code;
              result.touches_protected |= protected_[label];
          });
    result.force_n = force.force_n();
    result.removed_mm3 = static_cast<double>(removed_codes) * mm3_per_code;
}

void MillingModel::step(const BurrCommand& command, double time_s, EditSink& edits,
                        MillingResult& result) noexcept {
    result.step = ++step_;
    result.time_s = time_s;
    result.force_n = glm::dvec3(0.0);
    result.removed_mm3 = 0.0;
    result.total_removed_mm3 = total_removed_mm3_;
    result.touches_protected = false;
    result.valid = is_usable(command, burrs_.size());
    if (!result.valid) {
        result.engagement.count = 0;
        return;
    }

    if (!has_position_ || command.burr != burr_) {
        position_mm_ = command.pose.position_mm;
        burr_ = command.burr;
        has_position_ = true;
        carved_at_position_ = false;
    }
    if (command.spindle_on) {
        const Burr& burr = burrs_[burr_];
        const Grid& grid = bone_.grid();
        const glm::dvec3 middle = to_voxel_coordinates(grid, 0.5 * (position_mm_ + command.pose.position_mm));
        if (summation_ == ForceSummation::voxels) {
            CuttingForce force(burr, command.pose.spindle_axis, middle, grid.spacing_mm, command.elapsed_s);
            carve_and_sum(command, edits, force, result);
        } else {
            chips_.begin_step(burr, command.pose.spindle_axis, middle, grid.spacing_mm, command.elapsed_s);
            carve_and_sum(command, edits, chips_, result);
        }
    }
    carved_at_position_ = command.spindle_on;
    position_mm_ = command.pose.position_mm;
    total_removed_mm3_ += result.removed_mm3;

    result.total_removed_mm3 = total_removed_mm3_;
    result.pose = command.pose;
    result.burr = burr_;
    result.spindle_on = command.spindle_on;
    probes_[burr_].sample(bone_, position_mm_, command.pose.spindle_axis, result.engagement);
}

}  // namespace osteomill
