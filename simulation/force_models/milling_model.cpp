#include "simulation/force_models/milling_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "simulation/carving/carve_head.h"
#include "simulation/carving/crescent_rows.h"
#include "simulation/cutting_force/mean_force.h"
#include "simulation/force_models/force_model.h"
#include "simulation/force_models/removal_account.h"

namespace osteomill {

static_assert(most_voxels_across_burr <= 2.0 * CrescentRows::largest_radius_voxels);

namespace {

/// Directions are taken from the middle of a substep. In a substep as long as the burr's radius the force
/// would be 10 % off, in an eighth of that 0.2 %.
constexpr double longest_substep_radii = 0.125;
/// The face of a second pass a voxel deep is a few voxels long; the outline of another head has narrow bends,
/// and its edges rub on the bone that the surface passes within a voxel or so.
constexpr double longest_substep_voxels = 1.0;
/// At 10 kHz a burr moves by less than one of a voxel's 255 levels at a time. Below five levels, and for no
/// longer than a haptic tick, milling waits: bone and mean force come out the same.
constexpr double shortest_path_voxels = 0.02;
constexpr double longest_wait_s = 0.001 - 1e-7;

/// Least length of the path ahead on which edges sample bone (edge_look.h). Along it, the line where the face
/// ends moves so far that a row of voxels enters the face gradually; with half of it, a burr along the
/// lattice feels a ripple.
constexpr double least_look_voxels = 1.0;

/// The full scan keeps each voxel of a burr: 64 MiB for the largest.
constexpr double most_scanned_voxels_across = 200.0;

/// Nobody feels the direction of a step that crosses the whole bone.
constexpr double most_substeps = 64.0;

std::vector<Burr> as_summed(std::vector<Burr> burrs, const MillingSettings& settings) {
    if (!settings.has_edge_forces)
        for (Burr& burr : burrs) burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
    return burrs;
}

void require_scannable(const Burr& burr, double spacing_mm) {
    require_ball(burr, "the full scan");
    if (burr.diameter_mm > most_scanned_voxels_across * spacing_mm)
        throw std::invalid_argument("burr '" + burr.name +
                                    "' is more than 200 voxels across, the most that the "
                                    "full scan takes: take the force model 'milling'");
}

/// Axis of a spindle that tilts along the path.
glm::dvec3 axis_between(const glm::dvec3& from, const glm::dvec3& to, double share) {
    const glm::dvec3 axis = glm::mix(from, to, share);
    const double length = glm::length(axis);
    return length > 1e-6 ? axis / length : to;
}

/// Weighs each removed voxel by its stiffness, enters it into the account and hands it to the force.
template <typename Force>
class ForceOfRemoved final : public RemovalSink {
  public:
    ForceOfRemoved(const BoneContent& content, RemovalAccount& account, Force& force) noexcept
        : content_(content), account_(account), force_(force) {}

    void take(const RemovedVoxels& removed) noexcept override {
        enter(removed);
        weigh_by_stiffness(content_, removed, weights_);
        force_.add(removed, {weights_.data(), removed.padded_count()});
    }

  private:
    void enter(const RemovedVoxels& removed) noexcept {
        if (content_.tissue.empty()) {
            account_.take(0, removed.lost_levels());
            return;
        }
        for (std::size_t i = 0; i < removed.count; ++i)
            account_.take(content_.tissue_in(removed.slot[i], static_cast<std::size_t>(removed.offset[i])),
                          static_cast<double>(removed.levels[i]));
    }

    const BoneContent& content_;
    RemovalAccount& account_;
    Force& force_;
    alignas(64) std::array<float, RemovedVoxels::capacity> weights_;
};

/// Weighs each voxel that edges rub on by its stiffness and its tissue's share, and hands it to the force.
template <typename Force>
class ForceOfRubbed final : public RemovalSink {
  public:
    /// `shares`: null where edges rub as the stiffness says.
    ForceOfRubbed(const BoneContent& content, const EdgeShares* shares, const CuttingStep& edges,
                  Force& force) noexcept
        : content_(content), shares_(shares), edges_(edges), force_(force) {}

    void take(const RemovedVoxels& rubbed) noexcept override {
        weigh_by_stiffness(content_, rubbed, weights_);
        if (shares_ != nullptr)
            for (std::size_t i = 0; i < rubbed.count; ++i)
                weights_[i] *= shares_->of_label[content_.tissue_in(
                    rubbed.slot[i], static_cast<std::size_t>(rubbed.offset[i]))];
        voxels_ += rubbed.lost_levels() / 255.0;
        force_.add_edges(edges_, rubbed, {weights_.data(), rubbed.padded_count()});
    }

    EdgeLook look() const noexcept { return {force_.edges_n(), voxels_}; }

  private:
    const BoneContent& content_;
    const EdgeShares* shares_;
    const CuttingStep& edges_;
    Force& force_;
    double voxels_ = 0.0;
    alignas(64) std::array<float, RemovedVoxels::capacity> weights_;
};

}  // namespace

MillingModel::MillingModel(Bone bone, std::vector<Burr> burrs, const std::vector<Tissue>& tissues,
                           const MillingSettings& settings)
    : bone_(std::move(bone)),
      burrs_(as_summed(std::move(burrs), settings)),
      settings_(settings),
      edge_shares_(tissues),
      has_edge_shares_(!edge_shares_.are_all_one()),
      uncut_(tissues),
      chips_(settings.bins),
      tooth_(settings.instants_per_tooth, settings.instructions),
      account_(bone_.grid(), tissues) {
    if (burrs_.all().empty()) throw std::invalid_argument("the milling model needs at least one burr");
    probes_.reserve(burrs_.size());
    for (const Burr& burr : burrs_.all()) {
        require_valid(burr, bone_.grid().spacing_mm);
        if (settings.summation == ForceSummation::bins) require_ball(burr, "the force over bins");
        if (settings.search == VoxelSearch::full_scan) {
            require_scannable(burr, bone_.grid().spacing_mm);
            scans_.emplace_back(burr.radius_mm() / bone_.grid().spacing_mm, settings.coverage);
        }
        heads_.emplace_back();
        if (!burr.is_ball())
            heads_.back().emplace(burr.head, burr.diameter_mm, 1.0 / bone_.grid().spacing_mm);
        probes_.emplace_back(burr, bone_.grid().spacing_mm, edge_shares_, uncut_);
    }
}

template <typename Force>
EdgeLook MillingModel::look_ahead(const Sweep& sweep, const CuttingStep& cutting, const glm::dvec3& ahead,
                                  const CarveSettings& carving, Force& force) noexcept {
    const CuttingStep edges = cutting.of_edges(burrs_[burr_], sweep.from, ahead);
    ForceOfRubbed rubbed(bone_.content(), has_edge_shares_ ? &edge_shares_ : nullptr, edges, force);
    if (cutting.head != nullptr)
        preview_carve(bone_, HeadSweep{*cutting.head, cutting.frame, sweep.from, sweep.from + ahead}, carving,
                      rubbed);
    else
        preview_carve(bone_, Sweep{sweep.from, sweep.from + ahead, sweep.radius}, carving, rubbed);
    return rubbed.look();
}

template <typename Force>
void MillingModel::carve_and_sum(const Sweep& sweep, const CuttingStep& cutting, double share,
                                 ChangeSink& changes, Force& force, MillingResult& result) noexcept {
    ForceOfRemoved removed(bone_.content(), account_, force);
    const CarveSettings carving{.coverage = settings_.coverage,
                                .instructions = settings_.instructions,
                                .uncut = uncut_.has_any ? &uncut_ : nullptr};
    const glm::dvec3 path = sweep.to - sweep.from;
    FaceEnd end;
    if (carved_at_position_ && cutting.head == nullptr && settings_.summation != ForceSummation::bins)
        end = axis_face_.look(bone_, sweep, cutting.frame, settings_.coverage);
    if (!carved_at_position_) edge_growth_.forget();
    // A burr that has not carved yet may stand in bone, so its edges are not sampled.
    if (burrs_[burr_].has_edge_force() && carved_at_position_ && path != glm::dvec3(0.0)) {
        const double length = glm::length(path);
        const double look = std::clamp(length, least_look_voxels, CrescentRows::longest_step_voxels);
        const EdgeLook whole = look_ahead(sweep, cutting, path * (look / length), carving, force);
        if (whole.voxels > 0.0 && length < look) {
            MeanForce nearby(cutting, settings_.instructions);
            const EdgeLook half = look_ahead(sweep, cutting, path * (0.5 * look / length), carving, nearby);
            force.correct(edge_growth_.correction(whole, half, length, look));
        }
        if (whole.voxels <= 0.0) {
            edge_growth_.forget();
        } else {
            const CuttingStep edges = cutting.of_edges(burrs_[burr_], sweep.from, path * (look / length));
            force.correct(static_cast<double>(edge_shares_.of_label[end.tissue]) *
                          axis_face_.lacking_n(edges, end, sweep));
        }
    }
    force.correct(axis_face_.lacking_n(cutting, end, sweep));
    if (!scans_.empty())
        scans_[burr_].carve(bone_, sweep, cutting.frame, carving, changes, removed);
    else if (cutting.head != nullptr)
        carve_head(bone_, {*cutting.head, cutting.frame, sweep.from, sweep.to}, carving, changes, removed);
    else
        carve(bone_, sweep, carved_at_position_ ? CarveHistory::carved_at_from : CarveHistory::none, carving,
              changes, removed);
    result.force_n += share * force.force_n();
}

void MillingModel::cut(const BurrCommand& command, const ToolPose& to, double share, ChangeSink& changes,
                       MillingResult& result) noexcept {
    const Burr& burr = burrs_[burr_];
    const Grid& grid = bone_.grid();
    const Sweep sweep{to_voxel_coordinates(grid, position_mm_), to_voxel_coordinates(grid, to.position_mm),
                      burr.radius_mm() / grid.spacing_mm};
    const CuttingStep cutting(burr, to.spindle_axis, 0.5 * (sweep.from + sweep.to), grid.spacing_mm,
                              share * since_milled_s_, heads_[burr_] ? &*heads_[burr_] : nullptr);
    if (settings_.summation == ForceSummation::voxels) {
        MeanForce force(cutting, settings_.instructions);
        carve_and_sum(sweep, cutting, share, changes, force, result);
    } else if (settings_.summation == ForceSummation::bins) {
        chips_.begin_step(burr, cutting);
        carve_and_sum(sweep, cutting, share, changes, chips_, result);
    } else {
        tooth_.turn(burr, share * command.elapsed_s);
        tooth_.begin_step(cutting);
        carve_and_sum(sweep, cutting, share, changes, tooth_, result);
    }
    carved_at_position_ = true;
    position_mm_ = to.position_mm;
    spindle_axis_ = to.spindle_axis;
}

double MillingModel::motion_mm(const BurrCommand& command) const noexcept {
    const double path_mm = glm::length(command.pose.position_mm - position_mm_);
    if (!heads_[burr_]) return path_mm;
    const BurrProfile& head = *heads_[burr_];
    const double reach_mm = std::max(-head.tip_height(), head.top_height()) * bone_.grid().spacing_mm;
    return path_mm + reach_mm * glm::length(command.pose.spindle_axis - spindle_axis_);
}

bool MillingModel::can_wait(const BurrCommand& command) const noexcept {
    return scans_.empty() && carved_at_position_ && !command.wants_engagement &&
           since_milled_s_ < longest_wait_s &&
           motion_mm(command) / bone_.grid().spacing_mm < shortest_path_voxels;
}

void MillingModel::mill(const BurrCommand& command, ChangeSink& changes, MillingResult& result) noexcept {
    since_milled_s_ += command.elapsed_s;
    if (can_wait(command)) {
        result.force_n = milled_force_n_;
        if (settings_.summation == ForceSummation::instants) {
            tooth_.turn(burrs_[burr_], command.elapsed_s);
            result.force_n = tooth_.force_n();
        }
        return;
    }
    const bool is_first = !carved_at_position_;
    const ToolPose from{position_mm_, spindle_axis_};
    const glm::dvec3 path_mm = command.pose.position_mm - from.position_mm;
    const double longest_voxels_mm = longest_substep_voxels * bone_.grid().spacing_mm;
    const double longest_mm =
        heads_[burr_] ? longest_voxels_mm
                      : std::min(longest_voxels_mm, longest_substep_radii * burrs_[burr_].radius_mm());
    const double substeps = std::clamp(std::ceil(motion_mm(command) / longest_mm), 1.0, most_substeps);
    for (double i = 1.0; i <= substeps; i += 1.0) {
        ToolPose to = command.pose;
        if (i < substeps) {
            to.position_mm = from.position_mm + path_mm * (i / substeps);
            // A ball looks the same however its spindle points.
            if (heads_[burr_])
                to.spindle_axis = axis_between(from.spindle_axis, command.pose.spindle_axis, i / substeps);
        }
        cut(command, to, 1.0 / substeps, changes, result);
    }
    // A spindle that starts within bone clears a whole ball at once, which no later step does again.
    if (is_first) tooth_.forget();
    milled_force_n_ = is_first ? glm::dvec3(0.0) : result.force_n;
    since_milled_s_ = 0.0;
}

void MillingModel::step(const BurrCommand& command, double time_s, ChangeSink& changes,
                        MillingResult& result) noexcept {
    account_.begin_step(time_s, result);
    result.valid = is_usable(command, burrs_.size());
    if (!result.valid) return;

    if (!has_position_ || command.burr != burr_) {
        position_mm_ = command.pose.position_mm;
        spindle_axis_ = command.pose.spindle_axis;
        burr_ = command.burr;
        has_position_ = true;
        carved_at_position_ = false;
        since_milled_s_ = 0.0;
    }
    burrs_.turn(burr_, command.speed_share);
    if (command.spindle_on) {
        mill(command, changes, result);
    } else {
        carved_at_position_ = false;
        position_mm_ = command.pose.position_mm;
        spindle_axis_ = command.pose.spindle_axis;
        since_milled_s_ = 0.0;
    }
    account_.end_step(command, result);
    if (command.wants_engagement)
        probes_[burr_].sample(bone_, command.pose.position_mm, command.pose.spindle_axis, command.speed_share,
                              carved_at_position_ && !uncut_.has_any ? InsideBurr::carved : InsideBurr::any,
                              result.engagement);
}

void MillingModel::restore(const BrickChange& change, BrickFractions fractions,
                           ChangeSink& changes) noexcept {
    restore_bone(change, fractions, bone_, account_, changes);
    carved_at_position_ = false;  // there may be bone again in the ball that was carved
}

}  // namespace osteomill
