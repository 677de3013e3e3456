#include "studies/render/reference_image.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <thread>
#include <vector>

#include "render_client/volume/shaders/lighting.h"

namespace osteomill::study {

namespace {

// Constants of the model; the same as in bone_shading.glsl.
constexpr double bone_surface = 0.5;
constexpr glm::dvec3 light_within(0.50, 0.49, 0.48);
constexpr double darkest_seen = 0.0005;

struct Ray {
    glm::dvec3 eye;
    glm::dvec3 direction;  ///< unit
    double enter = 0.0;
    double leave = 0.0;

    glm::dvec3 at(double distance) const { return eye + distance * direction; }
};

class ReferenceRays {
  public:
    ReferenceRays(const ReferenceVolume& volume, const Camera& camera, const glm::ivec2& size_px,
                  const ReferenceSettings& settings)
        : volume_(volume), size_px_(size_px), settings_(settings), forward_(camera.forward()) {
        const double half_height = std::tan(0.5 * camera.field_of_view_rad);
        right_ = half_height * size_px.x / size_px.y * camera.right();
        up_ = half_height * camera.up();
        eye_ = to_voxel_coordinates(volume.grid(), camera.eye_mm()) + 0.5 - glm::dvec3(volume.box().first);
    }

    /// Display RGB of a pixel; y from the top.
    glm::dvec3 pixel(int x, int y) const {
        const glm::dvec2 place((x + 0.5) / size_px_.x, 1.0 - (y + 0.5) / size_px_.y);
        const Ray ray = ray_through(2.0 * place - 1.0);
        const glm::dvec3 behind = background_at(place);
        return volume_.is_translucent() ? translucent(ray, behind) : solid(ray, behind);
    }

  private:
    Ray ray_through(const glm::dvec2& place) const {
        glm::dvec3 direction = glm::normalize(forward_ + place.x * right_ + place.y * up_);
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(direction[axis]) < 1e-6) direction[axis] = 1e-6;
        // One voxel beyond the box on every side the fraction has fallen to zero.
        const glm::dvec3 to_low = (glm::dvec3(-1.0) - eye_) / direction;
        const glm::dvec3 to_high = (glm::dvec3(volume_.box().size) + 1.0 - eye_) / direction;
        const glm::dvec3 enter = glm::min(to_low, to_high);
        const glm::dvec3 leave = glm::max(to_low, to_high);
        return {eye_, direction, std::max({enter.x, enter.y, enter.z, 0.0}),
                std::min({leave.x, leave.y, leave.z})};
    }

    glm::dvec3 solid(const Ray& ray, const glm::dvec3& behind) const {
        Cell cell;
        const auto is_bone = [&](double distance) {
            return volume_.fraction_at(ray.at(distance), cell) >= bone_surface;
        };
        for (double distance = ray.enter; distance <= ray.leave; distance += settings_.step_voxels) {
            if (!is_bone(distance)) continue;
            double outside = std::max(ray.enter, distance - settings_.step_voxels), inside = distance;
            for (int halving = 0; halving < 40; ++halving) {
                const double middle = 0.5 * (outside + inside);
                (is_bone(middle) ? inside : outside) = middle;
            }
            return surface(ray.at(inside), ray.direction);
        }
        return display(behind);
    }

    glm::dvec3 surface(const glm::dvec3& point, const glm::dvec3& direction) const {
        if (volume_.has_surface_colours()) {
            const glm::dvec4 colour = volume_.surface_colour_at(point);
            return glm::dvec3(colour) / std::max(colour.a, 1e-3);
        }
        const glm::dvec3 gradient = volume_.eight_corner_gradient_at(point);
        const double steepness = glm::length(gradient);
        const glm::dvec3 normal = steepness > 1e-5 ? -gradient / steepness : -direction;
        const glm::dvec3 colour(volume_.look_under(point, normal));
        return display(lit(colour, normal, volume_.ambient_occlusion(point, normal)));
    }

    glm::dvec3 translucent(const Ray& ray, const glm::dvec3& behind) const {
        Cell cell;
        glm::dvec3 light(0.0);
        double through = 1.0;
        const double step_mm = settings_.step_voxels * volume_.grid().spacing_mm;
        for (double distance = ray.enter; distance <= ray.leave && through > darkest_seen;
             distance += settings_.step_voxels) {
            const glm::dvec3 point = ray.at(distance);
            const double filled = 2.0 * volume_.fraction_at(point, cell) - 1.0;
            if (filled <= 0.0) continue;
            const glm::dvec4 look = volume_.look_at(point);
            const double alpha = 1.0 - std::pow(1.0 - std::min(look.a, 0.999), filled * step_mm);
            light += through * alpha * translucent_colour(point, glm::dvec3(look));
            through *= 1.0 - alpha;
        }
        return display(light + through * behind);
    }

    glm::dvec3 translucent_colour(const glm::dvec3& point, const glm::dvec3& colour) const {
        if (volume_.has_surface_colours()) {
            const glm::dvec4 surface_colour = volume_.surface_colour_at(point);
            const glm::dvec3 linear =
                glm::pow(glm::dvec3(surface_colour) / std::max(surface_colour.a, 1e-3), glm::dvec3(2.2));
            return glm::mix(colour * light_within, linear, std::min(2.0 * surface_colour.a, 1.0));
        }
        const glm::dvec3 gradient = volume_.eight_corner_gradient_at(point);
        const double steepness = glm::length(gradient);
        if (steepness < 1e-4) return colour * light_within;
        return glm::mix(colour * light_within, lit(colour, -gradient / steepness, 1.0),
                        std::min(12.0 * steepness, 1.0));
    }

    const ReferenceVolume& volume_;
    glm::ivec2 size_px_;
    ReferenceSettings settings_;
    glm::dvec3 forward_;
    glm::dvec3 right_{0.0};
    glm::dvec3 up_{0.0};
    glm::dvec3 eye_{0.0};
};

}  // namespace

Picture reference_image(const ReferenceVolume& volume, const Camera& camera, const glm::ivec2& size_px,
                        const ReferenceSettings& settings) {
    const ReferenceRays rays(volume, camera, size_px, settings);
    Picture picture(size_px);
    std::atomic<int> next_row{0};
    const auto work = [&] {
        for (int y = next_row++; y < size_px.y; y = next_row++)
            for (int x = 0; x < size_px.x; ++x) {
                const glm::dvec3 colour = glm::clamp(rays.pixel(x, y), 0.0, 1.0);
                for (int channel = 0; channel < 3; ++channel)
                    picture.rgb[3 * (static_cast<std::size_t>(y) * size_px.x + x) + channel] =
                        static_cast<std::uint8_t>(std::lround(255.0 * colour[channel]));
            }
    };
    std::vector<std::jthread> helpers;
    for (unsigned thread = 1; thread < settings.threads; ++thread) helpers.emplace_back(work);
    work();
    helpers.clear();
    return picture;
}

}  // namespace osteomill::study
