#include "studies/render/normals.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace osteomill::study {
namespace {

TEST(Normals, OfTheDefaultAreWithinADegreeOnPlanesOfAnyDirection) {
    for (const unsigned seed : {1u, 77u}) {
        int defaults = 0;
        for (const NormalError& error : normal_errors(seed)) {
            EXPECT_LE(error.median_deg, error.p95_deg);
            if (!error.is_default) continue;
            ++defaults;
            EXPECT_LT(error.p95_deg, 1.0) << error.surface;
        }
        EXPECT_EQ(defaults, 1);
    }
}

TEST(Normals, OfSurfaceVoxelsAreTenTimesNearerThanByNeighboursOutside) {
    const std::vector<NormalError> errors = normal_errors(1);
    const auto published = std::find_if(errors.begin(), errors.end(),
                                        [](const NormalError& error) { return error.surface == "ball"; });
    ASSERT_NE(published, errors.end());
    EXPECT_LT(10.0 * std::next(published)->p95_deg, published->p95_deg);
}

TEST(Normals, AnglesAndQuantiles) {
    EXPECT_NEAR(angle_deg({1, 0, 0}, {0, 3, 0}), 90.0, 1e-12);
    EXPECT_NEAR(angle_deg({2, 2, 0}, {5, 0, 0}), 45.0, 1e-6);
    EXPECT_EQ(quantile_of({3, 1, 2, 5, 4}, 0.5), 3.0);
    EXPECT_EQ(quantile_of({7}, 0.95), 7.0);
}

}  // namespace
}  // namespace osteomill::study
