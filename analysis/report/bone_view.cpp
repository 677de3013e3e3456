#include "analysis/report/bone_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/bone/bone_ray.h"

namespace osteomill {

namespace {

constexpr int rays_per_pixel_edge = 2;
const glm::dvec3 paper(255.0);
const glm::dvec3 bone_colour(226.0, 216.0, 198.0);

class View {
  public:
    View(const Bone& bone, std::span<const Tissue> tissues, const BoneView& view)
        : bone_(bone), view_(view), probe_(bone) {
        colours_.fill(bone_colour);
        for (const Tissue& tissue : tissues)
            colours_[tissue.label] =
                glm::dvec3(tissue.colour_rgb[0], tissue.colour_rgb[1], tissue.colour_rgb[2]);
        light_ = glm::normalize(-view.direction + 0.6 * view.up - 0.5 * right());
    }

    glm::dvec3 right() const { return glm::cross(view_.direction, view_.up); }

    glm::dvec3 colour(const glm::dvec3& place_mm) {
        const BoneRay ray{to_voxel_coordinates(bone_.grid(), place_mm), view_.direction};
        RaySpan span = span_within(ray, bone_.grid());
        if (view_.is_section) span.from = std::max(span.from, 0.0);
        if (span.is_empty()) return paper;
        const glm::dvec3 first = ray.at(span.from + 1e-6);
        if (view_.is_section && span.from == 0.0 && probe_.between(first) > BoneSampler::surface_fraction)
            return 0.92 * tissue_colour(first);
        const auto hit = probe_.first_surface(ray, span, [](double) { return true; });
        return hit ? lit(ray, *hit) : paper;
    }

  private:
    glm::dvec3 lit(const BoneRay& ray, double t) {
        const glm::dvec3 place = ray.at(t);
        glm::dvec3 gradient(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = 1.0;
            // Over four voxels: a voxel alone shows as a terrace.
            gradient[axis] = probe_.between(place - step) - probe_.between(place + step) +
                             probe_.between(place - 2.0 * step) - probe_.between(place + 2.0 * step);
        }
        const double length = glm::length(gradient);
        const glm::dvec3 normal = length > 0.0 ? gradient / length : -view_.direction;
        const double diffuse = std::max(0.0, glm::dot(normal, light_));
        return (0.28 + 0.72 * diffuse) * tissue_colour(place + 0.6 * view_.direction);
    }

    glm::dvec3 tissue_colour(const glm::dvec3& place) const {
        const glm::ivec3 voxel =
            glm::clamp(glm::ivec3(glm::floor(place + 0.5)), glm::ivec3(0), bone_.grid().size_voxels - 1);
        return colours_[bone_.tissue_at(voxel)];
    }

    const Bone& bone_;
    const BoneView& view_;
    BoneSampler probe_;
    std::array<glm::dvec3, 256> colours_;
    glm::dvec3 light_{0.0};
};

}  // namespace

RgbPicture picture_of(const Bone& bone, std::span<const Tissue> tissues, const BoneView& view, int size_px) {
    View seen(bone, tissues, view);
    RgbPicture picture{.size_px = size_px, .rgb = {}};
    picture.rgb.reserve(static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px) * 3);
    const int rays = size_px * rays_per_pixel_edge;
    const auto offset_mm = [&](int ray) {
        return view.half_width_mm * ((2.0 * ray + 1.0) / static_cast<double>(rays) - 1.0);
    };
    for (int row = 0; row < size_px; ++row)
        for (int column = 0; column < size_px; ++column) {
            glm::dvec3 sum(0.0);
            for (int j = 0; j < rays_per_pixel_edge; ++j)
                for (int i = 0; i < rays_per_pixel_edge; ++i)
                    sum += seen.colour(view.centre_mm +
                                       offset_mm(column * rays_per_pixel_edge + i) * seen.right() -
                                       offset_mm(row * rays_per_pixel_edge + j) * view.up);
            sum /= rays_per_pixel_edge * rays_per_pixel_edge;
            for (int channel = 0; channel < 3; ++channel)
                picture.rgb.push_back(
                    static_cast<std::uint8_t>(std::lround(std::clamp(sum[channel], 0.0, 255.0))));
        }
    return picture;
}

}  // namespace osteomill
