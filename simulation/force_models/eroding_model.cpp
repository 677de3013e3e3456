#include "simulation/force_models/eroding_model.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "simulation/force_models/ball_rows.h"
#include "simulation/force_models/force_model.h"
#include "simulation/force_models/removal_account.h"

namespace osteomill {

namespace {

double largest_radius_voxels(const std::vector<Burr>& burrs, double spacing_mm) {
    if (burrs.empty()) throw std::invalid_argument("a contact model needs at least one burr");
    double largest_mm = 0.0;
    for (const Burr& burr : burrs) {
        require_valid(burr, spacing_mm);
        require_ball(burr, "this contact model");
        largest_mm = std::max(largest_mm, burr.radius_mm());
    }
    return largest_mm / spacing_mm;
}

/// Enters eroded bone into the account.
class ErosionEntry final : public ErosionSink {
  public:
    ErosionEntry(const BoneContent& content, RemovalAccount& account) noexcept
        : content_(content), account_(account) {}

    void take(std::int32_t slot, std::size_t offset, int levels) noexcept override {
        account_.take(content_.tissue_in(slot, offset), levels);
    }

  private:
    const BoneContent& content_;
    RemovalAccount& account_;
};

}  // namespace

ErodingModel::ErodingModel(const ErodingModel& other)
    : bone_(other.bone_),
      burrs_(other.burrs_),
      law_(other.law_->copy()),
      bricks_(other.bricks_),
      erosion_(other.erosion_),
      account_(other.account_),
      uncut_(other.uncut_),
      has_position_(other.has_position_),
      position_mm_(other.position_mm_),
      burr_(other.burr_) {}

ErodingModel::ErodingModel(Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues,
                           std::unique_ptr<ContactLaw> law)
    : bone_(std::move(bone)),
      burrs_(std::move(burrs)),
      law_(std::move(law)),
      bricks_(largest_radius_voxels(burrs_.all(), bone_.grid().spacing_mm) + BurrContact::margin_voxels),
      erosion_(largest_radius_voxels(burrs_.all(), bone_.grid().spacing_mm)),
      account_(bone_.grid(), tissues),
      uncut_(tissues) {}

void ErodingModel::erode(const glm::dvec3& position_mm, double dose, ChangeSink& changes) noexcept {
    const Grid& grid = bone_.grid();
    const Ball ball{to_voxel_coordinates(grid, position_mm), burrs_[burr_].radius_mm() / grid.spacing_mm};
    ErosionEntry entry(bone_.content(), account_);
    erosion_.erode(bone_, ball, dose, changes, entry, uncut_);
}

void ErodingModel::step(const BurrCommand& command, double time_s, ChangeSink& changes,
                        MillingResult& result) noexcept {
    account_.begin_step(time_s, result);
    result.valid = is_usable(command, burrs_.size());
    if (!result.valid) return;

    const glm::dvec3 position_mm = command.pose.position_mm;
    if (!has_position_ || command.burr != burr_) position_mm_ = position_mm;
    has_position_ = true;
    burr_ = command.burr;

    const Burr& burr = burrs_.turn(burr_, command.speed_share);
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
        result.has_bone_inside = !command.spindle_on && has_bone_in(bone_, {centre, radius});
        if (command.spindle_on)
            erode(0.5 * (position_mm_ + position_mm), reaction.erosion_per_s * command.elapsed_s, changes);
    }
    position_mm_ = position_mm;
    account_.end_step(command, result);
}

void ErodingModel::restore(const BrickChange& change, BrickFractions fractions,
                           ChangeSink& changes) noexcept {
    restore_bone(change, fractions, bone_, account_, changes);
}

}  // namespace osteomill
