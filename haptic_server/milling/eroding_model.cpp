#include "haptic_server/milling/eroding_model.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "haptic_server/milling/usable_burr.h"

namespace osteomill {

namespace {

double largest_radius_voxels(const std::vector<Burr>& burrs, double spacing_mm) {
    if (burrs.empty()) throw std::invalid_argument("a contact model needs at least one burr");
    double largest_mm = 0.0;
    for (const Burr& burr : burrs) {
        require_valid(burr, spacing_mm);
        largest_mm = std::max(largest_mm, burr.radius_mm());
    }
    return largest_mm / spacing_mm;
}

/// Counts what erosion takes by tissue.
class ErosionTally final : public ErosionSink {
  public:
    ErosionTally(const Bone& bone, const std::array<bool, 256>& is_protected,
                 RemovedByTissue& removed_mm3) noexcept
        : content_(bone.content()),
          is_protected_(is_protected),
          mm3_per_code_(voxel_volume_mm3(bone.grid()) / 255.0),
          removed_mm3_(removed_mm3) {}

    void take(std::int32_t slot, std::size_t offset, int codes) noexcept override {
        total_codes_ += codes;
        const std::uint8_t label = content_.tissue.empty()
                                       ? std::uint8_t{0}
                                       : content_.tissue[static_cast<std::size_t>(slot)][offset];
        removed_mm3_[label] += codes * mm3_per_code_;
        touches_protected_ |= is_protected_[label];
    }

    double total_mm3() const { return static_cast<double>(total_codes_) * mm3_per_code_; }
    bool touches_protected() const { return touches_protected_; }

  private:
    const BoneContent& content_;
    const std::array<bool, 256>& is_protected_;
    double mm3_per_code_;
    RemovedByTissue& removed_mm3_;
    std::int64_t total_codes_ = 0;
    bool touches_protected_ = false;
};

}  // namespace

ErodingModel::ErodingModel(Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues,
                           std::unique_ptr<ContactLaw> law)
    : bone_(std::move(bone)),
      burrs_(std::move(burrs)),
      law_(std::move(law)),
      bricks_(largest_radius_voxels(burrs_, bone_.grid().spacing_mm) + BurrContact::margin_voxels),
      erosion_(largest_radius_voxels(burrs_, bone_.grid().spacing_mm)) {
    for (const Tissue& tissue : tissues) protected_[tissue.label] = tissue.is_protected;
}

void ErodingModel::erode(const glm::dvec3& position_mm, double dose, EditSink& edits,
                         MillingResult& result) noexcept {
    const Grid& grid = bone_.grid();
    const Ball ball{to_voxel_coordinates(grid, position_mm), burrs_[burr_].radius_mm() / grid.spacing_mm};
    ErosionTally tally(bone_, protected_, removed_mm3_);
    erosion_.erode(bone_, ball, dose, edits, tally);
    result.removed_mm3 = tally.total_mm3();
    result.touches_protected = tally.touches_protected();
}

void ErodingModel::step(const BurrCommand& command, double time_s, EditSink& edits,
                        MillingResult& result) noexcept {
    result.step = ++step_;
    result.time_s = time_s;
    result.force_n = glm::dvec3(0.0);
    result.removed_mm3 = 0.0;
    result.total_removed_mm3 = total_removed_mm3_;
    result.touches_protected = false;
    result.engagement.count = 0;
    result.valid = is_usable(command, burrs_.size());
    if (!result.valid) return;

    const glm::dvec3 position_mm = command.pose.position_mm;
    if (!has_position_ || command.burr != burr_) position_mm_ = position_mm;
    has_position_ = true;
    burr_ = command.burr;

    const Burr& burr = burrs_[burr_];
    const Grid& grid = bone_.grid();
    const glm::dvec3 centre = to_voxel_coordinates(grid, position_mm);
    const double radius = burr.radius_mm() / grid.spacing_mm;
    if (bricks_.gather(bone_, centre, radius + BurrContact::margin_voxels)) {
        const ContactReaction reaction = law_->react({.bone = bone_,
                                                      .bricks = bricks_,
                                                      .burr = burr,
                                                      .centre_voxels = centre,
                                                      .radius_voxels = radius,
                                                      .spindle_axis = command.pose.spindle_axis,
                                                      .spindle_on = command.spindle_on});
        result.force_n = reaction.force_n;
        if (command.spindle_on)
            erode(0.5 * (position_mm_ + position_mm), reaction.erosion_per_s * command.elapsed_s, edits,
                  result);
    }
    position_mm_ = position_mm;
    total_removed_mm3_ += result.removed_mm3;

    result.total_removed_mm3 = total_removed_mm3_;
    result.pose = command.pose;
    result.burr = burr_;
    result.spindle_on = command.spindle_on;
}

}  // namespace osteomill
