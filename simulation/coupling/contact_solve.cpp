#include "simulation/coupling/contact_solve.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

constexpr int most_iterations = 24;
constexpr double smallest_share = 0.02;
/// Residual at which the iteration ends: far below balance_tolerance_n.
constexpr double residual_goal_n = 1e-7;

struct State {
    glm::dvec3 step_mm{0.0};
    glm::dvec3 bone_force_n{0.0};
    glm::dvec3 residual_n{0.0};
    glm::dmat3 resistance{0.0};  // minus the residual's derivative, N/mm
};

State state_at(const LinearPull& pull, std::span<const Contact> contacts, const glm::dvec3& step_mm) {
    State state{.step_mm = step_mm, .resistance = pull.resistance_n_per_mm()};
    for (const Contact& contact : contacts) {
        const double beyond_mm = glm::dot(contact.normal, step_mm) - contact.begins_mm;
        if (beyond_mm <= 0.0) continue;
        if (beyond_mm < contact.yields_mm) {
            const glm::dvec3 elastic_n_per_mm = contact.yield_n / contact.yields_mm;
            state.bone_force_n += elastic_n_per_mm * beyond_mm;
            state.resistance -= glm::outerProduct(elastic_n_per_mm, contact.normal);
            continue;
        }
        state.bone_force_n += contact.yield_n + contact.force_n_per_mm * (beyond_mm - contact.yields_mm);
        state.resistance -= glm::outerProduct(contact.force_n_per_mm, contact.normal);
    }
    state.residual_n = pull.force_n(step_mm) + state.bone_force_n;
    return state;
}

/// How much of a contact's force resists along its normal.
double normal_part(const glm::dvec3& force, const Contact& contact) {
    return std::max(0.0, -glm::dot(force, contact.normal));
}

/// The relaxed problem's function with its derivatives.
struct RelaxedState {
    glm::dvec3 step_mm{0.0};
    glm::dvec3 bone_force_n{0.0};
    glm::dvec3 residual_n{0.0};
    glm::dmat3 resistance{0.0};
    double energy_mj = 0.0;  // minus the residual is its gradient
};

RelaxedState relaxed_at(const LinearPull& pull, std::span<const Contact> contacts,
                        const glm::dvec3& step_mm) {
    RelaxedState state{.step_mm = step_mm, .resistance = pull.resistance_n_per_mm()};
    state.energy_mj = 0.5 * glm::dot(step_mm, state.resistance * step_mm) - glm::dot(pull.offset_n, step_mm);
    for (const Contact& contact : contacts) {
        const double beyond_mm = glm::dot(contact.normal, step_mm) - contact.begins_mm;
        if (beyond_mm <= 0.0) continue;
        const double yield_n = normal_part(contact.yield_n, contact);
        const bool yields = beyond_mm >= contact.yields_mm;
        const double resistance =
            yields ? normal_part(contact.force_n_per_mm, contact) : yield_n / contact.yields_mm;
        const double within_mm = yields ? beyond_mm - contact.yields_mm : beyond_mm;
        const double before_n = yields ? yield_n : 0.0;
        state.bone_force_n -= (before_n + resistance * within_mm) * contact.normal;
        state.resistance += resistance * glm::outerProduct(contact.normal, contact.normal);
        state.energy_mj +=
            0.5 * resistance * within_mm * within_mm + before_n * (within_mm + 0.5 * contact.yields_mm);
    }
    state.residual_n = pull.force_n(step_mm) + state.bone_force_n;
    return state;
}

}  // namespace

glm::dmat3 driving_part(const glm::dmat3& resistance_n_per_mm) noexcept {
    Eigen::Matrix3d symmetric;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            symmetric(i, j) = 0.5 * (resistance_n_per_mm[i][j] + resistance_n_per_mm[j][i]);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(symmetric);
    glm::dmat3 driving(0.0);
    for (int i = 0; i < 3; ++i) {
        const auto axis = axes.eigenvectors().col(i);
        const glm::dvec3 v(axis[0], axis[1], axis[2]);
        driving += std::max(0.0, -axes.eigenvalues()[i]) * glm::outerProduct(v, v);
    }
    return driving;
}

ContactStep balance(const LinearPull& pull, std::span<const Contact> contacts,
                    const glm::dvec3& first_mm) noexcept {
    State state = state_at(pull, contacts, first_mm);
    int iterations = 1;
    for (; iterations < most_iterations; ++iterations) {
        if (glm::length(state.residual_n) < residual_goal_n) break;
        const glm::dvec3 newton = glm::inverse(state.resistance) * state.residual_n;
        bool has_descended = false;
        for (double share = 1.0; share > smallest_share && !has_descended; share *= 0.5) {
            const State trial = state_at(pull, contacts, state.step_mm + share * newton);
            if (glm::length(trial.residual_n) < glm::length(state.residual_n)) {
                state = trial;
                has_descended = true;
            }
        }
        if (!has_descended) break;
    }
    return {.step_mm = state.step_mm,
            .bone_force_n = state.bone_force_n,
            .residual_n = glm::length(state.residual_n),
            .iterations = iterations,
            .resistance_n_per_mm = state.resistance - pull.resistance_n_per_mm()};
}

ContactStep relaxed_step(const LinearPull& pull, std::span<const Contact> contacts) noexcept {
    RelaxedState state = relaxed_at(pull, contacts, pull.free_step_mm());
    int iterations = 1;
    for (; iterations < most_iterations; ++iterations) {
        if (glm::length(state.residual_n) < residual_goal_n) break;
        const glm::dvec3 newton = glm::inverse(state.resistance) * state.residual_n;
        // Along a Newton step of a convex function some share always reduces it by a part of the first-order
        // gain.
        const double gain_mj = glm::dot(newton, state.residual_n);
        double share = 1.0;
        RelaxedState trial = relaxed_at(pull, contacts, state.step_mm + newton);
        while (trial.energy_mj > state.energy_mj - 1e-4 * share * gain_mj && share > 1e-6) {
            share *= 0.5;
            trial = relaxed_at(pull, contacts, state.step_mm + share * newton);
        }
        if (share <= 1e-6) break;  // as flat as numbers can tell
        state = trial;
    }
    const double residual_n = glm::length(state.residual_n);
    if (residual_n <= balance_tolerance_n)
        return {.step_mm = state.step_mm,
                .bone_force_n = state.bone_force_n,
                .residual_n = residual_n,
                .iterations = iterations};
    return {.iterations = iterations};
}

}  // namespace osteomill
