#include "render_client/volume/passes/surface_pass.h"

#include <cmath>
#include <glm/trigonometric.hpp>

#include "studies/render/made_bone.h"
#include "tests/support/ball_structure.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::surface_pass_test {
namespace {

using SurfacePassTest = OffscreenTest;

const glm::ivec2 size_px(320, 240);
const Grid grid{.size_voxels = {96, 96, 96}, .spacing_mm = 0.1, .origin_mm = {-4.75, -4.75, -4.75}};

/// From the eye through the middle of a pixel, 1 along the camera's axis.
glm::dvec3 ray_of(const Camera& camera, int x, int y) {
    const glm::dvec3 direction = direction_through(camera, {x + 0.5, y + 0.5}, size_px);
    return direction / glm::dot(direction, camera.forward());
}

/// Along the camera's axis to a ball about the origin; nothing if the ray passes it.
std::optional<double> depth_of_ball(const Camera& camera, const glm::dvec3& ray, double radius_mm) {
    const glm::dvec3 eye = camera.eye_mm();
    const double a = glm::dot(ray, ray), b = glm::dot(eye, ray),
                 c = glm::dot(eye, eye) - radius_mm * radius_mm;
    if (b * b < a * c) return std::nullopt;
    return (-b - std::sqrt(b * b - a * c)) / a;
}

Camera camera_from_aside() {
    Camera camera = camera_on(glm::dvec3(0.0), 4.0);
    camera.roll_rad = 0.3;
    camera.middle_slope = 0.02;
    camera.middle_rise = -0.03;
    return camera;
}

/// The errors of a picture against closed form.
struct Errors {
    int pixels = 0;
    double deepest_voxels = 0.0;   ///< along the camera's axis, where the ray is steeper than 12 degrees
    double farthest_voxels = 0.0;  ///< from the surface, at every pixel up to the outline
    double largest_rad = 0.0;      ///< between normals
};

void add(Errors& errors, const SurfaceImage& image, const Camera& camera, int x, int y, double expected_mm,
         double off_mm, const glm::dvec3& normal) {
    const auto i = static_cast<std::size_t>(y * size_px.x + x);
    const glm::dvec3 direction = glm::normalize(ray_of(camera, x, y));
    ++errors.pixels;
    errors.farthest_voxels = std::max(errors.farthest_voxels, std::abs(off_mm) / grid.spacing_mm);
    if (-glm::dot(direction, normal) > std::sin(glm::radians(12.0)))
        errors.deepest_voxels = std::max(errors.deepest_voxels,
                                         std::abs(double{image.depth_mm[i]} - expected_mm) / grid.spacing_mm);
    const glm::dmat3 to_patient(camera.right(), -camera.up(), camera.forward());
    errors.largest_rad =
        std::max(errors.largest_rad,
                 std::acos(std::min(glm::dot(to_patient * glm::dvec3(image.normal[i]), normal), 1.0)));
}

TEST_F(SurfacePassTest, MeasuresABallUpToItsOutline) {
    constexpr double radius_mm = 3.3;
    const Bone bone = made_bone(grid, [](const glm::dvec3& p) { return radius_mm - glm::length(p); });
    const BoneTextures textures(bone, {});
    const Camera camera = camera_from_aside();
    const SurfaceImage image = SurfacePass(size_px).draw(textures, nullptr, camera);
    Errors errors;
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            const auto i = static_cast<std::size_t>(y * size_px.x + x);
            const glm::dvec3 ray = ray_of(camera, x, y);
            const bool is_hit = image.thing[i] == SurfaceImage::bone;
            ASSERT_EQ(is_hit, std::isfinite(image.depth_mm[i]));
            // A tenth of a voxel beside the outline either is right.
            ASSERT_TRUE(is_hit || !depth_of_ball(camera, ray, radius_mm - 0.1 * grid.spacing_mm));
            ASSERT_TRUE(!is_hit || depth_of_ball(camera, ray, radius_mm + 0.1 * grid.spacing_mm));
            if (!is_hit) continue;
            const glm::dvec3 hit_mm = camera.eye_mm() + double{image.depth_mm[i]} * ray;
            const double expected_mm = depth_of_ball(camera, ray, radius_mm).value_or(image.depth_mm[i]);
            add(errors, image, camera, x, y, expected_mm, glm::length(hit_mm) - radius_mm,
                glm::normalize(hit_mm));
        }
    EXPECT_GT(errors.pixels, 40'000);
    EXPECT_LT(errors.deepest_voxels, 0.5);
    EXPECT_LT(errors.farthest_voxels, 0.1);
    EXPECT_LT(errors.largest_rad, glm::radians(2.0));
    RecordProperty("depth_voxels", std::to_string(errors.deepest_voxels));
    RecordProperty("off_surface_voxels", std::to_string(errors.farthest_voxels));
    RecordProperty("normal_rad", std::to_string(errors.largest_rad));
}

TEST_F(SurfacePassTest, MeasuresAPlaneAslant) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
    const Bone bone = made_bone(
        grid, [&](const glm::dvec3& p) { return std::min(-glm::dot(normal, p), 4.0 - glm::length(p)); });
    const BoneTextures textures(bone, {});
    const Camera camera = camera_from_aside();
    const SurfaceImage image = SurfacePass(size_px).draw(textures, nullptr, camera);
    Errors errors;
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x) {
            const glm::dvec3 ray = ray_of(camera, x, y);
            const double expected_mm = -glm::dot(normal, camera.eye_mm()) / glm::dot(normal, ray);
            if (glm::length(camera.eye_mm() + expected_mm * ray) > 3.5) continue;  // the plane's part
            const double measured_mm = image.depth_mm[static_cast<std::size_t>(y * size_px.x + x)];
            add(errors, image, camera, x, y, expected_mm,
                glm::dot(normal, camera.eye_mm() + measured_mm * ray), normal);
        }
    EXPECT_GT(errors.pixels, 20'000);
    EXPECT_LT(errors.deepest_voxels, 0.2);
    EXPECT_LT(errors.farthest_voxels, 0.1);
    EXPECT_LT(errors.largest_rad, glm::radians(2.0));
}

// The head of a round burr is a ball but for its flutes, which are cut into it.
TEST_F(SurfacePassTest, MeasuresTheBurrWhereItIs) {
    const Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 1.0 - glm::length(p); });
    const BoneTextures textures(bone, {});
    const Camera camera = camera_from_aside();
    DrawnTool tool;
    tool.burr.diameter_mm = 2.0;
    tool.state.burr_position_mm = -1.5 * camera.forward();
    tool.state.spindle_axis = camera.up();
    const SurfaceImage image = SurfacePass(size_px).draw(textures, &tool, camera);
    const glm::ivec2 middle(pixel_of(camera, tool.state.burr_position_mm, size_px));
    const auto i = static_cast<std::size_t>(middle.y * size_px.x + middle.x);
    EXPECT_EQ(image.thing[i], SurfaceImage::burr);
    EXPECT_NEAR(image.depth_mm[i], camera.distance_mm - 2.5, 0.3);  // a flute's depth
    const glm::ivec2 above(pixel_of(camera, tool.state.burr_position_mm + 1.8 * camera.up(), size_px));
    EXPECT_EQ(image.thing[static_cast<std::size_t>(above.y * size_px.x + above.x)], SurfaceImage::shank);
}

TEST_F(SurfacePassTest, DrawsPartsAsItDrawsTheWhole) {
    Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 3.3 - glm::length(p); });
    BoneTextures textures(bone, {});
    const Camera camera = camera_from_aside();
    SurfacePass pass(size_px);
    DrawnTool tool;
    tool.burr.diameter_mm = 1.0;
    SurfaceImage before;
    for (double x = -1.0; x < 1.0; x += 0.5) {
        tool.state.burr_position_mm = {x, -1.8, 2.4};
        pass.mark_dirty(textures.update(bone, carve_sphere(bone, tool.state.burr_position_mm, 0.5)));
        const SurfaceImage parts = pass.draw(textures, &tool, camera);
        const SurfaceImage whole = SurfacePass(size_px).draw(textures, &tool, camera);
        EXPECT_EQ(parts.depth_mm, whole.depth_mm);
        EXPECT_EQ(parts.normal, whole.normal);
        EXPECT_EQ(parts.thing, whole.thing);
        EXPECT_NE(parts.depth_mm, before.depth_mm);
        before = parts;
    }
}

// Like its picture, the measured surface is within a voxel of the ball.
TEST_F(SurfacePassTest, MeasuresASoftStructureInFrontOfBoneAndNoneBehind) {
    const Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 2.8 - glm::length(p); });
    const BoneTextures textures(bone, {});
    const Camera camera = camera_from_aside();
    const auto at = [&](const glm::dvec3& place_mm) {
        const glm::ivec2 pixel(pixel_of(camera, place_mm, size_px));
        return static_cast<std::size_t>(pixel.y * size_px.x + pixel.x);
    };
    const glm::dvec3 before_mm = -3.0 * camera.forward(), behind_mm = 3.75 * camera.forward();
    SurfacePass pass(size_px);
    pass.draw(textures, nullptr, camera);
    pass.add_structure(surface_of(testing::ball_mask(grid, before_mm, 0.9), glm::vec3(1.0f)), 9);
    pass.add_structure(surface_of(testing::ball_mask(grid, behind_mm, 0.9), glm::vec3(1.0f)), 10);
    const SurfaceImage image = pass.draw(textures, nullptr, camera);
    EXPECT_EQ(image.thing[at(before_mm)], 9);
    EXPECT_NEAR(image.depth_mm[at(before_mm)], camera.distance_mm - 3.9, grid.spacing_mm);
    EXPECT_LT(image.normal[at(before_mm)].z, -0.9f);
    EXPECT_EQ(std::ranges::count(image.thing, 10), 0);
}

}  // namespace
}  // namespace osteomill::surface_pass_test
