#include "render_client/ui/panels/orientation_cube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

namespace osteomill::orientation_cube_test {
namespace {

std::string letters(const Camera& camera) {
    std::string seen;
    for (const CubeFace& face : visible_faces(camera)) seen += face.letter;
    std::sort(seen.begin(), seen.end());
    return seen;
}

TEST(OrientationCube, NamesThePatientsSides) {
    // In front of the patient, above, and to the viewer's right, which is the patient's left.
    EXPECT_EQ(letters(Camera{.azimuth_rad = 0.4, .elevation_rad = 0.5}), "ALS");
    EXPECT_EQ(letters(Camera{.azimuth_rad = 3.0, .elevation_rad = -0.5}), "ILP");
    EXPECT_EQ(letters(Camera{.azimuth_rad = -1.2, .elevation_rad = 0.3}), "ARS");
}

TEST(OrientationCube, PutsLeftOnTheViewersRightSeenFromTheFront) {
    const auto faces = visible_faces(Camera{.azimuth_rad = 0.4, .elevation_rad = 0.5});
    const auto middle_of = [&](char letter) {
        return std::find_if(faces.begin(), faces.end(), [&](auto& face) { return face.letter == letter; })
            ->middle;
    };
    EXPECT_GT(middle_of('L').x, middle_of('A').x);
    EXPECT_LT(middle_of('S').y, middle_of('A').y) << "y goes down";
}

TEST(OrientationCube, FitsItsSquareHoweverItIsTurned) {
    for (double azimuth_rad = -3.0; azimuth_rad < 3.0; azimuth_rad += 0.37)
        for (double elevation_rad = -1.5; elevation_rad < 1.5; elevation_rad += 0.3)
            for (const CubeFace& face :
                 visible_faces(Camera{.azimuth_rad = azimuth_rad, .elevation_rad = elevation_rad}))
                for (const glm::dvec2& corner : face.corners) {
                    EXPECT_GE(std::min(corner.x, corner.y), -1e-9);
                    EXPECT_LE(std::max(corner.x, corner.y), 1.0 + 1e-9);
                }
}

TEST(OrientationCube, TurnsTheViewToTheFaceThatIsClicked) {
    for (const char letter : {'A', 'L', 'S'}) {
        Camera camera{.azimuth_rad = 0.6, .elevation_rad = 0.6};
        const auto faces = visible_faces(camera);
        const auto wanted =
            std::find_if(faces.begin(), faces.end(), [&](auto& face) { return face.letter == letter; });
        const auto clicked = face_at(camera, wanted->middle);
        ASSERT_TRUE(clicked);
        EXPECT_EQ(clicked->letter, letter);
        look_at_side(camera, clicked->outward);
        // Straight up and down is a degree short of it: the camera stays upright.
        EXPECT_GT(-glm::dot(camera.forward(), clicked->outward), std::cos(0.018));
    }
    EXPECT_FALSE(face_at(Camera{}, {0.02, 0.02})) << "beside the cube";
}

}  // namespace
}  // namespace osteomill::orientation_cube_test
