#include "simulation/coupling/burr_proxy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

/// Share of a patch that touches the bone.
double touching_share(double gap_voxels, const TouchingGaps& gaps) {
    return std::clamp((gaps.apart_voxels - gap_voxels) / (gaps.apart_voxels - gaps.touching_voxels), 0.0,
                      1.0);
}

/// Energy with which bone separates the burr that it drives from the hand; below 0 if it does not.
double drive_mj(const glm::dvec3& cutting_force_n, const glm::dvec3& step_mm,
                const glm::dvec3& hand_step_mm) {
    return std::min(glm::dot(cutting_force_n, step_mm), glm::dot(cutting_force_n, step_mm - hand_step_mm));
}

/// The step that the hidden damper lets the burr follow: the hand's, shorter the more the hand goes where the
/// spring pulls it.
glm::dvec3 followed_mm(const glm::dvec3& hand_step_mm, const glm::dvec3& on_hand_n) {
    const double lengths = glm::length(hand_step_mm) * glm::length(on_hand_n);
    if (lengths == 0.0) return hand_step_mm;
    return hand_step_mm * (1.0 - std::clamp(glm::dot(hand_step_mm, on_hand_n) / lengths, 0.0, 1.0));
}

/// The step of a burr that a wall also holds back by friction; `solved` is the step without it. Friction
/// shortens the motion along the wall, or stops it. Exact for a flat wall, since the pull is alike in every
/// direction.
glm::dvec3 with_friction(const ContactStep& solved, double pull_n_per_mm, double friction) {
    const double normal_n = glm::length(solved.bone_force_n);
    const glm::dvec3 normal = solved.bone_force_n / normal_n;
    const glm::dvec3 along_mm = solved.step_mm - glm::dot(solved.step_mm, normal) * normal;
    const double sliding_n = pull_n_per_mm * glm::length(along_mm);
    const double held = friction * normal_n;
    return solved.step_mm - along_mm * (sliding_n > held ? held / sliding_n : 1.0);
}

glm::dvec3 no_longer_than(const glm::dvec3& step_mm, double longest_mm) {
    const double length_mm = glm::length(step_mm);
    return length_mm > longest_mm ? step_mm * (longest_mm / length_mm) : step_mm;
}

}  // namespace

void BurrProxy::place(const glm::dvec3& position_mm) noexcept {
    position_mm_ = carving_mm_ = target_mm_ = hand_mm_ = position_mm;
    apart_mj_ = 0.0;
    pulled_n_ = glm::dvec3(0.0);
    map_step_ = 0;
    map_period_s_ = 0.0;
    walls_ = {};
    correction_.reset();
    cut_mm_.fill(0.0);
}

void BurrProxy::take_over(const MillingResult& latest) noexcept {
    if (latest.step == map_step_) return;
    map_step_ = latest.step;
    map_period_s_ = latest.time_s - map_time_s_;
    map_time_s_ = latest.time_s;
    if (latest.spindle_on) correction_.compare(latest.force_n, latest.time_s, latest.pose.spindle_axis);
    const Engagement& engagement = latest.engagement;
    std::fill_n(cut_mm_.begin(), engagement.count, 0.0);
    remember_cuts(engagement);
}

BurrProxy::Reach BurrProxy::reach_of(std::size_t patch, const Engagement& engagement) const noexcept {
    const EngagedPatch& at = engagement.patches[patch];
    const TouchingGaps& gaps = map_period_s_ > longest_quick_period_s ? slow_gaps : quick_gaps;
    const double along_mm = glm::dot(at.normal, position_mm_ - engagement.burr_position_mm);
    return {.share = touching_share(at.gap_mm / engagement.spacing_mm, gaps),
            .begins_mm = cut_mm_[patch] - along_mm,
            .begins_beyond_gap_mm = std::max(at.gap_mm, cut_mm_[patch]) - along_mm};
}

double BurrProxy::resistance_n_s_per_mm(const glm::dvec3& step_mm,
                                        const MillingResult& latest) const noexcept {
    const double squared_mm2 = glm::dot(step_mm, step_mm);
    if (squared_mm2 == 0.0) return 0.0;
    const Engagement& engagement = latest.engagement;
    glm::dvec3 impulse_n_s(0.0);
    for (std::size_t i = 0; i < engagement.count; ++i) {
        const EngagedPatch& patch = engagement.patches[i];
        if (patch.is_wall) continue;
        const Reach reach = reach_of(i, engagement);
        const double advance_mm = glm::dot(patch.normal, step_mm);
        impulse_n_s += (reach.share * std::max(0.0, advance_mm - reach.begins_mm) +
                        (1.0 - reach.share) * std::max(0.0, advance_mm - reach.begins_beyond_gap_mm)) *
                       patch.cutting_n_s_per_mm;
    }
    return std::max(0.0, -glm::dot(step_mm, correction_.gain() * impulse_n_s) / squared_mm2);
}

std::span<const Contact> BurrProxy::gather_contacts(double longest_mm, double step_s, Meets meets,
                                                    const glm::dvec3& pull_n,
                                                    const Engagement& engagement) noexcept {
    std::size_t count = 0;
    const double most_out_mm = scale_.speed_mm_per_s(most_push_out_mm_per_s) * step_s;
    const glm::dvec3 moved = position_mm_ - engagement.burr_position_mm;
    const double yields_mm = engagement.has_edge_force && meets == Meets::chips ? edge_yields_mm : 0.0;
    const auto add = [&](const glm::dvec3& normal, const glm::dvec3& force_n_per_mm, double begins_mm,
                         const glm::dvec3& yield_n) {
        if (begins_mm <= longest_mm)
            contacts_[count++] = {normal, force_n_per_mm, begins_mm, yield_n, yields_mm};
    };
    const auto add_wall = [&](const glm::dvec3& normal, double area_mm2, double begins_mm) {
        if (begins_mm <= longest_mm)
            contacts_[count++] = {.normal = normal,
                                  .force_n_per_mm = -wall_n_per_mm3_ * area_mm2 * normal,
                                  .begins_mm = begins_mm};
    };
    for (std::size_t i = 0; i < engagement.count; ++i) {
        const EngagedPatch& patch = engagement.patches[i];
        if (meets == Meets::all_as_walls || patch.is_wall) {
            add_wall(patch.normal, patch.area_mm2, patch.gap_mm - glm::dot(patch.normal, moved));
            continue;
        }
        if (meets == Meets::walls_only) continue;
        const auto [share, begins, begins_beyond_gap] = reach_of(i, engagement);
        if ((share > 0.0 ? begins : begins_beyond_gap) > longest_mm) continue;
        const glm::dvec3 force = correction_.gain() * patch.cutting_n_s_per_mm / step_s;
        const glm::dvec3 yield = correction_.gain() * patch.edge_n;
        if (share > 0.0) add(patch.normal, share * force, begins, share * yield);
        if (share < 1.0) add(patch.normal, (1.0 - share) * force, begins_beyond_gap, (1.0 - share) * yield);
    }
    for (std::size_t i = 0; i < engagement.shank_count; ++i) {
        const ShankPatch& patch = engagement.shank_patches[i];
        const double deepest_mm = most_out_mm + glm::length(pull_n) / (wall_n_per_mm3_ * patch.area_mm2);
        shank_begins_mm_[i] = std::max(patch.gap_mm - glm::dot(patch.normal, moved), -deepest_mm);
        add_wall(patch.normal, patch.area_mm2, shank_begins_mm_[i]);
    }
    return {contacts_.data(), count};
}

BurrProxy::WallReaction BurrProxy::wall_reaction(const glm::dvec3& step_mm,
                                                 const Engagement& engagement) const noexcept {
    WallReaction reaction;
    for (std::size_t i = 0; i < engagement.shank_count; ++i) {
        const ShankPatch& patch = engagement.shank_patches[i];
        const double beyond_mm = glm::dot(patch.normal, step_mm) - shank_begins_mm_[i];
        if (beyond_mm <= 0.0) continue;
        const glm::dvec3 force_n = -wall_n_per_mm3_ * patch.area_mm2 * beyond_mm * patch.normal;
        reaction.force_n += force_n;
        reaction.torque_n_mm += glm::cross(patch.arm_mm, force_n);
    }
    const glm::dvec3 moved = position_mm_ + step_mm - engagement.burr_position_mm;
    for (std::size_t i = 0; engagement.has_walls && i < engagement.count; ++i) {
        const EngagedPatch& patch = engagement.patches[i];
        const double beyond_mm = glm::dot(patch.normal, moved) - patch.gap_mm;
        if (patch.is_wall && beyond_mm > 0.0)
            reaction.force_n -= wall_n_per_mm3_ * patch.area_mm2 * beyond_mm * patch.normal;
    }
    return reaction;
}

void BurrProxy::remember_cuts(const Engagement& engagement) noexcept {
    const glm::dvec3 moved = position_mm_ - engagement.burr_position_mm;
    const double yields_mm = engagement.has_edge_force ? edge_yields_mm : 0.0;
    for (std::size_t i = 0; i < engagement.count; ++i)
        cut_mm_[i] = std::max(cut_mm_[i], glm::dot(engagement.patches[i].normal, moved) - yields_mm);
}

void BurrProxy::trail(bool is_held, const Engagement& engagement) noexcept {
    if (!is_held || !engagement.has_edge_force) {
        carving_mm_ = position_mm_;
        return;
    }
    carving_mm_ = position_mm_ + no_longer_than(carving_mm_ - position_mm_, carving_trails_mm);
}

ContactStep BurrProxy::balance_with_bone(const LinearPull& pull, const glm::dvec3& hand_step_mm,
                                         double tick_s, std::span<const Contact> contacts,
                                         const Engagement& engagement) noexcept {
    glm::dmat3 damping_n_per_mm(0.0);
    LinearPull damped = pull;
    const glm::dvec3 damper_follows_mm = followed_mm(hand_step_mm, pull.of_fixtures_n - pull.offset_n);
    const auto add_up = [&](const ContactStep& step) {
        iterations_ += step.iterations;
        return step;
    };
    const auto solve = [&] {
        damped.offset_n = pull.offset_n + damping_n_per_mm * damper_follows_mm;
        damped.damping_n_per_mm = pull.damping_n_per_mm + damping_n_per_mm;
        // If edges rub, from rest, which finds the balance nearby. Newton may be caught where a contact
        // begins; then the other start succeeds.
        const glm::dvec3 free_mm = damped.free_step_mm();
        const glm::dvec3 rest_mm(0.0);
        const ContactStep first =
            add_up(balance(damped, contacts, engagement.has_edge_force ? rest_mm : free_mm));
        if (first.residual_n <= balance_tolerance_n) return first;
        return add_up(balance(damped, contacts, engagement.has_edge_force ? free_mm : rest_mm));
    };
    ContactStep solved = solve();
    const auto is_balanced = [&] { return solved.residual_n <= balance_tolerance_n; };
    const glm::dvec3 cutting_n = solved.bone_force_n - wall_reaction(solved.step_mm, engagement).force_n;
    const double energy_mj = drive_mj(cutting_n, solved.step_mm, hand_step_mm);
    const bool runs_away = energy_mj > 0.0 && apart_mj_ + energy_mj > scale_.energy_mj(allowed_apart_mj);
    if (is_balanced() && !runs_away) return solved;

    if (is_balanced())
        ++counts_.damped;
    else
        ++counts_.fallbacks;
    double without_balance_n_per_mm = least_damping_n_s_per_mm / tick_s;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
        // The drive that the damping does not make up for yet.
        const glm::dmat3 drive =
            driving_part(solved.resistance_n_per_mm + damping_n_per_mm / drive_to_damping);
        const double sum_n_per_mm = drive[0][0] + drive[1][1] + drive[2][2];
        if (is_balanced() && sum_n_per_mm < negligible_drive_n_per_mm) return solved;
        damping_n_per_mm += drive_to_damping * drive;
        if (!is_balanced()) {
            damping_n_per_mm += glm::dmat3(without_balance_n_per_mm);
            without_balance_n_per_mm *= 4.0;
        }
        solved = solve();
    }
    if (is_balanced()) return solved;
    ++counts_.relaxed;
    solved = relaxed_step(damped, contacts);
    iterations_ += solved.iterations;
    return solved;
}

void BurrProxy::move(const glm::dvec3& step_mm, const glm::dvec3& target_mm, const LinearPull& pull,
                     double tick_s) noexcept {
    const glm::dvec3 change_n = pull.tie_n(step_mm) - pulled_n_;
    const double most_n = most_release_n_per_s * tick_s;
    if (pulled_n_ != glm::dvec3(0.0) && glm::length(change_n) > most_n) {
        const glm::dvec3 lets_go_to_n = pulled_n_ + no_longer_than(change_n, most_n);
        const glm::dvec3 slowed_mm =
            (pull.offset_n - pull.of_fixtures_n - lets_go_to_n) / pull.stiffness_n_per_mm;
        if (glm::length(slowed_mm) < glm::length(step_mm)) {
            position_mm_ += slowed_mm;
            return;
        }
    }
    position_mm_ = step_mm == target_mm - position_mm_ ? target_mm : position_mm_ + step_mm;
}

void BurrProxy::cut_toward(const glm::dvec3& target_mm, const glm::dvec3& hand_mm, const LinearPull& pull,
                           double tick_s, const Engagement& engagement) noexcept {
    const glm::dvec3 pull_mm = target_mm - position_mm_;
    const glm::dvec3 hand_step_mm = hand_mm - hand_mm_;
    apart_mj_ *= std::max(0.0, 1.0 - tick_s / apart_memory_s);
    // The force may turn the step sideways, but hardly makes it longer than the pull (K_r, K_a >= 0).
    const double longest_mm = glm::length(pull_mm) + 2.0 * engagement.spacing_mm;
    const auto contacts = gather_contacts(longest_mm, tick_s, Meets::chips, pull.offset_n, engagement);
    ContactStep solved{.step_mm = pull_mm};
    if (!contacts.empty()) {
        solved = balance_with_bone(pull, hand_step_mm, tick_s, contacts, engagement);
        // Without bone the burr is exactly at the target, so that nothing is felt.
        if (solved.bone_force_n == glm::dvec3(0.0)) solved.step_mm = pull_mm;
    }
    counts_.max_residual_n = std::max(counts_.max_residual_n, solved.residual_n);
    walls_ = wall_reaction(solved.step_mm, engagement);
    const glm::dvec3 cutting_n = solved.bone_force_n - walls_.force_n;
    apart_mj_ = std::clamp(apart_mj_ + drive_mj(cutting_n, solved.step_mm, hand_step_mm), 0.0,
                           scale_.energy_mj(most_apart_mj));

    move(solved.step_mm, target_mm, pull, tick_s);
    correction_.add_prediction(cutting_n, tick_s);
    remember_cuts(engagement);
    trail(solved.bone_force_n != glm::dvec3(0.0), engagement);
}

void BurrProxy::press_toward(const glm::dvec3& target_mm, const LinearPull& pull, double tick_s, Meets meets,
                             const Engagement& engagement) noexcept {
    const glm::dvec3 pull_mm = target_mm - position_mm_;
    const double longest_mm = glm::length(pull_mm) + 2.0 * engagement.spacing_mm;
    const auto contacts = gather_contacts(longest_mm, tick_s, meets, pull.offset_n, engagement);
    correction_.reset();
    apart_mj_ = 0.0;
    if (contacts.empty()) {
        walls_ = {};
        move(pull_mm, target_mm, pull, tick_s);
        return;
    }
    const ContactStep solved = relaxed_step(pull, contacts);
    iterations_ += solved.iterations;
    walls_ = wall_reaction(solved.step_mm, engagement);
    counts_.max_residual_n = std::max(counts_.max_residual_n, solved.residual_n);
    const bool is_held = solved.bone_force_n != glm::dvec3(0.0);
    const bool rubs = is_held && wall_friction_ > 0.0;
    const glm::dvec3 held_mm =
        rubs ? with_friction(solved, pull.stiffness_n_per_mm, wall_friction_) : solved.step_mm;
    const glm::dvec3 step_mm = is_held ? held_mm : pull_mm;
    // A wall may stretch the spring as fast as it likes.
    if (glm::length(pull_mm - step_mm) > glm::length(target_mm_ - position_mm_))
        position_mm_ += step_mm;
    else
        move(step_mm, target_mm, pull, tick_s);
}

void BurrProxy::remember_pull(const LinearPull& pull, const glm::dvec3& before_mm,
                              const glm::dvec3& target_mm) noexcept {
    const bool is_hand = position_mm_ == target_mm && !pull.has_fixtures;
    pulled_n_ = is_hand ? glm::dvec3(0.0) : pull.tie_n(position_mm_ - before_mm);
}

void BurrProxy::advance(const glm::dvec3& target_mm, const glm::dvec3& hand_mm, const LinearPull& pull,
                        double tick_s, bool spindle_on, const MillingResult& latest) noexcept {
    take_over(latest);
    iterations_ = 0;
    const glm::dvec3 before_mm = position_mm_;
    if (spindle_on)
        cut_toward(target_mm, hand_mm, pull, tick_s, latest.engagement);
    else
        press_toward(target_mm, pull, tick_s, Meets::all_as_walls, latest.engagement);
    if (!spindle_on) carving_mm_ = position_mm_;
    remember_pull(pull, before_mm, target_mm);
    target_mm_ = target_mm;
    hand_mm_ = hand_mm;
}

void BurrProxy::advance_on_walls(const glm::dvec3& hand_mm, const LinearPull& pull, double tick_s,
                                 const MillingResult& latest) noexcept {
    take_over(latest);
    iterations_ = 0;
    const glm::dvec3 before_mm = position_mm_;
    press_toward(hand_mm, pull, tick_s, Meets::walls_only, latest.engagement);
    carving_mm_ = position_mm_;
    remember_pull(pull, before_mm, hand_mm);
    target_mm_ = hand_mm_ = hand_mm;
}

}  // namespace osteomill
