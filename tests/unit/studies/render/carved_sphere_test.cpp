#include "studies/render/carved_sphere.h"

#include <gtest/gtest.h>

#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::study {
namespace {

class CarvedSphere : public OffscreenTest, public testing::WithParamInterface<double> {};

TEST_P(CarvedSphere, IsDrawnWithin42DecibelsOfTheAnalyticOne) {
    EXPECT_GE(carved_sphere_psnr_db(GetParam()), 42.0);
}

INSTANTIATE_TEST_SUITE_P(PixelsAVoxel, CarvedSphere, testing::Values(4.0, 10.0, 20.0));

TEST(CarvedSphereNormals, AreWithinADegreeAtThe95thPercentile) {
    EXPECT_LT(carved_sphere_normals_p95_deg(), 1.0);
}

}  // namespace
}  // namespace osteomill::study
