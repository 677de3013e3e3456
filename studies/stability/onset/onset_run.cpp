#include "studies/stability/onset/onset_run.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <stdexcept>

#include "simulation/coupling/coupling_spring.h"
#include "simulation/coupling/couplings.h"
#include "simulation/coupling/implicit_coupling.h"
#include "simulation/force_models/milling_model.h"
#include "studies/force/bone_block.h"
#include "studies/stability/map/held_tool.h"
#include "studies/stability/map/scene_plan.h"

namespace osteomill::study {

namespace {

constexpr double voxel_mm = 0.1;
/// A burr on a soft spring is pushed aside by some tenths of a millimetre.
constexpr double margin_mm = 2.0;

}  // namespace

OnsetLine line_of(const Onset& onset) {
    const double radius_mm = onset.burr.radius_mm();
    if (onset.kind == OnsetKind::plunge)
        return {(radius_mm + onset.before_touch_mm) * onset.up, -onset.up, onset.up};
    const double height_mm = radius_mm - onset.depth_mm;
    const double touch_mm =
        height_mm > 0.0 ? -std::sqrt(radius_mm * radius_mm - height_mm * height_mm) : -radius_mm;
    return {{touch_mm - onset.before_touch_mm, 0.0, height_mm}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
}

Bone bone_of(const Onset& onset) {
    const double radius_mm = onset.burr.radius_mm();
    const double way_mm = onset.way_mm + ImpulseByWay::beyond_mm;
    if (onset.kind == OnsetKind::plunge) {
        const double half_mm = radius_mm + way_mm + margin_mm;
        return voxelised({.low_mm = glm::dvec3(-half_mm), .high_mm = glm::dvec3(half_mm), .up = onset.up},
                         voxel_mm);
    }
    const double half_mm = radius_mm + margin_mm;
    return voxelised({.low_mm = {0.0, -half_mm, -half_mm}, .high_mm = {way_mm + half_mm, half_mm, half_mm}},
                     voxel_mm);
}

ImpulseByWay::ImpulseByWay(const Onset& onset) : direction_(line_of(onset).direction) {
    if (!onset.burr.is_ball() || onset.burr.has_edge_force())
        throw std::invalid_argument("an onset is a ball's whose edges do not rub");
    const OnsetLine line = line_of(onset);
    MillingModel model(bone_of(onset), {onset.burr}, {});
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();
    constexpr double step_s = 0.001;  // of no account: an impulse is asked for
    const auto mill_to = [&](double way_mm, bool spindle_on) {
        model.step({.pose = {line.at(way_mm), line.spindle_axis},
                    .spindle_on = spindle_on,
                    .elapsed_s = step_s,
                    .wants_engagement = false},
                   0.0, changes, *result);
    };
    mill_to(0.0, false);
    mill_to(0.0, true);
    const double end_mm = onset.before_touch_mm + onset.way_mm + beyond_mm;
    const auto steps = static_cast<std::size_t>(std::ceil(end_mm / step_mm));
    impulses_n_s_.assign(1, glm::dvec3(0.0));
    for (std::size_t i = 1; i <= steps; ++i) {
        mill_to(static_cast<double>(i) * step_mm, true);
        impulses_n_s_.push_back(impulses_n_s_.back() + step_s * result->force_n);
    }
}

glm::dvec3 ImpulseByWay::at(double way_mm) const {
    const double steps = std::max(way_mm, 0.0) / step_mm;
    const std::size_t below = std::min(static_cast<std::size_t>(steps), impulses_n_s_.size() - 2);
    const double share = steps - static_cast<double>(below);
    return impulses_n_s_[below] + share * (impulses_n_s_[below + 1] - impulses_n_s_[below]);
}

double ImpulseByWay::along(double way_mm) const {
    return glm::dot(at(way_mm), direction_);
}

namespace {

constexpr int substeps = 50;
constexpr double substep_s = tick_s / substeps;
constexpr double after_stop_s = 0.1;
constexpr int mean_over_ticks = 5;

/// The hand's intended way and speed along the line.
struct Plan {
    explicit Plan(const Onset& onset)
        : end_mm(onset.before_touch_mm + onset.way_mm), speed_mm_per_s(onset.speed_mm_per_s) {}

    double way_mm(double time_s) const { return std::min(speed_mm_per_s * time_s, end_mm); }
    double speed_at(double time_s) const { return speed_mm_per_s * time_s < end_mm ? speed_mm_per_s : 0.0; }
    /// A prescribed hand that stops takes its force away; a guided one still pushes.
    int ticks(bool is_guided) const {
        return static_cast<int>(
            std::ceil((end_mm / speed_mm_per_s + (is_guided ? after_stop_s : 0.0)) / tick_s));
    }

    double end_mm;
    double speed_mm_per_s;
};

/// A hand that is led, or a firm one that means to go as planned; along the line, which is the first axis.
class HandOnLine {
  public:
    HandOnLine(const Onset& onset, bool is_guided) : plan_(onset), is_guided_(is_guided) {
        motion_.velocity_mm_per_s.x = onset.speed_mm_per_s;
    }

    double way_mm() const { return motion_.position_mm.x; }
    double speed_mm_per_s() const { return motion_.velocity_mm_per_s.x; }

    /// A substep under a force that is held.
    void move(double force_n) {
        if (!is_guided_) return lead();
        motion_ = fine_step(tool_, intent(), motion_, 0.0, {force_n, 0.0, 0.0}, substep_s);
        ++substeps_;
    }

    /// A substep in bone. `impulse_n_s` is the remaining impulse of the bone as a function of the way,
    /// negative if it resists.
    template <typename Impulse>
    void move_in_bone(Impulse&& impulse_n_s) {
        if (!is_guided_) return lead();
        const OpenStep open = open_step(tool_, intent(), motion_, 0.0, substep_s);
        const double from_mm = way_mm();
        const double inertia = open.inertia_n_s_per_mm.x;
        const auto excess_n = [&](double speed) {
            return inertia * speed - open.drive_n.x - impulse_n_s(from_mm + speed * substep_s) / substep_s;
        };
        // Without bone it is the free speed; bone only takes from it, down to rest or to that if it is back.
        double high = open.drive_n.x / inertia;
        double low = std::min(high, 0.0);
        if (excess_n(high) > 0.0)
            for (int halving = 0; halving < 50; ++halving) {
                const double middle = 0.5 * (low + high);
                (excess_n(middle) > 0.0 ? high : low) = middle;
            }
        motion_.velocity_mm_per_s.x = high;
        motion_.position_mm.x = from_mm + high * substep_s;
        ++substeps_;
    }

  private:
    double time_s() const { return substeps_ * substep_s; }

    void lead() {
        ++substeps_;
        motion_.position_mm.x = plan_.way_mm(time_s());
        motion_.velocity_mm_per_s.x = plan_.speed_at(time_s());
    }

    /// From now on; in air the arm goes steadily.
    HandIntent intent() const {
        const ToolMotion planned{{plan_.way_mm(time_s()), 0.0, 0.0}, {plan_.speed_at(time_s()), 0.0, 0.0}};
        return steady_intent(tool_, planned, glm::dvec3(0.0));
    }

    HeldTool tool_ = held_tool(MapGrip::firm);
    Plan plan_;
    bool is_guided_;
    ToolMotion motion_;
    int substeps_ = 0;
};

std::vector<glm::dvec3> exact_forces(const Onset& onset, const ImpulseByWay& impulse, bool is_guided) {
    HandOnLine hand(onset, is_guided);
    double deepest_mm = 0.0;
    std::vector<glm::dvec3> forces_n;
    for (int tick = 0; tick < Plan(onset).ticks(is_guided); ++tick) {
        const glm::dvec3 before_n_s = impulse.at(deepest_mm);
        for (int i = 0; i < substeps; ++i) {
            hand.move_in_bone([&](double way_mm) {
                return impulse.along(std::max(way_mm, deepest_mm)) - impulse.along(deepest_mm);
            });
            deepest_mm = std::max(deepest_mm, hand.way_mm());
        }
        forces_n.push_back((impulse.at(deepest_mm) - before_n_s) / tick_s);
    }
    return forces_n;
}

/// The burr on the spring against bone that is known exactly, for a tick after another.
class IdealBurr {
  public:
    IdealBurr(const PatientLimits& arm, const ImpulseByWay& impulse, const OnsetLine& line)
        : spring_(arm, ImplicitCoupling::burr_filter_s), impulse_(impulse), direction_(line.direction) {
        spring_.place(glm::dvec3(0.0));
    }

    glm::dvec3 tick(double hand_mm) {
        const LinearPull pull = spring_.follow_hand({hand_mm, 0.0, 0.0}, tick_s);
        const auto excess_n = [&](double step_mm) {
            const double to_mm = std::max(way_mm_ + step_mm, deepest_mm_);
            return pull.offset_n.x - pull.stiffness_n_per_mm * step_mm +
                   (impulse_.along(to_mm) - impulse_.along(deepest_mm_)) / tick_s;
        };
        const double free_mm = pull.offset_n.x / pull.stiffness_n_per_mm;
        if (impulse_.along(std::max(way_mm_ + free_mm, deepest_mm_)) == impulse_.along(deepest_mm_)) {
            way_mm_ = hand_mm;  // in air it is the hand
        } else {
            double low = std::min(0.0, free_mm);
            double high = free_mm;
            while (excess_n(low) < 0.0) low -= 0.1;
            for (int halving = 0; halving < 50; ++halving) {
                const double middle = 0.5 * (low + high);
                (excess_n(middle) < 0.0 ? high : low) = middle;
            }
            way_mm_ += high;
        }
        const double cut_to_mm = std::max(way_mm_, deepest_mm_);
        const glm::dvec3 bone_n = (impulse_.at(cut_to_mm) - impulse_.at(deepest_mm_)) / tick_s;
        deepest_mm_ = cut_to_mm;
        const double along_n = spring_.follow_burr({way_mm_, 0.0, 0.0}, tick_s).x;
        return along_n * direction_ + bone_n - glm::dot(bone_n, direction_) * direction_;
    }

  private:
    CouplingSpring spring_;
    const ImpulseByWay& impulse_;
    glm::dvec3 direction_;
    double way_mm_ = 0.0;
    double deepest_mm_ = 0.0;
};

/// The program's coupling beside the milling model.
class CoupledBurr {
  public:
    CoupledBurr(const Onset& onset, const OnsetLine& line, const PatientLimits& arm, const OnsetHand& hand)
        : line_(line),
          model_(bone_of(onset), {onset.burr}, {}),
          coupling_(make_coupling(coupling_named(hand.coupling),
                                  {.device = arm, .feed_forward = hand.feed_forward})) {
        for (const bool spindle_on : {false, true}) mill(line.at(0.0), spindle_on, 0.0);
    }

    glm::dvec3 tick(const HandOnLine& hand, double now_s) {
        const CouplingOutput out =
            coupling_->tick({.now_s = now_s,
                             .tick_s = tick_s,
                             .pose = {line_.at(hand.way_mm()), line_.spindle_axis},
                             .velocity_mm_per_s = hand.speed_mm_per_s() * line_.direction,
                             .spindle_on = true},
                            *latest_);
        mill(out.burr_pose.position_mm, true, now_s);
        return out.force_n;
    }

  private:
    void mill(const glm::dvec3& to_mm, bool spindle_on, double now_s) {
        model_.step({.pose = {to_mm, line_.spindle_axis}, .spindle_on = spindle_on, .elapsed_s = tick_s},
                    now_s, changes_, *latest_);
    }

    OnsetLine line_;
    MillingModel model_;
    std::unique_ptr<Coupling> coupling_;
    ForgottenChanges changes_;
    std::unique_ptr<MillingResult> latest_ = std::make_unique<MillingResult>();
};

/// The hand, moved between ticks by what `tick` answers.
template <typename Tick>
std::vector<glm::dvec3> sampled_forces(const Onset& onset, const OnsetLine& line, bool is_guided,
                                       Tick&& tick) {
    HandOnLine hand(onset, is_guided);
    glm::dvec3 force_n(0.0);
    std::vector<glm::dvec3> forces_n;
    for (int i = 0; i < Plan(onset).ticks(is_guided); ++i) {
        for (int k = 0; k < substeps; ++k) hand.move(glm::dot(force_n, line.direction));
        force_n = tick(hand, (i + 1) * tick_s);
        forces_n.push_back(force_n);
    }
    return forces_n;
}

void require_possible(const Onset& onset, const OnsetHand& hand) {
    if (!(hand.stiffness_n_per_mm > 0.0 && hand.damping_n_s_per_mm >= 0.0))
        throw std::invalid_argument("an onset's spring is above 0, its damper 0 or more");
    if (!(onset.speed_mm_per_s > 0.0 && onset.before_touch_mm > 0.0 && onset.way_mm > 0.0 &&
          onset.way_mm <= 3.0))
        throw std::invalid_argument("an onset's speed and ways are above 0, its way up to 3 mm");
}

}  // namespace

OnsetRun run_onset(const Onset& onset, const OnsetHand& hand) {
    require_possible(onset, hand);
    const ImpulseByWay impulse(onset);
    const OnsetLine line = line_of(onset);
    PatientLimits arm;
    arm.max_stiffness_n_per_mm = hand.stiffness_n_per_mm;
    arm.damping_n_s_per_mm = hand.damping_n_s_per_mm;
    IdealBurr ideal(arm, impulse, line);
    CoupledBurr coupled(onset, line, arm, hand);
    return {.exact_n = exact_forces(onset, impulse, hand.is_guided),
            .ideal_n = sampled_forces(onset, line, hand.is_guided,
                                      [&](const HandOnLine& at, double) { return ideal.tick(at.way_mm()); }),
            .felt_n = sampled_forces(onset, line, hand.is_guided, [&](const HandOnLine& at, double now_s) {
                return coupled.tick(at, now_s);
            })};
}

OnsetPeak peak_of(const std::vector<glm::dvec3>& forces_n, double of_peak_n) {
    OnsetPeak found{.half_ms = static_cast<double>(forces_n.size()) * tick_s * 1e3};
    bool is_half = false;
    glm::dvec3 sum_n(0.0);
    for (std::size_t i = 0; i < forces_n.size(); ++i) {
        sum_n += forces_n[i];
        if (i >= mean_over_ticks) sum_n -= forces_n[i - mean_over_ticks];
        const double mean_n = glm::length(sum_n) / mean_over_ticks;
        found.peak_n = std::max(found.peak_n, mean_n);
        if (!is_half && mean_n > 0.5 * of_peak_n) {
            is_half = true;
            found.half_ms = static_cast<double>(i + 1) * tick_s * 1e3;
        }
    }
    return found;
}

}  // namespace osteomill::study
