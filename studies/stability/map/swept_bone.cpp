#include "studies/stability/map/swept_bone.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace osteomill::study {
namespace {

constexpr std::size_t ring_count = 40;
constexpr std::size_t angle_count = 24;

/// Path points are this far apart near the burr: a union of spheres instead of a sweep leaves scallops of
/// d^2 / 8R, a hundredth of a micrometre. Farther back one in four is kept.
constexpr double path_spacing_mm = 0.01;
constexpr std::size_t fine_points = 12;
constexpr std::size_t coarse_stride = 4;
/// Each refresh checks the spheres of the past within this distance, which suffice while the burr goes on. It
/// checks the others, which the burr meets again if it returns or goes deeper, once in five refreshes.
constexpr double near_reach_mm = 1.2;
constexpr int refreshes_per_far_look = 5;
/// The length of the slot that the burr begins in.
constexpr double slot_mm = 3.0;
/// Gaps are not followed beyond this: to close it between two updates of far patches takes 20 mm/s.
constexpr float most_gap_mm = 0.1f;

/// Edges of a patch that cuts faster rub with all their force.
constexpr double rubs_from_mm_per_s = 0.01;

constexpr int most_iterations = 30;
constexpr int plain_iterations = 12;

}  // namespace

SweptBone::SweptBone(const Burr& burr, double relative_stiffness, const glm::dvec3& start_mm)
    : burr_(burr), burr_mm_(start_mm) {
    make_patches(relative_stiffness);
    for (double behind_mm = slot_mm; behind_mm > 0.5 * path_spacing_mm; behind_mm -= path_spacing_mm)
        path_mm_.push_back(start_mm - glm::dvec3(behind_mm, 0.0, 0.0));
    path_mm_.push_back(start_mm);
    last_velocity_ = {1.0, 0.0, 0.0};
    refresh();
}

void SweptBone::make_patches(double stiffness) {
    const double radius = burr_.radius_mm();
    const double depth_mm = radius - burr_mm_.z;
    const double top = std::min(radius, depth_mm + headroom_mm - radius);
    ring_height_mm_ = (top + radius) / static_cast<double>(ring_count);
    patches_per_ring_ = angle_count;
    patch_area_mm2_ = 2.0 * std::numbers::pi * radius * ring_height_mm_ / static_cast<double>(angle_count);
    const glm::dvec3 k = stiffness * burr_.cutting_coefficients_n_per_mm2;
    const glm::dvec3 edge = stiffness * burr_.edge_coefficients_n_per_mm;
    for (std::size_t ring = 0; ring < ring_count; ++ring) {
        const double z = (-radius + (static_cast<double>(ring) + 0.5) * ring_height_mm_) / radius;
        const double sin_kappa = std::sqrt(1.0 - z * z);
        const double half = 0.5 * ring_height_mm_ / radius;
        const double arc_mm =
            radius * (std::asin(std::min(1.0, z + half)) - std::asin(std::max(-1.0, z - half)));
        for (std::size_t j = 0; j < angle_count; ++j) {
            const double psi =
                2.0 * std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(angle_count);
            const glm::dvec3 normal(std::cos(psi) * sin_kappa, std::sin(psi) * sin_kappa, z);
            const glm::dvec3 e_psi(-std::sin(psi), std::cos(psi), 0.0);
            const glm::dvec3 e_kappa(std::cos(psi) * -z, std::sin(psi) * -z, sin_kappa);
            normal_x_.push_back(static_cast<float>(normal.x));
            normal_y_.push_back(static_cast<float>(normal.y));
            normal_z_.push_back(static_cast<float>(normal.z));
            whole_n_s_per_mm_.push_back(
                -(burr_.sigma() * k.x * e_psi + k.y * normal + k.z * e_kappa) * patch_area_mm2_ /
                (2.0 * std::numbers::pi * radius * sin_kappa * burr_.spindle_rev_per_s));
            // The arc of the ring's part of an outline: at the tip it is far longer than its height says.
            whole_edge_n_.push_back(-(burr_.sigma() * edge.x * e_psi + edge.y * normal + edge.z * e_kappa) *
                                    (burr_.edges * arc_mm / static_cast<double>(angle_count)));
        }
    }
    gap_mm_.assign(normal_x_.size(), 0.0f);
    far_gap_mm_.assign(normal_x_.size(), 0.0f);
    share_in_bone_.assign(normal_x_.size(), 0.0);
    engaged_.assign(normal_x_.size(), 0);
    engaged_next_.assign(normal_x_.size(), 0);
}

void SweptBone::add(std::size_t patch, std::uint8_t state, double sign) {
    if (state == 0) return;
    const double share = sign * share_in_bone_[patch];
    glm::dvec3 law = share * whole_n_s_per_mm_[patch];
    if (state == 1) law += share / rubs_from_mm_per_s * whole_edge_n_[patch];
    if (state == 2) edge_force_n_ += share * whole_edge_n_[patch];
    force_per_velocity_ +=
        glm::outerProduct(law, glm::dvec3(normal_x_[patch], normal_y_[patch], normal_z_[patch]));
    force_per_gap_rate_ += static_cast<double>(gap_mm_[patch]) * law;
}

std::uint8_t SweptBone::state_at(std::size_t patch, const glm::vec3& step_mm, float slow_mm) const {
    const float advance_mm =
        normal_x_[patch] * step_mm.x + normal_y_[patch] * step_mm.y + normal_z_[patch] * step_mm.z;
    if (!(advance_mm > gap_mm_[patch])) return 0;
    return advance_mm > gap_mm_[patch] + slow_mm ? 2 : 1;
}

bool SweptBone::engage(const glm::dvec3& velocity_mm_per_s, double substep_s) {
    const glm::vec3 step(velocity_mm_per_s * substep_s);
    const float slow_mm = burr_.has_edge_force() ? static_cast<float>(rubs_from_mm_per_s * substep_s) : 0.0f;
    const std::size_t count = gap_mm_.size();
    for (std::size_t i = 0; i < count; ++i) engaged_next_[i] = state_at(i, step, slow_mm);
    if (engaged_next_ == engaged_) return false;
    for (std::size_t i = 0; i < count; ++i) {
        if (engaged_next_[i] == engaged_[i]) continue;
        add(i, engaged_[i], -1.0);
        add(i, engaged_next_[i], 1.0);
    }
    engaged_.swap(engaged_next_);
    return true;
}

glm::dvec3 SweptBone::solve(const glm::dvec3& resistance_n_s_per_mm, const glm::dvec3& drive_n,
                            double substep_s) {
    const glm::dvec3& r = resistance_n_s_per_mm;
    const glm::dmat3 of_tool(r.x, 0.0, 0.0, 0.0, r.y, 0.0, 0.0, 0.0, r.z);
    glm::dvec3 w = last_velocity_;
    if (!has_engaged_) engage(w, substep_s);
    has_engaged_ = true;
    if (burr_.has_edge_force()) return last_velocity_ = solve_with_edges(of_tool, drive_n, substep_s);
    for (int i = 0; i < most_iterations; ++i) {
        const glm::dmat3 resists = of_tool - force_per_velocity_;
        const glm::dvec3 solved =
            glm::inverse(resists) * (drive_n + edge_force_n_ - force_per_gap_rate_ / substep_s);
        // Two sets that lead to one another would be visited in turn for ever.
        w = i < plain_iterations ? solved : 0.5 * (w + solved);
        if (!engage(w, substep_s) && i < plain_iterations) break;
    }
    last_velocity_ = w;
    return w;
}

glm::dvec3 SweptBone::solve_with_edges(const glm::dmat3& of_tool, const glm::dvec3& drive_n,
                                       double substep_s) {
    glm::dvec3 w = last_velocity_;
    const auto residual_n = [&] {
        return drive_n + edge_force_n_ - force_per_gap_rate_ / substep_s +
               (force_per_velocity_ - of_tool) * w;
    };
    engage(w, substep_s);
    glm::dvec3 left_n = residual_n();
    constexpr double balanced_n = 1e-7;
    for (int i = 0; i < most_iterations && glm::length(left_n) > balanced_n; ++i) {
        const glm::dvec3 from = w;
        const glm::dvec3 newton = glm::inverse(of_tool - force_per_velocity_) * left_n;
        // A force that no longer rises with the velocity would send a whole step to and fro.
        const double had_n = glm::length(left_n);
        for (double share = 1.0; share > 1e-3; share *= 0.5) {
            w = from + share * newton;
            engage(w, substep_s);
            left_n = residual_n();
            if (glm::length(left_n) < had_n) break;
        }
    }
    return w;
}

void SweptBone::advance(const glm::dvec3& step_mm) {
    const glm::vec3 step(step_mm);
    for (std::size_t i = 0; i < gap_mm_.size(); ++i)
        gap_mm_[i] = std::max(
            0.0f, gap_mm_[i] - (normal_x_[i] * step.x + normal_y_[i] * step.y + normal_z_[i] * step.z));
    force_per_gap_rate_ = glm::dvec3(0.0);  // a cutting patch has closed its gap
    burr_mm_ += step_mm;
    if (glm::distance(burr_mm_, path_mm_.back()) < path_spacing_mm) return;
    path_mm_.push_back(burr_mm_);
}

void SweptBone::look_at_path(double beyond_mm, double within_mm, std::vector<float>& gap_mm) const {
    const auto radius = static_cast<float>(burr_.radius_mm());
    for (std::size_t k = 0; k < path_mm_.size(); ++k) {
        const std::size_t age = path_mm_.size() - 1 - k;
        if (age > fine_points && k % coarse_stride != 0) continue;
        const glm::dvec3 from_burr = path_mm_[k] - burr_mm_;
        const double distance = glm::length(from_burr);
        if (distance <= beyond_mm || distance > within_mm) continue;
        // A ray along n is in the sphere around q from n.q - root to n.q + root.
        const glm::vec3 q(from_burr);
        const float rest = radius * radius - static_cast<float>(distance * distance);
        for (std::size_t i = 0; i < gap_mm.size(); ++i) {
            const float along = normal_x_[i] * q.x + normal_y_[i] * q.y + normal_z_[i] * q.z;
            const float root = std::sqrt(std::max(0.0f, rest + along * along));
            const float gap = along + root - radius;
            gap_mm[i] = std::max(gap_mm[i], along - root < radius ? gap : 0.0f);
        }
    }
    for (float& gap : gap_mm) gap = std::min(gap, most_gap_mm);
}

void SweptBone::refresh() {
    const std::size_t count = gap_mm_.size();
    std::fill(gap_mm_.begin(), gap_mm_.end(), 0.0f);
    look_at_path(-1.0, near_reach_mm, gap_mm_);
    if (refreshes_++ % refreshes_per_far_look == 0) {
        std::fill(far_gap_mm_.begin(), far_gap_mm_.end(), 0.0f);
        look_at_path(near_reach_mm, burr_.diameter_mm, far_gap_mm_);
        looked_far_from_mm_ = burr_mm_;
    }
    const glm::vec3 moved(burr_mm_ - looked_far_from_mm_);
    for (std::size_t i = 0; i < count; ++i) {
        const float along = normal_x_[i] * moved.x + normal_y_[i] * moved.y + normal_z_[i] * moved.z;
        gap_mm_[i] = std::max(gap_mm_[i], far_gap_mm_[i] - along);
    }

    for (std::size_t i = 0; i < count; ++i) {
        const double low =
            burr_mm_.z - burr_.radius_mm() + static_cast<double>(i / patches_per_ring_) * ring_height_mm_;
        share_in_bone_[i] = std::clamp(-low / ring_height_mm_, 0.0, 1.0);
    }
    has_engaged_ = false;
    std::fill(engaged_.begin(), engaged_.end(), std::uint8_t{0});
    force_per_velocity_ = glm::dmat3(0.0);
    force_per_gap_rate_ = glm::dvec3(0.0);
    edge_force_n_ = glm::dvec3(0.0);
}

}  // namespace osteomill::study
