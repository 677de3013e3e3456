#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "render_client/volume/camera.h"

namespace osteomill::magnification_test {
namespace {

const glm::ivec2 size_px(800, 600);

TEST(Magnification, ShowsThingsByItsFactorLargerFromTheSamePlace) {
    const Camera plain = camera_on({0.0, 0.0, 0.0}, 10.0);
    EXPECT_NEAR(magnification(plain), 1.0, 1e-9);
    for (const double step : magnification_steps) {
        Camera camera = plain;
        set_magnification(camera, step);
        EXPECT_NEAR(magnification(camera), step, 1e-9);
        EXPECT_NEAR(mm_per_px_at(plain, {}, size_px) / mm_per_px_at(camera, {}, size_px), step, 1e-9);
        EXPECT_NEAR(glm::distance(camera.eye_mm(), plain.eye_mm()), 0.0, 1e-9);
    }
}

TEST(Magnification, GoesUpAndDownTheSteps) {
    Camera camera;
    for (const double expected : {1.6, 2.5, 2.5}) {
        magnify_by_step(camera, true);
        EXPECT_NEAR(magnification(camera), expected, 1e-9);
    }
    for (const double expected : {1.6, 1.0, 0.6, 0.4, 0.4}) {
        magnify_by_step(camera, false);
        EXPECT_NEAR(magnification(camera), expected, 1e-9);
    }
    set_magnification(camera, 1.2);
    magnify_by_step(camera, true);
    EXPECT_NEAR(magnification(camera), 1.6, 1e-9);
}

}  // namespace
}  // namespace osteomill::magnification_test
