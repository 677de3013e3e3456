#include "simulation/engagement/burr_patches.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "common/scene/burr_profile.h"
#include "simulation/engagement/engagement.h"

namespace osteomill {

namespace {

/// Interleaves the bits of a direction's eighths, so that neighbours in the list are neighbours on the
/// sphere.
unsigned order_on_sphere(const glm::dvec3& normal) {
    const glm::uvec3 eighth(glm::min(glm::floor(4.0 * (normal + 1.0)), glm::dvec3(7.0)));
    unsigned order = 0;
    for (unsigned bit = 0; bit < 3; ++bit)
        order |= (eighth.x >> bit & 1u) << (3 * bit) | (eighth.y >> bit & 1u) << (3 * bit + 1) |
                 (eighth.z >> bit & 1u) << (3 * bit + 2);
    return order;
}

/// A ring's forces across the spindle cancel if all of it touches: a plunge along the spindle feels none.
constexpr int patches_a_ring = 16;
constexpr int fewest_rings = 48;
constexpr int most_rings = static_cast<int>(Engagement::max_patches) / patches_a_ring;
/// A ring of patches, burr axes.
struct Ring {
    double out;  ///< of the normal
    double up;
    double patch_area_mm2;
    double mean_per_r;  ///< 1/r, 1/mm
    double beside_out_mm = 0.0;
    double beside_up_mm = 0.0;
};

void add_ring(const Burr& burr, const Ring& ring, double half_turn, std::vector<BurrPatch>& patches) {
    const double width_by_turn_mm = ring.patch_area_mm2 * ring.mean_per_r / (2.0 * std::numbers::pi);
    for (int i = 0; i < patches_a_ring; ++i) {
        const double psi = 2.0 * std::numbers::pi * (i + half_turn) / patches_a_ring;
        const glm::dvec3 outward(std::cos(psi), std::sin(psi), 0.0);
        const glm::dvec3 normal(outward.x * ring.out, outward.y * ring.out, ring.up);
        const glm::dvec3 e_psi(-std::sin(psi), std::cos(psi), 0.0);
        const glm::dvec3 e_kappa(outward.x * -ring.up, outward.y * -ring.up, ring.out);
        const auto along_axes = [&](const glm::dvec3& c) {
            return burr.sigma() * c.x * e_psi + c.y * normal + c.z * e_kappa;
        };
        patches.push_back(
            {.normal = normal,
             .beside_mm = ring.beside_out_mm * outward + glm::dvec3(0.0, 0.0, ring.beside_up_mm),
             .cutting_n_s_per_mm = -along_axes(burr.cutting_coefficients_n_per_mm2) * ring.patch_area_mm2 *
                                   ring.mean_per_r / (2.0 * std::numbers::pi * burr.spindle_rev_per_s),
             .edge_n = -along_axes(burr.edge_coefficients_n_per_mm) * (width_by_turn_mm * burr.edges),
             .area_mm2 = ring.patch_area_mm2});
    }
}

Ring ball_ring(double radius_mm, int ring, int rings) {
    // Equal in angle, so that a shallow cut at the tip meets several.
    const double bottom = -std::cos(std::numbers::pi * ring / rings);
    const double top = -std::cos(std::numbers::pi * (ring + 1) / rings);
    const double z = 0.5 * (bottom + top);
    const double area_mm2 = 2.0 * std::numbers::pi * radius_mm * radius_mm * (top - bottom) / patches_a_ring;
    return {.out = std::sqrt(1.0 - z * z),
            .up = z,
            .patch_area_mm2 = area_mm2,
            .mean_per_r = (std::asin(top) - std::asin(bottom)) / (top - bottom) / radius_mm};
}

/// Ends of the rings along the outline. A ring takes an equal share of the mean of two measures: the length
/// of the outline and the turn of its normal.
std::vector<double> ring_ends(const BurrProfile& profile, int rings) {
    constexpr int steps = 4096;
    std::vector<double> share{0.0};
    OutlinePoint last = profile.outline_at(0.0);
    for (int i = 1; i <= steps; ++i) {
        const OutlinePoint next = profile.outline_at(profile.outline_length() * i / steps);
        const double turn =
            std::atan2(last.out * next.up - last.up * next.out, last.out * next.out + last.up * next.up);
        share.push_back(share.back() + 0.5 / steps + 0.5 * turn / std::numbers::pi);
        last = next;
    }
    std::vector<double> ends{0.0};
    std::size_t i = 1;
    for (int ring = 1; ring < rings; ++ring) {
        const double wanted = share.back() * ring / rings;
        while (share[i] < wanted) ++i;
        const double into = (wanted - share[i - 1]) / (share[i] - share[i - 1]);
        ends.push_back(profile.outline_length() * (static_cast<double>(i) - 1.0 + into) / steps);
    }
    ends.push_back(profile.outline_length());
    return ends;
}

Ring head_ring(const BurrProfile& profile, double radius_mm, double from, double to) {
    const OutlinePoint middle = profile.outline_at(0.5 * (from + to));
    return {.out = middle.out,
            .up = middle.up,
            .patch_area_mm2 = 2.0 * std::numbers::pi * middle.radius * (to - from) / patches_a_ring,
            .mean_per_r = 1.0 / middle.radius,
            .beside_out_mm = middle.radius - radius_mm * middle.out,
            .beside_up_mm = middle.height - radius_mm * middle.up};
}

double area_of(const BurrProfile& profile) {
    constexpr int steps = 1000;
    double area = 0.0;
    for (int i = 0; i < steps; ++i)
        area += profile.outline_at(profile.outline_length() * (i + 0.5) / steps).radius;
    return area * 2.0 * std::numbers::pi * profile.outline_length() / steps;
}

int ring_count(double area_mm2, double spacing_mm) {
    const double wanted_edge_mm = 1.5 * spacing_mm;
    return std::clamp(
        static_cast<int>(std::lround(area_mm2 / (wanted_edge_mm * wanted_edge_mm) / patches_a_ring)),
        fewest_rings, most_rings);
}

}  // namespace

std::vector<BurrPatch> burr_patches(const Burr& burr, double spacing_mm) {
    const double radius_mm = burr.radius_mm();
    std::vector<BurrPatch> patches;
    const auto add = [&](const Ring& ring, int number) {
        add_ring(burr, ring, number % 2 == 0 ? 0.0 : 0.5, patches);
    };
    if (burr.is_ball()) {
        const int rings = ring_count(4.0 * std::numbers::pi * radius_mm * radius_mm, spacing_mm);
        for (int ring = 0; ring < rings; ++ring) add(ball_ring(radius_mm, ring, rings), ring);
    } else {
        const BurrProfile profile(burr.head, burr.diameter_mm);
        const std::vector<double> ends = ring_ends(profile, ring_count(area_of(profile), spacing_mm));
        for (std::size_t ring = 0; ring + 1 < ends.size(); ++ring)
            add(head_ring(profile, radius_mm, ends[ring], ends[ring + 1]), static_cast<int>(ring));
    }
    // Samples of neighbours read the same bricks.
    std::stable_sort(patches.begin(), patches.end(), [](const BurrPatch& a, const BurrPatch& b) {
        return order_on_sphere(a.normal) < order_on_sphere(b.normal);
    });
    return patches;
}

}  // namespace osteomill
