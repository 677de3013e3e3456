#include <gtest/gtest.h>

#include "common/scene/burr.h"

namespace osteomill {
namespace {

TEST(BurrFrame, IsRightHandedAndOrthonormalForAnySpindle) {
    for (const glm::dvec3 raw : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 2, -3),
                                 glm::dvec3(0, 1, 1), glm::dvec3(-1, 0, 1e-9), glm::dvec3(1, 0, 0)}) {
        const glm::dvec3 axis = glm::normalize(raw);
        const glm::dmat3 frame = burr_frame(axis);
        const glm::dmat3 product = glm::transpose(frame) * frame;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1.0 : 0.0, 1e-12);
        EXPECT_NEAR(glm::determinant(frame), 1.0, 1e-12);
        EXPECT_NEAR(glm::distance(frame[2], axis), 0.0, 1e-15);
    }
}

TEST(BurrFrame, OfAnUprightSpindleIsThePatientFrame) {
    EXPECT_EQ(burr_frame({0.0, 0.0, 1.0}), glm::dmat3(1.0));
}

}  // namespace
}  // namespace osteomill
