#include "render_client/dataset/random_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>

#include "render_client/volume/shaders/lighting.h"

namespace osteomill {

namespace {

/// The library's distributions may differ between its versions; these do not.
class Lot {
  public:
    explicit Lot(std::uint64_t seed, std::size_t frame = 0, std::size_t stream = 0) {
        std::seed_seq all{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                          static_cast<std::uint32_t>(frame), static_cast<std::uint32_t>(stream)};
        bits_.seed(all);
    }
    std::uint64_t bits() { return bits_(); }
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1p-53;
    }
    glm::dvec3 between3(double low, double high) {
        const double x = between(low, high), y = between(low, high);
        return {x, y, between(low, high)};
    }
    /// Two of mean 0 and variance 1 (Box and Muller).
    glm::dvec2 normal() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - between(0.0, 1.0)));
        const double angle = between(0.0, 2.0 * std::numbers::pi);
        return {radius * std::cos(angle), radius * std::sin(angle)};
    }

  private:
    std::mt19937_64 bits_;
};

constexpr double display_gamma = 2.2;  // as lighting.h's display()

std::array<float, 256> linear_by_byte() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = static_cast<float>(std::pow(static_cast<double>(i) / 255.0, display_gamma));
    return table;
}

std::uint8_t displayed(double linear) {
    return static_cast<std::uint8_t>(
        std::lround(255.0 * std::pow(std::clamp(linear, 0.0, 1.0), 1.0 / display_gamma)));
}

/// Blinn's, of the key lamp: as lighting.glsl.
double highlight(const glm::dvec3& normal, const glm::dvec3& to_eye) {
    return std::pow(std::max(glm::dot(normal, glm::normalize(to_eye + key_direction)), 0.0), 48.0);
}

/// Along one axis; beyond the edges the edge goes on.
void blur_along(std::vector<glm::vec3>& pixels, const glm::ivec2& size, int axis, double sigma_px) {
    const int reach = static_cast<int>(std::ceil(3.0 * sigma_px));
    std::vector<float> weights;
    float sum = 0.0f;
    for (int i = -reach; i <= reach; ++i)
        sum += weights.emplace_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma_px * sigma_px))));
    const std::vector<glm::vec3> before = pixels;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            glm::vec3 mean(0.0f);
            for (int i = -reach; i <= reach; ++i) {
                glm::ivec2 at(x, y);
                at[axis] = std::clamp(at[axis] + i, 0, size[axis] - 1);
                mean += weights[static_cast<std::size_t>(i + reach)] *
                        before[static_cast<std::size_t>(at.y * size.x + at.x)];
            }
            pixels[static_cast<std::size_t>(y * size.x + x)] = mean / sum;
        }
}

/// Linear light at the camera.
std::vector<glm::vec3> lit_anew(const CameraImages& images, const Pinhole& pinhole, const RandomLook& look) {
    static const std::array<float, 256> linear = linear_by_byte();
    const glm::dmat3 to_patient = glm::mat3_cast(images.camera.rotation);
    const glm::dmat3 to_lamps = glm::mat3_cast(glm::conjugate(look.lamps));
    const glm::ivec2& size = images.colour.size_px;
    std::vector<glm::vec3> light;
    light.reserve(images.labels.size());
    for (int v = 0; v < size.y; ++v)
        for (int u = 0; u < size.x; ++u) {
            const std::size_t i = light.size();
            const std::uint8_t* byte = images.colour.at(u, v);
            glm::dvec3 colour(linear[byte[0]], linear[byte[1]], linear[byte[2]]);
            if (const std::uint8_t label = images.labels[i]; label != SurfaceImage::nothing) {
                const glm::dvec3 normal = to_patient * glm::dvec3(images.surface.normal[i]);
                const glm::dvec3 turned = to_lamps * normal;
                colour *= look.lamp_rgb * lit(look.tint_by_label[label], turned, 1.0) /
                          lit(glm::dvec3(1.0), normal, 1.0);
                if (label >= SurfaceImage::bone && look.wetness > 0.0) {
                    const glm::dvec2 slope = (glm::dvec2(u, v) - pinhole.centre_px) / pinhole.focal_px;
                    const glm::dvec3 to_eye = -glm::normalize(to_patient * glm::dvec3(slope, 1.0));
                    colour += look.wetness * look.lamp_rgb * highlight(turned, to_lamps * to_eye);
                }
            }
            light.emplace_back(look.exposure * colour);
        }
    return light;
}

}  // namespace

RandomLook random_look(std::uint64_t seed, std::size_t frame, std::size_t camera, std::size_t labels) {
    RandomLook look;
    Lot scene(seed, frame);
    const glm::dvec3 axis = scene.between3(-1.0, 1.0);
    const double turn_rad = glm::radians(scene.between(0.0, 50.0));
    if (glm::length(axis) > 1e-3) look.lamps = glm::angleAxis(turn_rad, glm::normalize(axis));
    look.lamp_rgb = scene.between3(0.85, 1.15);
    look.wetness = scene.between(0.0, 0.8);
    for (std::size_t label = 0; label < labels; ++label) {
        const glm::dvec3 tint = scene.between(0.8, 1.2) * scene.between3(0.93, 1.07);
        look.tint_by_label.push_back(label < SurfaceImage::bone ? glm::dvec3(1.0) : tint);
    }
    Lot its(seed, frame, camera + 1);
    look.exposure = its.between(0.7, 1.4);
    look.blur_px = its.between(0.0, 1.0);
    look.read_noise = its.between(0.001, 0.01);
    look.shot_noise = its.between(0.0, 0.0006);
    look.noise_seed = its.bits();
    return look;
}

Picture looked_at(const CameraImages& images, const Pinhole& pinhole, const RandomLook& look) {
    std::vector<glm::vec3> light = lit_anew(images, pinhole, look);
    const glm::ivec2& size = images.colour.size_px;
    constexpr double least_blur_px = 0.2;  // below, no neighbour has a part
    if (look.blur_px > least_blur_px)
        for (const int axis : {0, 1}) blur_along(light, size, axis, look.blur_px);
    Picture picture(size);
    Lot noise(look.noise_seed);
    glm::dvec2 pair(0.0);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        if (i % 2 == 0) pair = noise.normal();
        const double value = light[i / 3][static_cast<int>(i % 3)];
        const double variance = look.read_noise * look.read_noise + look.shot_noise * std::max(value, 0.0);
        picture.rgb[i] = displayed(value + std::sqrt(variance) * pair[static_cast<int>(i % 2)]);
    }
    return picture;
}

nlohmann::ordered_json json_of(const RandomLook& look) {
    return {{"lamps_xyzw", {look.lamps.x, look.lamps.y, look.lamps.z, look.lamps.w}},
            {"lamp_rgb", {look.lamp_rgb.x, look.lamp_rgb.y, look.lamp_rgb.z}},
            {"wetness", look.wetness},
            {"exposure", look.exposure},
            {"blur_px", look.blur_px},
            {"read_noise", look.read_noise},
            {"shot_noise", look.shot_noise}};
}

}  // namespace osteomill
