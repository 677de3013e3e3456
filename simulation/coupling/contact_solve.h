// The balance of a burr between a linear pull and one-sided contacts with bone: the step d with zero residual
// force.
//
//     offset - stiffness d + sum of force_i max(0, b_i - yields_i) + yield_i min(1, b_i / yields_i) = 0
//     where b_i = n_i . d - begins_i > 0
//
// A contact yields: over yields_i its force rises from zero to yield_i, and then stays. That is dry friction
// made elastic, as of a rubbing edge. Without yield_i and yields_i a contact only resists an advance.
//
// The pull is a spring and dampers to the hand, equal in every direction except where bone drives the burr. A
// contact's force need not point along its normal: a cutting edge pulls sideways. Then the balance is not a
// minimum, and a burr on a soft spring may have none at all (the symmetric part of the sideways force has
// negative eigenvalues). balance() looks for one and reports the residual force. relaxed_step() cannot fail.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace osteomill {

/// One patch of bone that the burr may meet.
struct Contact {
    glm::dvec3 normal{0.0};          ///< outward from the burr, unit, patient axes
    glm::dvec3 force_n_per_mm{0.0};  ///< of the bone on the burr for each mm beyond `begins_mm` + `yields_mm`
    double begins_mm = 0.0;          ///< advance along the normal at which contact begins
    glm::dvec3 yield_n{0.0};         ///< of the bone on the burr, from `yields_mm` beyond that on
    double yields_mm = 0.0;
};

/// The pull on the burr in air: `offset_n` less `stiffness_n_per_mm` (above 0) times its step.
struct LinearPull {
    glm::dvec3 offset_n{0.0};
    double stiffness_n_per_mm = 1.0;
    /// Symmetric, no eigenvalue below 0: hidden damping and fixtures also resist the step, in some directions
    /// more than in others.
    glm::dmat3 damping_n_per_mm{0.0};
    bool has_fixtures = false;
    glm::dvec3 of_fixtures_n{0.0};  ///< in `offset_n`, and not of the tie to the hand

    glm::dmat3 resistance_n_per_mm() const { return glm::dmat3(stiffness_n_per_mm) + damping_n_per_mm; }
    glm::dvec3 free_step_mm() const { return glm::inverse(resistance_n_per_mm()) * offset_n; }
    glm::dvec3 force_n(const glm::dvec3& step_mm) const {
        return offset_n - stiffness_n_per_mm * step_mm - damping_n_per_mm * step_mm;
    }
    /// Without hidden damping and fixtures: what the hand feels the opposite of.
    glm::dvec3 tie_n(const glm::dvec3& step_mm) const {
        return offset_n - of_fixtures_n - stiffness_n_per_mm * step_mm;
    }
};

struct ContactStep {
    glm::dvec3 step_mm{0.0};
    glm::dvec3 bone_force_n{0.0};  ///< on the burr, at the step's end
    double residual_n = 0.0;       ///< force that is left over
    int iterations = 0;
    /// Minus the derivative of the force of the contacts that touch.
    glm::dmat3 resistance_n_per_mm{0.0};
};

/// Directions in which bone drives the burr, and how strongly: the symmetric part of its resistance without
/// the eigenvectors that resist, with a positive sign. Added to the resistance, it leaves no direction that
/// is driven. Real-time safe.
glm::dmat3 driving_part(const glm::dmat3& resistance_n_per_mm) noexcept;

/// A residual below this is a balance: a hundredth of the force that a hand can tell.
inline constexpr double balance_tolerance_n = 1e-3;

/// Newton's method on the set of contacts that touch, from `first_mm`, halving a step that does not reduce
/// the residual; at most 24 iterations. If it ends without a balance, the residual says so. Real-time safe.
ContactStep balance(const LinearPull& pull, std::span<const Contact> contacts,
                    const glm::dvec3& first_mm) noexcept;
/// From the free step.
inline ContactStep balance(const LinearPull& pull, std::span<const Contact> contacts) noexcept {
    return balance(pull, contacts, pull.free_step_mm());
}

/// The balance if each contact only resists, along its normal alone. It is the minimum of a strictly convex,
/// piecewise quadratic function. Newton's method reaches it in a finite number of steps, with a line search
/// that must reduce the function. Bone that only resists takes energy out of the burr: force . step <= 0, if
/// no contact is entered at the start. If 24 iterations are not enough, the burr stays (step 0). `residual_n`
/// is of the relaxed contacts. Real-time safe.
ContactStep relaxed_step(const LinearPull& pull, std::span<const Contact> contacts) noexcept;

}  // namespace osteomill
