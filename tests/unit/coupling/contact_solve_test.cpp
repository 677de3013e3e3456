#include "simulation/coupling/contact_solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

namespace osteomill::contact_solve_test {
namespace {

/// Contacts of burrs in bone as they come: directions at random, gaps of either sign, resistances over
/// decades. `sideways`: how much stronger than along its normal a contact pulls across it.
std::vector<Contact> random_contacts(std::mt19937& random, std::size_t count, double sideways) {
    std::normal_distribution<double> any;
    const auto direction = [&] { return glm::normalize(glm::dvec3(any(random), any(random), any(random))); };
    std::vector<Contact> contacts;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 normal = direction();
        const double resistance_n_per_mm = std::exp(2.0 * any(random));
        contacts.push_back(
            {.normal = normal,
             .force_n_per_mm = resistance_n_per_mm * (-normal + sideways * glm::cross(normal, direction())),
             .begins_mm = 0.02 * std::abs(any(random))});
    }
    return contacts;
}

/// All round a burr in its own tunnel, about z: edges that pull sideways `ratio` times as hard as they push
/// back.
std::vector<Contact> ring(double resistance_n_per_mm, double ratio) {
    std::vector<Contact> contacts;
    for (int i = 0; i < 24; ++i) {
        const double psi = 2.0 * std::numbers::pi * i / 24;
        const glm::dvec3 normal(std::cos(psi), std::sin(psi), 0.0);
        const glm::dvec3 along(-std::sin(psi), std::cos(psi), 0.0);
        contacts.push_back({normal, resistance_n_per_mm * (-normal - ratio * along), 0.0});
    }
    return contacts;
}

double residual_of(const LinearPull& pull, const std::vector<Contact>& contacts, const glm::dvec3& step_mm) {
    glm::dvec3 left_n = pull.force_n(step_mm);
    for (const Contact& contact : contacts)
        left_n +=
            contact.force_n_per_mm * std::max(0.0, glm::dot(contact.normal, step_mm) - contact.begins_mm);
    return glm::length(left_n);
}

TEST(ContactSolve, HoldsLikeDryFrictionUntilTheContactYields) {
    // 1.5 N/mm pull against an edge that gives 0.6 N within a thousandth of a millimetre, and chips beyond.
    const std::vector<Contact> edge{{.normal = {1.0, 0.0, 0.0},
                                     .force_n_per_mm = {-10.0, 0.0, 0.0},
                                     .begins_mm = 0.0,
                                     .yield_n = {-0.6, 0.0, 0.0},
                                     .yields_mm = 0.001}};
    for (const bool relaxes : {false, true}) {
        const auto solve = [&](const LinearPull& pull, const std::vector<Contact>& contacts) {
            return relaxes ? relaxed_step(pull, contacts) : balance(pull, contacts);
        };
        const ContactStep held = solve({{0.5, 0.0, 0.0}, 1.5}, edge);
        EXPECT_LT(held.residual_n, balance_tolerance_n);
        EXPECT_NEAR(held.bone_force_n.x, -0.5, 0.01);
        EXPECT_LT(held.step_mm.x, 0.001);
        const ContactStep cuts = solve({{0.9, 0.0, 0.0}, 1.5}, edge);
        EXPECT_LT(cuts.residual_n, balance_tolerance_n);
        EXPECT_NEAR(cuts.step_mm.x, 0.3 / 11.5, 0.001);
        EXPECT_EQ(solve({{-0.9, 0.0, 0.0}, 1.5}, edge).bone_force_n, glm::dvec3(0.0)) << "on leaving";
    }
}

TEST(ContactSolve, RelaxedHasABalanceWithEdgesOfAnyGeometry) {
    std::mt19937 random(11);
    for (int i = 0; i < 300; ++i) {
        std::vector<Contact> contacts = random_contacts(random, 40, 3.0);
        for (Contact& contact : contacts) {
            contact.yield_n = 0.05 * contact.force_n_per_mm;
            contact.yields_mm = 0.001;
        }
        const ContactStep step = relaxed_step({{1.0, -0.5, 0.3}, 1.5}, contacts);
        EXPECT_LT(step.residual_n, balance_tolerance_n) << i;
        EXPECT_LE(glm::dot(step.bone_force_n, step.step_mm), 1e-9) << "bone took energy out";
    }
}

TEST(ContactSolve, IsTheFreeStepWhereNothingIsInTheWay) {
    const LinearPull pull{{3.0, 0.0, -1.5}, 1.5};
    for (const ContactStep& step : {balance(pull, {}), relaxed_step(pull, {})}) {
        EXPECT_LT(glm::distance(step.step_mm, {2.0, 0.0, -1.0}), 1e-12);
        EXPECT_EQ(step.bone_force_n, glm::dvec3(0.0));
    }
}

TEST(ContactSolve, BalancesOneContactInClosedForm) {
    // k d_x = a - b (d_x - g), k d_y = -t (d_x - g)
    const LinearPull pull{{2.0, 0.0, 0.0}, 1.5};
    const std::vector<Contact> contacts{{{1.0, 0.0, 0.0}, {-30.0, -170.0, 0.0}, 0.01}};
    const ContactStep step = balance(pull, contacts);
    const double x_mm = (2.0 + 30.0 * 0.01) / (1.5 + 30.0);
    EXPECT_NEAR(step.step_mm.x, x_mm, 1e-9);
    EXPECT_NEAR(step.step_mm.y, -170.0 * (x_mm - 0.01) / 1.5, 1e-6);
    EXPECT_LT(step.residual_n, balance_tolerance_n);
}

TEST(ContactSolve, BalancesBoneThatPushesAlongItsNormalsAlways) {
    std::mt19937 random(19);
    std::normal_distribution<double> any;
    for (int i = 0; i < 2000; ++i) {
        const auto contacts = random_contacts(random, 1 + static_cast<std::size_t>(i % 200), 0.0);
        const LinearPull pull{{any(random), any(random), any(random)}, 1.5};
        const ContactStep relaxed = relaxed_step(pull, contacts);
        ASSERT_LT(residual_of(pull, contacts, relaxed.step_mm), balance_tolerance_n) << i;
        ASSERT_GT(glm::length(relaxed.step_mm), 0.0);
        const ContactStep step = balance(pull, contacts);
        if (step.residual_n < balance_tolerance_n) {
            ASSERT_LT(glm::distance(step.step_mm, relaxed.step_mm), 1e-3) << "there is but one";
        }
    }
}

TEST(ContactSolve, SaysTruthfullyWhatIsLeftOver) {
    std::mt19937 random(5);
    std::normal_distribution<double> any;
    int balanced = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto contacts = random_contacts(random, 1 + static_cast<std::size_t>(i % 100), 5.0);
        const LinearPull pull{{any(random), any(random), any(random)}, 1.5};
        const ContactStep step = balance(pull, contacts);
        const double residual_n = residual_of(pull, contacts, step.step_mm);
        ASSERT_NEAR(step.residual_n, residual_n, 1e-6 * (1.0 + residual_n));
        ASSERT_LE(step.iterations, 24);
        balanced += step.residual_n < balance_tolerance_n ? 1 : 0;
    }
    EXPECT_GT(balanced, 500) << "this is no test of refusals alone";
}

TEST(ContactSolve, BalancesARingThatPullsSidewaysOnceItsBurrIsHeldEnough) {
    // K_t = 6 K_r. On the hand's spring alone some pulls are without a balance; with a mass or a damper that
    // exceeds half of the ring's largest eigenvalue (the sum of |f| |n| bounds it) all have one, and it is
    // found.
    const std::vector<Contact> contacts = ring(20.0, 6.0);
    double bound_n_per_mm = 0.0;
    for (const Contact& contact : contacts) bound_n_per_mm += 0.5 * glm::length(contact.force_n_per_mm);
    for (int i = 0; i < 360; ++i) {
        const double psi = std::numbers::pi * i / 180.0;
        const glm::dvec3 offset_n = 1.5 * glm::dvec3(std::cos(psi), std::sin(psi), 0.0);
        EXPECT_LT(balance({offset_n, bound_n_per_mm}, contacts).residual_n, balance_tolerance_n) << i;
    }
}

TEST(ContactSolve, SaysHowStronglyAContactDrivesTheBurr) {
    // With n and f at right angles, n f^T + f n^T over two has the eigenvalues f/2, 0, -f/2. With a push back
    // by b along n they are half of -b -+ sqrt(b^2 + f^2).
    const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 2.0, -1.0));
    const glm::dvec3 across = glm::normalize(glm::cross(along, {0.3, 0.1, 1.0}));
    const glm::dvec3 axis = glm::cross(along, across);
    const LinearPull pull{1.5 * along, 1.5};
    for (const double sideways : {0.0, 0.5, 1.5}) {
        const std::vector<Contact> one{{along, 0.4 * -along + sideways * across, 0.0}};
        const glm::dmat3 drive = driving_part(balance(pull, one).resistance_n_per_mm);
        const double expected = 0.5 * (std::hypot(0.4, sideways) - 0.4);
        EXPECT_NEAR(drive[0][0] + drive[1][1] + drive[2][2], expected, 1e-12);
        EXPECT_NEAR(glm::dot(axis, drive * axis), 0.0, 1e-12) << "only in the plane of both";
    }
    EXPECT_EQ(driving_part(balance(pull, {}).resistance_n_per_mm), glm::dmat3(0.0)) << "air";
}

TEST(ContactSolve, HasABalanceOnceTheBurrIsDampedByMoreThanDrivesIt) {
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
        const std::vector<Contact> contacts = random_contacts(random, 40, 3.0);
        // The largest possible drive: every contact at once.
        double drive_n_per_mm = 0.0;
        for (const Contact& c : contacts)
            drive_n_per_mm += 0.5 * (glm::length(c.force_n_per_mm) + glm::dot(c.normal, c.force_n_per_mm));
        const LinearPull pull{{3.0, -1.0, 2.0}, 1.5 + 2.0 * drive_n_per_mm};
        ASSERT_LE(balance(pull, contacts).residual_n, balance_tolerance_n) << i;
    }
}

TEST(ContactSolve, TakesEnergyOutWhereItKeepsTheNormalForcesAlone) {
    std::mt19937 random(7);
    std::normal_distribution<double> any;
    for (int i = 0; i < 2000; ++i) {
        const auto contacts = random_contacts(random, 1 + static_cast<std::size_t>(i % 300), 8.0);
        const LinearPull pull{3.0 * glm::dvec3(any(random), any(random), any(random)), 1.5};
        const ContactStep step = relaxed_step(pull, contacts);
        ASSERT_LE(glm::dot(step.bone_force_n, step.step_mm), 1e-12) << i;
        ASSERT_LT(step.residual_n, balance_tolerance_n) << i;
        ASSERT_LE(glm::length(step.step_mm), glm::length(pull.free_step_mm()) + 1e-9)
            << "bone only holds back";
    }
}

TEST(ContactSolve, IsNotDrivenByAContactThatPullsInward) {
    // A force along its own normal, out of any law: relaxed, it counts as none.
    const LinearPull pull{{1.0, 0.0, 0.0}, 1.5};
    const std::vector<Contact> contacts{{{1.0, 0.0, 0.0}, {50.0, 0.0, 0.0}, 0.0}};
    EXPECT_NEAR(relaxed_step(pull, contacts).step_mm.x, 1.0 / 1.5, 1e-9);
}

}  // namespace
}  // namespace osteomill::contact_solve_test
