#include "render_client/dataset/random_look.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "render_client/volume/shaders/lighting.h"

namespace osteomill::random_look_test {
namespace {

constexpr double gamma = 2.2;

/// A wall that faces the camera and fills the picture, half of it of another level.
CameraImages wall(const glm::ivec2& size_px, std::uint8_t level, std::uint8_t other_level) {
    const auto pixels = static_cast<std::size_t>(size_px.x * size_px.y);
    CameraImages images{.colour = Picture(size_px)};
    images.surface.size_px = size_px;
    images.surface.depth_mm.assign(pixels, 50.0f);
    images.surface.normal.assign(pixels, {0.0f, 0.0f, -1.0f});
    images.labels.assign(pixels, SurfaceImage::bone);
    for (std::size_t i = 0; i < images.colour.rgb.size(); ++i) {
        const bool is_left = static_cast<int>(i / 3) % size_px.x < size_px.x / 2;
        images.colour.rgb[i] = is_left ? level : other_level;
    }
    return images;
}

RandomLook neutral() {
    return {.tint_by_label = std::vector<glm::dvec3>(4, glm::dvec3(1.0))};
}

double linear(std::uint8_t level) {
    return std::pow(level / 255.0, gamma);
}

const Pinhole pinhole = pinhole_of({64, 48}, 0.6);

TEST(RandomLookTest, WithoutAnyChangeIsThePictureItself) {
    for (const std::uint8_t level : std::initializer_list<std::uint8_t>{0, 1, 7, 100, 254, 255}) {
        const CameraImages images = wall(pinhole.size_px, level, 128);
        EXPECT_EQ(looked_at(images, pinhole, neutral()), images.colour);
    }
}

TEST(RandomLookTest, LightsAWallAsTurnedLampsDo) {
    CameraImages images = wall(pinhole.size_px, 120, 120);
    images.camera = looking_at({0, -80, 60}, glm::dvec3(0.0), {0, 0, 1});
    RandomLook look = neutral();
    look.lamps = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, -1)));
    look.lamp_rgb = {1.1, 1.0, 0.9};
    look.tint_by_label[SurfaceImage::bone] = {0.9, 1.0, 1.1};
    look.exposure = 1.2;
    const glm::dvec3 normal = images.camera.rotation * glm::dvec3(0, 0, -1);
    const glm::dvec3 before = lit(glm::dvec3(1.0), normal, 1.0);
    const glm::dvec3 after = lit(glm::dvec3(1.0), glm::conjugate(look.lamps) * normal, 1.0);
    const glm::dvec3 expected =
        linear(120) * 1.2 * look.lamp_rgb * look.tint_by_label[SurfaceImage::bone] * after / before;
    const Picture picture = looked_at(images, pinhole, look);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(picture.at(30, 20)[channel], 255.0 * std::pow(expected[channel], 1.0 / gamma), 1.0);
}

TEST(RandomLookTest, ShinesWhereTheLampIsMirroredInWetTissueAndOnNoTool) {
    CameraImages images = wall(pinhole.size_px, 100, 100);
    images.camera = looking_at(100.0 * key_direction, glm::dvec3(0.0), {0, 0, 1});
    RandomLook look = neutral();
    look.wetness = 0.5;
    const Picture wet = looked_at(images, pinhole, look);
    EXPECT_NEAR(linear(wet.at(32, 24)[1]), linear(100) + 0.5, 0.01);
    images.labels.assign(images.labels.size(), SurfaceImage::shank);
    EXPECT_EQ(looked_at(images, pinhole, look), images.colour);
}

TEST(RandomLookTest, BlursAnEdgeByTheGaussianThatItSays) {
    const CameraImages images = wall(pinhole.size_px, 200, 50);
    RandomLook look = neutral();
    look.blur_px = 0.9;
    const Picture blurred = looked_at(images, pinhole, look);
    // The edge is half a pixel beside the middle of column 31: light of the left half by the normal
    // distribution.
    for (int x = 28; x < 36; ++x) {
        const double left = 0.5 * std::erfc((x - 31.5) / (0.9 * std::sqrt(2.0)));
        EXPECT_NEAR(linear(blurred.at(x, 20)[0]), left * linear(200) + (1.0 - left) * linear(50), 0.02) << x;
    }
}

TEST(RandomLookTest, HasNoiseOfTheVarianceThatItSays) {
    const CameraImages images = wall({200, 200}, 150, 150);
    RandomLook look = neutral();
    look.read_noise = 0.02;
    look.shot_noise = 0.001;
    const Picture noisy = looked_at(images, pinhole_of({200, 200}, 0.6), look);
    double sum = 0.0, squares = 0.0;
    for (const std::uint8_t level : noisy.rgb) {
        sum += linear(level) - linear(150);
        squares += std::pow(linear(level) - linear(150), 2);
    }
    const auto count = static_cast<double>(noisy.rgb.size());
    EXPECT_NEAR(sum / count, 0.0, 5e-4);
    EXPECT_NEAR(squares / count, 0.02 * 0.02 + 0.001 * linear(150), 0.03 * squares / count);
}

TEST(RandomLookTest, IsDrawnFromSeedFrameAndCameraAlone) {
    const RandomLook look = random_look(5, 17, 0, 8), other_eye = random_look(5, 17, 1, 8);
    EXPECT_EQ(json_of(look), json_of(random_look(5, 17, 0, 8)));
    EXPECT_EQ(look.lamps, other_eye.lamps);
    EXPECT_EQ(look.tint_by_label, other_eye.tint_by_label);
    EXPECT_NE(look.noise_seed, other_eye.noise_seed);
    EXPECT_NE(look.lamps, random_look(5, 18, 0, 8).lamps);
    EXPECT_NE(look.lamps, random_look(6, 17, 0, 8).lamps);
    EXPECT_EQ(look.tint_by_label[SurfaceImage::burr], glm::dvec3(1.0));
    ASSERT_EQ(look.tint_by_label.size(), 8u);
}

}  // namespace
}  // namespace osteomill::random_look_test
