#include "studies/render/reference_image.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <thread>
#include <vector>

#include "render_client/volume/shaders/lighting.h"
#include "render_client/volume/textures/smoothed_fraction.h"
#include "render_client/volume/textures/visible_bone.h"

namespace osteomill::study {

namespace {

glm::ivec3 corner_of(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

glm::dvec3 side_of(int corner) {
    return 2.0 * glm::dvec3(corner_of(corner)) - 1.0;
}

/// Share of a corner at a place within its cell, 0 to 1 along each axis.
double weight_of(int corner, const glm::dvec3& part) {
    const glm::dvec3 share = glm::mix(1.0 - part, part, glm::dvec3(corner_of(corner)));
    return share.x * share.y * share.z;
}

/// A point's place between voxel centres.
struct Place {
    explicit Place(const glm::dvec3& point)
        : low(glm::floor(point - 0.5)), part(point - 0.5 - glm::dvec3(low)) {}
    glm::ivec3 low;
    glm::dvec3 part;
};

/// Distance of the eight corners from the point, voxels: as in the shaders.
constexpr double corner_reach = 0.45;

}  // namespace

ReferenceVolume::ReferenceVolume(const Bone& whole, std::span<const TissueColour> tissues,
                                 const ShadingSettings& look)
    : grid_(whole.grid()),
      box_(stored_box(whole.content())),
      table_(transfer_table(whole.content(), tissues, look)) {
    if (box_.count() == 0) throw std::runtime_error("the bone has no voxel to draw");
    const VisibleBone visible(whole, table_);
    const Bone& bone = visible.bone();
    fraction_.resize(box_.count());
    copy_channel(bone, BoneChannel::fraction, box_, fraction_);
    if (table_.codes.exist()) {
        code_.resize(box_.count());
        copy_codes(bone, table_.codes, box_, code_);
    }
    const EmptySpace blocks(bone, box_);
    mean_size_ = blocks.size_blocks();
    mean_fraction_ = blocks.mean_fraction();
    FractionSmoother smoother(table_);
    const std::span<const std::uint8_t> smoothed = smoother.smooth(bone, box_);
    smoothed_.assign(smoothed.begin(), smoothed.end());
    if (look.shading == Shading::surface_voxels) surface_ = SurfaceShader(table_).shade(bone, box_);
}

bool ReferenceVolume::contains(const glm::ivec3& voxel) const {
    return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < box_.size.x && voxel.y < box_.size.y &&
           voxel.z < box_.size.z;
}

double ReferenceVolume::fraction_at(const glm::dvec3& point, Cell& cell) const {
    const Place at(point);
    if (at.low != cell.low) {
        cell.low = at.low;
        cell.is_empty = true;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 voxel = at.low + corner_of(corner);
            const double value = contains(voxel) ? fraction_[place(voxel)] / 255.0 : 0.0;
            cell.values[static_cast<std::size_t>(corner)] = value;
            cell.is_empty = cell.is_empty && value == 0.0;
        }
    }
    if (cell.is_empty) return 0.0;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner)
        sum += weight_of(corner, at.part) * cell.values[static_cast<std::size_t>(corner)];
    return sum;
}

double ReferenceVolume::fraction_at(const glm::dvec3& point) const {
    Cell cell;
    return fraction_at(point, cell);
}

double ReferenceVolume::smoothed_at(const glm::dvec3& point) const {
    const Place at(point);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner)
        if (const glm::ivec3 voxel = at.low + corner_of(corner); contains(voxel))
            sum += weight_of(corner, at.part) * smoothed_[place(voxel)] / 255.0;
    return sum;
}

glm::dvec3 ReferenceVolume::eight_corner_gradient_at(const glm::dvec3& point) const {
    glm::dvec3 gradient(0.0);
    for (int corner = 0; corner < 8; ++corner)
        gradient += side_of(corner) * smoothed_at(point + corner_reach * side_of(corner));
    return gradient / (8.0 * corner_reach);
}

std::uint8_t ReferenceVolume::code_at(const glm::ivec3& voxel) const {
    return code_.empty() ? std::uint8_t{0} : code_[place(glm::clamp(voxel, glm::ivec3(0), box_.size - 1))];
}

glm::dvec4 ReferenceVolume::look_at(const glm::dvec3& point) const {
    const glm::dvec4 unknown(table_.by_code[0]);
    if (code_.empty()) return unknown;
    const Place at(point);
    glm::dvec4 sum(0.0);
    double known = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const std::uint8_t code = code_at(at.low + corner_of(corner));
        const glm::dvec4 look(table_.by_code[code]);
        if (code == 0 || look.a == 0.0) continue;
        const double weight = weight_of(corner, at.part) + 1e-5;
        sum += weight * look;
        known += weight;
    }
    return known > 0.0 ? sum / known : unknown;
}

glm::dvec4 ReferenceVolume::smooth_look_at(const glm::dvec3& point) const {
    const glm::dvec4 unknown(table_.by_code[0]);
    if (code_.empty()) return unknown;
    if (table_.codes.are_mostly_alike()) return wide_look_at(point);
    const glm::ivec3 nearest(glm::floor(point));
    const glm::dvec3 off = point - glm::dvec3(nearest) - 0.5;
    // By step along an axis, -1 to 1.
    const std::array<glm::dvec3, 3> weights{0.5 * (0.5 - off) * (0.5 - off), 0.75 - off * off,
                                            0.5 * (0.5 + off) * (0.5 + off)};
    glm::dvec4 sum(0.0);
    double known = 0.0;
    for (std::size_t step = 0; step < 27; ++step) {
        const std::size_t x = step % 3, y = step / 3 % 3, z = step / 9;
        const std::uint8_t code = code_at(nearest + glm::ivec3(x, y, z) - 1);
        const glm::dvec4 look(table_.by_code[code]);
        if (code == 0 || look.a == 0.0) continue;
        const double weight = weights[x].x * weights[y].y * weights[z].z + 1e-5;
        sum += weight * look;
        known += weight;
    }
    return known > 0.0 ? sum / known : unknown;
}

glm::dvec4 ReferenceVolume::wide_look_at(const glm::dvec3& point) const {
    const Place at(point);
    // Tents before the place and after it, by step along an axis, -1 to 2.
    const auto weight = [](double away) {
        constexpr double tent_offset = 0.85;
        return 0.5 * (std::max(1.0 - std::abs(away - tent_offset), 0.0) +
                      std::max(1.0 - std::abs(away + tent_offset), 0.0));
    };
    glm::dvec4 sum(0.0);
    double known = 0.0;
    for (int z = -1; z <= 2; ++z)
        for (int y = -1; y <= 2; ++y)
            for (int x = -1; x <= 2; ++x) {
                const std::uint8_t code = code_at(at.low + glm::ivec3(x, y, z));
                const glm::dvec4 look(table_.by_code[code]);
                if (code == 0 || look.a == 0.0) continue;
                const double share =
                    weight(x - at.part.x) * weight(y - at.part.y) * weight(z - at.part.z) + 1e-5;
                sum += share * look;
                known += share;
            }
    return known > 0.0 ? sum / known : glm::dvec4(table_.by_code[0]);
}

glm::dvec4 ReferenceVolume::look_under(const glm::dvec3& point, const glm::dvec3& normal) const {
    const double deepest = colour_depth_voxels(table_);
    const double bone_there = fraction_at(point - deepest * normal);
    return smooth_look_at(point - glm::mix(1.0, deepest, bone_there) * normal);
}

glm::dvec4 ReferenceVolume::surface_colour_at(const glm::dvec3& point) const {
    const Place at(point);
    glm::dvec4 sum(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 voxel = at.low + corner_of(corner);
        if (!contains(voxel)) continue;
        const SurfaceTexel& texel = surface_[place(voxel)];
        sum += weight_of(corner, at.part) / 255.0 * glm::dvec4(texel.r, texel.g, texel.b, texel.a);
    }
    return sum;
}

double ReferenceVolume::mean_fraction_at(const glm::dvec3& point) const {
    // The map begins a block before the box.
    const Place at(point / static_cast<double>(block_edge_voxels) + 1.0);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 block = at.low + corner_of(corner);
        if (!osteomill::contains(Grid{.size_voxels = mean_size_}, block)) continue;
        const std::size_t index =
            (static_cast<std::size_t>(block.z) * mean_size_.y + block.y) * mean_size_.x + block.x;
        sum += weight_of(corner, at.part) * mean_fraction_[index] / 255.0;
    }
    return sum;
}

double ReferenceVolume::ambient_occlusion(const glm::dvec3& point, const glm::dvec3& normal) const {
    const glm::dvec3 helper = std::abs(normal.z) < 0.8 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 aside = glm::normalize(glm::cross(normal, helper));
    const glm::dvec3 across = glm::cross(normal, aside);
    double taken = 0.0;
    for (const glm::dvec3& lean : {aside, -aside, across, -across}) {
        const glm::dvec3 slanted = glm::normalize(normal + 0.9 * lean);
        taken += mean_fraction_at(point + 7.0 * slanted) + mean_fraction_at(point + 16.0 * slanted);
    }
    return glm::clamp(1.15 - 0.14 * taken, 0.0, 1.0);
}

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
