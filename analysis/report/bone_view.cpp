#include "analysis/report/bone_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace osteomill {

namespace {

constexpr int rays_per_pixel_edge = 2;
constexpr double solid = 127.5;  // of 255: half a voxel
const glm::dvec3 paper(255.0);
const glm::dvec3 bone_colour(226.0, 216.0, 198.0);

/// Fractions along a ray: the brick of the last look-up is remembered.
class FractionProbe {
  public:
    explicit FractionProbe(const Bone& bone) : bone_(bone) {}

    /// Of a voxel anywhere.
    double at(const glm::ivec3& voxel) {
        if (!contains(bone_.grid(), voxel)) return 0.0;
        find(voxel / brick_edge_voxels);
        return slot_ == BoneContent::no_slot ? 0.0 : bone_.fractions(slot_)[offset_in_brick(voxel)];
    }
    /// Of a place in voxel coordinates, linear between the centres of voxels.
    double between(const glm::dvec3& place) {
        const glm::dvec3 low = glm::floor(place);
        const glm::dvec3 part = place - low;
        const glm::ivec3 voxel(low);
        double sum = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::dvec3 share(step.x == 1 ? part.x : 1.0 - part.x, step.y == 1 ? part.y : 1.0 - part.y,
                                   step.z == 1 ? part.z : 1.0 - part.z);
            sum += share.x * share.y * share.z * at(voxel + step);
        }
        return sum;
    }
    bool has_bone(const glm::ivec3& brick) {
        find(brick);
        return slot_ != BoneContent::no_slot;
    }

  private:
    void find(const glm::ivec3& brick) {
        if (brick == brick_) return;
        brick_ = brick;
        slot_ = bone_.slot(brick);
    }

    const Bone& bone_;
    glm::ivec3 brick_{-1};
    std::int32_t slot_ = BoneContent::no_slot;
};

/// In voxel coordinates; one unit of `t` is a voxel.
struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;

    glm::dvec3 at(double t) const { return origin + t * direction; }
};

struct Span {
    double from;
    double to;
};

/// Where a ray is within a box; empty (from > to) where it passes.
Span within(const Ray& ray, const glm::dvec3& low, const glm::dvec3& high) {
    Span span{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const double slope = ray.direction[axis];
        if (std::abs(slope) < 1e-12) {
            if (ray.origin[axis] < low[axis] || ray.origin[axis] > high[axis]) return {1.0, 0.0};
            continue;
        }
        const double a = (low[axis] - ray.origin[axis]) / slope;
        const double b = (high[axis] - ray.origin[axis]) / slope;
        span.from = std::max(span.from, std::min(a, b));
        span.to = std::min(span.to, std::max(a, b));
    }
    return span;
}

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
        const Ray ray{to_voxel_coordinates(bone_.grid(), place_mm), view_.direction};
        Span span = within(ray, glm::dvec3(-0.5), glm::dvec3(bone_.grid().size_voxels) - 0.5);
        if (view_.is_section) span.from = std::max(span.from, 0.0);
        if (!(span.from < span.to)) return paper;
        const glm::dvec3 first = ray.at(span.from + 1e-6);
        if (view_.is_section && span.from == 0.0 && probe_.between(first) > solid)
            return 0.92 * tissue_colour(first);
        const auto hit = first_hit(ray, span);
        return hit ? lit(ray, *hit) : paper;
    }

  private:
    std::optional<double> first_hit(const Ray& ray, const Span& span) {
        constexpr double step = 0.5;
        for (double t = span.from + 1e-6; t <= span.to;) {
            const glm::ivec3 voxel = glm::ivec3(glm::floor(ray.at(t) + 0.5));
            if (!contains(bone_.grid(), voxel)) {
                t += step;
                continue;
            }
            const glm::ivec3 brick = voxel / brick_edge_voxels;
            if (!probe_.has_bone(brick)) {
                const glm::dvec3 low = glm::dvec3(brick * brick_edge_voxels) - 0.5;
                t = std::max(t, within(ray, low, low + double{brick_edge_voxels}).to) + 1e-6;
                continue;
            }
            if (probe_.at(voxel) > 0.0 && probe_.between(ray.at(t)) > solid) return refined(ray, t - step, t);
            t += step;
        }
        return std::nullopt;
    }

    double refined(const Ray& ray, double before, double in) {
        for (int i = 0; i < 5; ++i) {
            const double middle = 0.5 * (before + in);
            (probe_.between(ray.at(middle)) > solid ? in : before) = middle;
        }
        return in;
    }

    glm::dvec3 lit(const Ray& ray, double t) {
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
    FractionProbe probe_;
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
