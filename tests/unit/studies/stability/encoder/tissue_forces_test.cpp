#include "studies/stability/encoder/tissue_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "studies/stability/encoder/encoder_noise.h"

namespace osteomill::study::tissue_forces_test {
namespace {

TEST(TissueForces, AreTwentiethsOfANewtonWhereSmallAndTenthsOfThemselvesAbove) {
    EXPECT_NEAR(noticeable_differences(0.0, 0.2), 4.0, 1e-12);
    EXPECT_NEAR(noticeable_differences(0.5, 1.0), 10.0 * std::log(2.0), 1e-12);
    EXPECT_NEAR(noticeable_differences(0.26, 1.0), (0.5 - 0.26) / 0.05 + 10.0 * std::log(2.0), 1e-12);
    EXPECT_NEAR(noticeable_differences(1.0, 0.0), -noticeable_differences(0.0, 1.0), 1e-12);
}

TEST(TissueForces, OfAToothOfOneTissueAreThatTissues) {
    const auto of = [](const char* tissue) {
        return drill_tooth(ArmModel{}, "implicit", std::nullopt, tissue).mean_force_n;
    };
    const double soft_n = of("pulp");
    EXPECT_GT(soft_n, 0.01);
    EXPECT_GT(of("enamel"), 3.0 * soft_n);
    EXPECT_THROW(of("ivory"), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study::tissue_forces_test
