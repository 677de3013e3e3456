#include "haptic_server/coupling/burr_proxy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

constexpr double handpiece_n_s2_per_mm = BurrProxy::handpiece_kg * 1e-3;

/// Share of a patch that touches the bone.
double touching_share(double gap_voxels) {
    constexpr double width = BurrProxy::surely_apart_voxels - BurrProxy::surely_touching_voxels;
    return std::clamp((BurrProxy::surely_apart_voxels - gap_voxels) / width, 0.0, 1.0);
}

glm::dvec3 no_longer_than(const glm::dvec3& step_mm, double longest_mm) {
    const double length_mm = glm::length(step_mm);
    return length_mm > longest_mm ? step_mm * (longest_mm / length_mm) : step_mm;
}

}  // namespace

void BurrProxy::place(const glm::dvec3& position_mm) noexcept {
    position_mm_ = target_mm_ = position_mm;
    velocity_mm_per_s_ = glm::dvec3(0.0);
    given_mj_ = 0.0;
    map_step_ = 0;
    correction_.reset();
    cut_mm_.fill(0.0);
}

void BurrProxy::take_over(const MillingResult& latest) noexcept {
    if (latest.step == map_step_) return;
    map_step_ = latest.step;
    if (latest.spindle_on) correction_.compare(latest.force_n, latest.time_s, latest.pose.spindle_axis);
    const Engagement& engagement = latest.engagement;
    const glm::dvec3 moved = position_mm_ - engagement.burr_position_mm;
    for (std::size_t i = 0; i < engagement.count; ++i)
        cut_mm_[i] = std::max(0.0, glm::dot(engagement.patches[i].normal, moved));
}

std::span<const Contact> BurrProxy::gather_contacts(double longest_mm, double step_s, bool spindle_on,
                                                    const Engagement& engagement) noexcept {
    std::size_t count = 0;
    const glm::dvec3 moved = position_mm_ - engagement.burr_position_mm;
    const auto add = [&](const glm::dvec3& normal, const glm::dvec3& force_n_per_mm, double begins_mm) {
        if (begins_mm <= longest_mm) contacts_[count++] = {normal, force_n_per_mm, begins_mm};
    };
    for (std::size_t i = 0; i < engagement.count; ++i) {
        const EngagedPatch& patch = engagement.patches[i];
        const double along = glm::dot(patch.normal, moved);
        if (!spindle_on) {
            add(patch.normal, -wall_n_per_mm3 * patch.area_mm2 * patch.normal, patch.gap_mm - along);
            continue;
        }
        const double share = touching_share(patch.gap_mm / engagement.spacing_mm);
        const double begins = cut_mm_[i] - along;
        const double begins_beyond_gap = std::max(patch.gap_mm, cut_mm_[i]) - along;
        if ((share > 0.0 ? begins : begins_beyond_gap) > longest_mm) continue;
        const glm::dvec3 force = correction_.gain() * patch.cutting_n_s_per_mm / step_s;
        if (share > 0.0) add(patch.normal, share * force, begins);
        if (share < 1.0) add(patch.normal, (1.0 - share) * force, begins_beyond_gap);
    }
    return {contacts_.data(), count};
}

void BurrProxy::remember_cuts(const Engagement& engagement) noexcept {
    const glm::dvec3 moved = position_mm_ - engagement.burr_position_mm;
    for (std::size_t i = 0; i < engagement.count; ++i)
        cut_mm_[i] = std::max(cut_mm_[i], glm::dot(engagement.patches[i].normal, moved));
}

BurrProxy::Outcome BurrProxy::step_without_mass(const glm::dvec3& pull_mm, const glm::dvec3& hand_step_mm,
                                                double tick_s, bool is_damped,
                                                const Engagement& engagement) noexcept {
    LinearPull pull{spring_n_per_mm_ * pull_mm, spring_n_per_mm_};
    if (is_damped) {
        const double damping_n_per_mm = runaway_damping_n_s_per_mm / tick_s;
        pull.offset_n += damping_n_per_mm * hand_step_mm;
        pull.stiffness_n_per_mm += damping_n_per_mm;
    }
    // The force may turn the step sideways, but hardly makes it longer than the pull (K_r, K_a >= 0).
    const double longest_mm = glm::length(pull_mm) + 2.0 * engagement.spacing_mm;
    const auto contacts = gather_contacts(longest_mm, tick_s, true, engagement);
    // Without bone exactly there, so that nothing is felt: k x / k need not be x.
    const glm::dvec3 free_step_mm = is_damped ? pull.free_step_mm() : pull_mm;
    if (contacts.empty()) return {.step_mm = free_step_mm};
    const ContactStep solved = balance(pull, contacts);
    iterations_ += solved.iterations;
    if (solved.bone_force_n == glm::dvec3(0.0)) return {.step_mm = free_step_mm};
    return {.step_mm = solved.step_mm,
            .bone_force_n = solved.bone_force_n,
            .energy_mj = glm::dot(solved.bone_force_n, solved.step_mm),
            .residual_n = solved.residual_n};
}

BurrProxy::Outcome BurrProxy::step_with_mass(const glm::dvec3& pull_mm, const glm::dvec3& hand_step_mm,
                                             double tick_s, bool is_damped,
                                             const Engagement& engagement) noexcept {
    const glm::dvec3 from_mm = position_mm_;
    const glm::dvec3 target_mm = position_mm_ + pull_mm;
    const double step_s = tick_s / substeps;
    const double inertia_n_per_mm = handpiece_n_s2_per_mm / (step_s * step_s);
    const double damping_n_per_mm = is_damped ? runaway_damping_n_s_per_mm / step_s : 0.0;
    const glm::dvec3 hand_substep_mm = hand_step_mm / static_cast<double>(substeps);
    glm::dvec3 velocity = velocity_mm_per_s_;
    Outcome outcome;
    for (int i = 0; i < substeps; ++i) {
        const LinearPull pull{spring_n_per_mm_ * (target_mm - position_mm_) +
                                  inertia_n_per_mm * step_s * velocity + damping_n_per_mm * hand_substep_mm,
                              spring_n_per_mm_ + inertia_n_per_mm + damping_n_per_mm};
        const double longest_mm = glm::length(pull.free_step_mm()) + 2.0 * engagement.spacing_mm;
        const auto contacts = gather_contacts(longest_mm, step_s, true, engagement);
        ContactStep solved = balance(pull, contacts);
        iterations_ += solved.iterations;
        if (solved.residual_n > balance_tolerance_n) {
            solved = relaxed_step(pull, contacts);
            iterations_ += solved.iterations;
            outcome.is_relaxed = true;
        }
        const glm::dvec3 step =
            no_longer_than(solved.step_mm, glm::length(hand_substep_mm) + most_slip_mm_per_s * step_s);
        velocity = step / step_s;
        position_mm_ += step;
        remember_cuts(engagement);
        outcome.bone_force_n += solved.bone_force_n / static_cast<double>(substeps);
        outcome.energy_mj += glm::dot(solved.bone_force_n, step);
        outcome.residual_n = std::max(outcome.residual_n, solved.residual_n);
    }
    outcome.step_mm = position_mm_ - from_mm;
    position_mm_ = from_mm;
    return outcome;
}

void BurrProxy::cut_toward(const glm::dvec3& target_mm, double tick_s,
                           const Engagement& engagement) noexcept {
    const glm::dvec3 pull_mm = target_mm - position_mm_;
    const glm::dvec3 hand_step_mm = target_mm - target_mm_;
    const double remembered_mj = given_mj_ * std::max(0.0, 1.0 - tick_s / energy_memory_s);

    bool is_damped = false;
    Outcome outcome = step_without_mass(pull_mm, hand_step_mm, tick_s, false, engagement);
    const auto runs_away = [&] {
        return outcome.energy_mj > 0.0 && remembered_mj + outcome.energy_mj > allowed_energy_mj;
    };
    if (outcome.residual_n <= balance_tolerance_n && runs_away()) {
        is_damped = true;
        ++counts_.damped;
        outcome = step_without_mass(pull_mm, hand_step_mm, tick_s, true, engagement);
    }
    const bool has_mass = outcome.residual_n > balance_tolerance_n;
    if (has_mass) {
        ++counts_.fallbacks;
        is_damped = is_damped || remembered_mj > allowed_energy_mj;
        outcome = step_with_mass(pull_mm, hand_step_mm, tick_s, is_damped, engagement);
        if (outcome.is_relaxed) ++counts_.relaxed;
    }
    counts_.max_residual_n = std::max(counts_.max_residual_n, outcome.residual_n);
    given_mj_ = std::clamp(remembered_mj + outcome.energy_mj, 0.0, most_remembered_mj);

    const glm::dvec3 step_mm =
        no_longer_than(outcome.step_mm, glm::length(hand_step_mm) + most_slip_mm_per_s * tick_s);
    position_mm_ = step_mm == pull_mm ? target_mm : position_mm_ + step_mm;
    const bool feels_spring_alone = !is_damped && !has_mass;
    correction_.add_prediction(
        feels_spring_alone ? spring_n_per_mm_ * (position_mm_ - target_mm) : outcome.bone_force_n, tick_s);
    remember_cuts(engagement);
}

void BurrProxy::press_toward(const glm::dvec3& target_mm, double tick_s,
                             const Engagement& engagement) noexcept {
    const glm::dvec3 pull_mm = target_mm - position_mm_;
    const LinearPull pull{spring_n_per_mm_ * pull_mm, spring_n_per_mm_};
    const double longest_mm = glm::length(pull_mm) + 2.0 * engagement.spacing_mm;
    const auto contacts = gather_contacts(longest_mm, tick_s, false, engagement);
    correction_.reset();
    given_mj_ = 0.0;
    if (contacts.empty()) {
        position_mm_ = target_mm;
        return;
    }
    const ContactStep solved = relaxed_step(pull, contacts);
    iterations_ += solved.iterations;
    counts_.max_residual_n = std::max(counts_.max_residual_n, solved.residual_n);
    position_mm_ += solved.step_mm;
}

void BurrProxy::advance(const glm::dvec3& target_mm, double tick_s, bool spindle_on,
                        const MillingResult& latest) noexcept {
    take_over(latest);
    iterations_ = 0;
    const glm::dvec3 before_mm = position_mm_;
    if (spindle_on)
        cut_toward(target_mm, tick_s, latest.engagement);
    else
        press_toward(target_mm, tick_s, latest.engagement);
    velocity_mm_per_s_ = (position_mm_ - before_mm) / tick_s;
    target_mm_ = target_mm;
}

}  // namespace osteomill
