#include "render_client/volume/stereo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render_client/volume/camera.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/stereo_picture.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::stereo_test {
namespace {

using StereoTest = OffscreenTest;

constexpr std::array layouts{StereoLayout::side_by_side, StereoLayout::top_bottom, StereoLayout::rows,
                             StereoLayout::quad_buffer};

/// f b (1/z - 1/c), in pixels of an eye's picture.
double disparity_px(const Camera& middle, const StereoSettings& stereo, const glm::ivec2& size_px,
                    double depth_mm) {
    const glm::ivec2 eye_px = eye_size_px(stereo.layout, size_px);
    const double half_width = std::tan(0.5 * middle.field_of_view_rad) * size_px.x / size_px.y;
    const double focal_px = 0.5 * eye_px.x / half_width;
    return focal_px * *stereo.interpupillary_mm * (1.0 / depth_mm - 1.0 / *stereo.convergence_mm);
}

TEST(Stereo, ShiftsAPointByTheClosedForm) {
    const glm::ivec2 size_px(1280, 800);
    const Camera middle = camera_on({3.0, -2.0, 5.0}, 10.0);
    for (const StereoLayout layout : layouts)
        for (const double depth_mm : {15.0, 25.0, 30.0, 60.0})
            for (const double aside_mm : {-4.0, 0.0, 3.0}) {
                const StereoSettings stereo{layout, 2.4, 25.0};
                const glm::dvec3 point_mm = middle.eye_mm() + depth_mm * middle.forward() +
                                            aside_mm * middle.right() + 2.0 * middle.up();
                std::array<glm::dvec2, 2> seen{};
                for (const Eye eye : {Eye::left, Eye::right}) {
                    const Camera camera = eye_camera(middle, stereo, eye);
                    const glm::ivec2 eye_px = eye_size_px(layout, size_px);
                    const glm::dvec4 clip =
                        camera.projection(eye_px) * camera.view() * glm::dvec4(point_mm, 1.0);
                    glm::dvec2& pixel = seen[static_cast<std::size_t>(eye)];
                    pixel = {(0.5 + 0.5 * clip.x / clip.w) * eye_px.x,
                             (0.5 - 0.5 * clip.y / clip.w) * eye_px.y};
                    EXPECT_NEAR(glm::distance(pixel, pixel_of(camera, point_mm, eye_px)), 0.0, 1e-6);
                    const glm::dvec3 ray = direction_through(camera, pixel, eye_px);
                    EXPECT_NEAR(glm::length(glm::cross(ray, glm::normalize(point_mm - camera.eye_mm()))), 0.0,
                                1e-9);
                }
                EXPECT_NEAR(seen[0].x - seen[1].x, disparity_px(middle, stereo, size_px, depth_mm), 1e-6);
                EXPECT_NEAR(seen[0].y, seen[1].y, 1e-6);
            }
}

TEST(Stereo, KeepsTheEyesAsFarApartAsAMicroscopeUnlessToldOtherwise) {
    const Camera middle{.distance_mm = 300.0};
    const Camera left = eye_camera(middle, {.layout = StereoLayout::rows}, Eye::left);
    const Camera right = eye_camera(middle, {.layout = StereoLayout::rows}, Eye::right);
    EXPECT_NEAR(glm::distance(left.eye_mm(), right.eye_mm()), 24.0, 1e-9);
    EXPECT_NEAR(glm::dot(right.eye_mm() - left.eye_mm(), middle.right()), 24.0, 1e-9);
}

/// Mean column of all that is not background.
double column_of(const gl::Framebuffer& picture) {
    const glm::ivec2& size_px = picture.size_px();
    std::vector<float> depths(static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y));
    picture.bind();
    glReadPixels(0, 0, size_px.x, size_px.y, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    double weight = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < depths.size(); ++i)
        if (depths[i] < 1.0f) {
            weight += 1.0;
            sum += static_cast<double>(i % static_cast<std::size_t>(size_px.x)) + 0.5;
        }
    return sum / weight;
}

const Grid grid{.size_voxels = {96, 96, 64}, .origin_mm = {-4.75, -4.75, -3.15}};

Bone ball() {
    return made_bone(grid, [](const glm::dvec3& p) { return 1.5 - glm::length(p); });
}

/// The column of the centre of a ball's outline, which is a little beside the ball's centre.
double column_of_outline(const Camera& camera, double radius_mm, const glm::ivec2& size_px) {
    const glm::dvec3 to_ball = -camera.eye_mm();
    const double aside = glm::dot(to_ball, camera.right());
    const double depth = glm::dot(to_ball, camera.forward());
    // Tangent rays of slope s: (aside - s depth)^2 = r^2 (1 + s^2), the mean of both roots.
    const double slope = aside * depth / (depth * depth - radius_mm * radius_mm);
    const double half_width = camera.half_extent(size_px).x;
    return 0.5 * size_px.x * (1.0 + (slope - camera.middle_slope) / half_width);
}

TEST_F(StereoTest, DrawsABallWhereEachEyeSeesIt) {
    const glm::ivec2 size_px(1200, 900);
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    Camera middle = camera_on({0.0, 0.0, 0.0}, 6.0);
    middle.elevation_rad = 0.0;
    for (const StereoLayout layout : layouts) {
        const StereoSettings stereo{layout, 1.6, 1.4 * middle.distance_mm};
        StereoPicture picture(renderer, size_px, false, stereo);
        picture.draw(&textures, nullptr, middle);
        const glm::ivec2 eye_px = picture.eye_size_px();
        std::array<double, 2> drawn{}, expected{};
        for (const Eye eye : {Eye::left, Eye::right}) {
            const auto i = static_cast<std::size_t>(eye);
            drawn[i] = column_of(*picture.pictures()[i]);
            expected[i] = column_of_outline(eye_camera(middle, stereo, eye), 1.5, eye_px);
            EXPECT_NEAR(drawn[i], expected[i], 0.1) << static_cast<int>(layout);
        }
        const double closed = disparity_px(middle, stereo, size_px, middle.distance_mm);
        EXPECT_GT(closed, 3.0);
        EXPECT_NEAR(drawn[0] - drawn[1], expected[0] - expected[1], 0.1) << static_cast<int>(layout);
    }
}

/// Disparity of a known point, measured in the two pictures, against docs/microscope.md. A ball is found
/// better than a point: the middle of its outline is at z / (z^2 - r^2) where a point of its centre is at 1 /
/// z.
TEST_F(StereoTest, DrawsAKnownPointWithTheDisparityOfTheClosedForm) {
    constexpr double radius_mm = 0.6;
    const glm::ivec2 size_px(800, 600);
    const glm::dvec3 point_mm(1.1, -0.7, 0.4);
    const BoneTextures textures(
        made_bone(grid, [&](const glm::dvec3& p) { return radius_mm - glm::length(p - point_mm); }), {});
    RaycastRenderer renderer;
    for (const double magnification : {0.6, 2.5})
        for (const double convergence_part : {0.8, 1.5})
            for (const StereoLayout layout : layouts) {
                Camera middle = camera_on({0.0, 0.0, 0.0}, 5.0);
                set_magnification(middle, magnification);
                const StereoSettings stereo{layout, 1.3, convergence_part * middle.distance_mm};
                StereoPicture picture(renderer, size_px, false, stereo);
                picture.draw(&textures, nullptr, middle);
                const double z_mm = glm::dot(point_mm - middle.eye_mm(), middle.forward());
                const double focal_px = 0.5 * picture.eye_size_px().x /
                                        (std::tan(0.5 * middle.field_of_view_rad) * size_px.x / size_px.y);
                const double seen_px =
                    focal_px * 1.3 *
                    (z_mm / (z_mm * z_mm - radius_mm * radius_mm) - 1.0 / *stereo.convergence_mm);
                const double drawn_px = column_of(*picture.pictures()[0]) - column_of(*picture.pictures()[1]);
                EXPECT_NEAR(drawn_px, seen_px, 0.1)
                    << magnification << ' ' << convergence_part << ' ' << static_cast<int>(layout);
            }
}

TEST_F(StereoTest, DrawsTheBurrWhereEachEyeSeesIt) {
    const glm::ivec2 size_px(400, 300);
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    const Camera middle = camera_on({0.0, 0.0, 0.0}, 6.0);
    DrawnTool tool;
    tool.burr.diameter_mm = 2.0;
    tool.state.burr_position_mm = 4.0 * middle.right();
    const StereoSettings stereo{StereoLayout::quad_buffer, 1.6, 1.4 * middle.distance_mm};
    StereoPicture with(renderer, size_px, false, stereo), without(renderer, size_px, false, stereo);
    with.draw(&textures, &tool, middle);
    without.draw(&textures, nullptr, middle);
    for (const Eye eye : {Eye::left, Eye::right}) {
        const auto i = static_cast<std::size_t>(eye);
        const Camera camera = eye_camera(middle, stereo, eye);
        const glm::dvec2 at = pixel_of(camera, tool.state.burr_position_mm, size_px);
        const auto depth = [&](const StereoPicture& picture, const glm::dvec2& pixel) {
            return picture.pictures()[i]->depth_at(
                {static_cast<int>(pixel.x), size_px.y - 1 - static_cast<int>(pixel.y)});
        };
        const double radius_px = 1.0 / mm_per_px_at(camera, tool.state.burr_position_mm, size_px);
        EXPECT_LT(depth(with, at), depth(without, at));
        for (const double side : {-1.0, 1.0}) {
            EXPECT_LT(depth(with, at + glm::dvec2(0.9 * side * radius_px, 0.0)), 1.0f);
            EXPECT_EQ(depth(with, at + glm::dvec2(1.2 * side * radius_px, 0.0)), 1.0f);
        }
    }
}

TEST_F(StereoTest, PutsTheEyesTogetherAsTheDisplayTakesThem) {
    const glm::ivec2 size_px(64, 48);
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    const Camera middle = camera_on({0.0, 0.0, 0.0}, 3.0);
    for (const StereoLayout layout : layouts) {
        StereoPicture picture(renderer, size_px, false, {layout, 1.0, 20.0});
        picture.draw(&textures, nullptr, middle);
        const Picture left = picture.pictures()[0]->read_back(), right = picture.pictures()[1]->read_back();
        const Picture whole = picture.compose().read_back();
        ASSERT_EQ(whole.size_px, size_px);
        EXPECT_NE(left.rgb, right.rgb);
        for (int y = 0; y < size_px.y; ++y)
            for (int x = 0; x < size_px.x; ++x) {
                const std::uint8_t* const expected =
                    layout == StereoLayout::side_by_side ? (x < 32 ? left.at(x, y) : right.at(x - 32, y))
                    : layout == StereoLayout::top_bottom ? (y < 24 ? left.at(x, y) : right.at(x, y - 24))
                    : layout == StereoLayout::rows ? (y % 2 == 0 ? left.at(x, y / 2) : right.at(x, y / 2))
                                                   : left.at(x, y);
                ASSERT_TRUE(std::equal(expected, expected + 3, whole.at(x, y)))
                    << static_cast<int>(layout) << ' ' << x << ' ' << y;
            }
    }
}

TEST_F(StereoTest, DrawsBothEyesAnewAfterAnotherLookOrSize) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer, other;
    const Camera middle = camera_on({0.0, 0.0, 0.0}, 3.0);
    const StereoSettings stereo{StereoLayout::side_by_side, 1.0, 20.0};
    const SceneAppearance look{.cuts = {CutPlane{.normal = {1.0, 0.0, 0.0}}}};
    StereoPicture kept(renderer, {64, 48}, false, stereo);
    kept.draw(&textures, nullptr, middle);
    kept.set_appearance(look);
    for (const glm::ivec2 size_px : {glm::ivec2(64, 48), glm::ivec2(91, 37), glm::ivec2(1, 1)}) {
        kept.resize(size_px);
        kept.draw(&textures, nullptr, middle);
        StereoPicture fresh(other, size_px, false, stereo);
        fresh.set_appearance(look);
        fresh.draw(&textures, nullptr, middle);
        EXPECT_EQ(kept.compose().read_back(), fresh.compose().read_back()) << size_px.x;
    }
}

}  // namespace
}  // namespace osteomill::stereo_test
