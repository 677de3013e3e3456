#include "haptic_server/coupling/burr_proxy.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace osteomill {

namespace {

constexpr int most_iterations = 24;
constexpr double residual_tolerance_n = 1e-7;

/// Share of a patch that touches the bone.
double touching_share(double gap_voxels) {
    constexpr double width = BurrProxy::surely_apart_voxels - BurrProxy::surely_touching_voxels;
    return std::clamp((BurrProxy::surely_apart_voxels - gap_voxels) / width, 0.0, 1.0);
}

}  // namespace

void BurrProxy::place(const glm::dvec3& position_mm) noexcept {
    position_mm_ = target_mm_ = position_mm;
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

void BurrProxy::gather_contacts(const glm::dvec3& pull_mm, double tick_s, bool spindle_on,
                                const Engagement& engagement) noexcept {
    contact_count_ = 0;
    const glm::dvec3 moved = position_mm_ - engagement.burr_position_mm;
    // The force may turn the step sideways, but never make it longer than the pull (K_r, K_a >= 0 and the
    // wall only resist).
    const double longest_mm = glm::length(pull_mm) + 2.0 * engagement.spacing_mm;
    const auto add = [&](const glm::dvec3& normal, const glm::dvec3& force_n_per_mm, double begins_mm) {
        if (begins_mm <= longest_mm) contacts_[contact_count_++] = {normal, force_n_per_mm, begins_mm};
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
        const glm::dvec3 force = correction_.gain() * patch.cutting_n_s_per_mm / tick_s;
        if (share > 0.0) add(patch.normal, share * force, begins);
        if (share < 1.0) add(patch.normal, (1.0 - share) * force, begins_beyond_gap);
    }
}

glm::dvec3 BurrProxy::solve(const glm::dvec3& pull_mm) noexcept {
    // Residual force on the proxy after a step d, and minus its derivative.
    const auto residual = [&](const glm::dvec3& d, glm::dmat3& resistance) {
        glm::dvec3 force = spring_n_per_mm_ * (pull_mm - d);
        resistance = glm::dmat3(spring_n_per_mm_);
        for (std::size_t i = 0; i < contact_count_; ++i) {
            const Contact& contact = contacts_[i];
            const double beyond = glm::dot(contact.normal, d) - contact.begins_mm;
            if (beyond <= 0.0) continue;
            force += contact.force_n_per_mm * beyond;
            resistance -= glm::outerProduct(contact.force_n_per_mm, contact.normal);
        }
        return force;
    };

    glm::dmat3 resistance;
    glm::dvec3 d = pull_mm;
    glm::dvec3 force = residual(d, resistance);
    for (iterations_ = 1; iterations_ < most_iterations; ++iterations_) {
        if (glm::length(force) < residual_tolerance_n) break;
        const glm::dvec3 newton = glm::inverse(resistance) * force;
        glm::dvec3 best_d = d;
        glm::dvec3 best_force = force;
        glm::dmat3 best_resistance = resistance;
        for (double share = 1.0; share > 0.02; share *= 0.5) {
            glm::dmat3 trial_resistance;
            const glm::dvec3 trial = d + share * newton;
            const glm::dvec3 trial_force = residual(trial, trial_resistance);
            if (glm::length(trial_force) < glm::length(best_force)) {
                best_d = trial;
                best_force = trial_force;
                best_resistance = trial_resistance;
                break;
            }
        }
        if (best_d == d) break;  // no descent: keep the best so far, the spring takes up what is left
        d = best_d;
        force = best_force;
        resistance = best_resistance;
    }
    return d;
}

glm::dvec3 BurrProxy::held_back(const glm::dvec3& step_mm, const glm::dvec3& target_mm,
                                double tick_s) const noexcept {
    const double longest_mm = glm::distance(target_mm, target_mm_) + most_slip_mm_per_s * tick_s;
    const double length_mm = glm::length(step_mm);
    return length_mm > longest_mm ? step_mm * (longest_mm / length_mm) : step_mm;
}

void BurrProxy::advance(const glm::dvec3& target_mm, double tick_s, bool spindle_on,
                        const MillingResult& latest) noexcept {
    take_over(latest);
    const Engagement& engagement = latest.engagement;
    const glm::dvec3 pull = target_mm - position_mm_;
    gather_contacts(pull, tick_s, spindle_on, engagement);
    iterations_ = 0;
    const glm::dvec3 wanted = contact_count_ == 0 ? pull : solve(pull);
    const glm::dvec3 step = spindle_on ? held_back(wanted, target_mm, tick_s) : wanted;
    position_mm_ = step == pull ? target_mm : position_mm_ + step;
    target_mm_ = target_mm;

    if (!spindle_on) {
        correction_.reset();
        return;
    }
    correction_.add_prediction(spring_n_per_mm_ * (position_mm_ - target_mm), tick_s);
    const glm::dvec3 moved = position_mm_ - engagement.burr_position_mm;
    for (std::size_t i = 0; i < engagement.count; ++i)
        cut_mm_[i] = std::max(cut_mm_[i], glm::dot(engagement.patches[i].normal, moved));
}

}  // namespace osteomill
