#include "studies/force/random_motions.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "common/scene/burr.h"

namespace osteomill::study {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Numbers from a seed. The distributions of the standard library differ from one to the next, so these are
/// made of the generator's bits, which do not.
class Draw {
  public:
    explicit Draw(std::uint64_t seed) : bits_(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1p-53;
    }
    /// Evenly in its logarithm.
    double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    bool one_in(double count) { return uniform(0.0, count) < 1.0; }
    /// Evenly over the sphere.
    glm::dvec3 direction() {
        const double z = uniform(-1.0, 1.0);
        const double angle = uniform(0.0, 2.0 * std::numbers::pi);
        const double across = std::sqrt(1.0 - z * z);
        return {across * std::cos(angle), across * std::sin(angle), z};
    }

  private:
    std::mt19937_64 bits_;
};

RandomMotion draw_motion(Draw& draw, double voxel_mm) {
    RandomMotion drawn;
    SteadyCase& c = drawn.motion;
    c.burr = {.diameter_mm = draw.uniform(1.0, 5.0),
              .edges = static_cast<int>(draw.uniform(4.0, 13.0)),
              .spindle_rev_per_s = draw.uniform(5'000.0, 80'000.0) / 60.0,
              .sense = draw.one_in(2.0) ? SpindleSense::clockwise : SpindleSense::counter_clockwise};
    c.up = draw.direction();
    c.depth_mm = draw.uniform(voxel_mm, c.burr.radius_mm());
    const double feed_mm_per_s = draw.logarithmic(0.2, 60.0);
    const double heading_deg = draw.uniform(0.0, 360.0);
    drawn.tilt_deg = draw.uniform(0.0, 70.0);
    drawn.azimuth_deg = draw.uniform(0.0, 360.0);
    drawn.dives = draw.one_in(3.0);

    const glm::dmat3 surface = burr_frame(c.up);
    const auto along_surface = [&](double angle_deg) {
        return surface * glm::dvec3(std::cos(angle_deg * degree), std::sin(angle_deg * degree), 0.0);
    };
    const double dive_deg = drawn.dives ? draw.uniform(5.0, 90.0) : 0.0;
    c.velocity_mm_per_s = feed_mm_per_s * (std::cos(dive_deg * degree) * along_surface(heading_deg) -
                                           std::sin(dive_deg * degree) * c.up);
    c.spindle_axis =
        glm::normalize(std::cos(drawn.tilt_deg * degree) * c.up +
                       std::sin(drawn.tilt_deg * degree) * along_surface(heading_deg + drawn.azimuth_deg));
    if (!drawn.dives && draw.one_in(3.0))
        c.previous_groove_mm_higher = draw.uniform(0.5 * voxel_mm, c.depth_mm);
    drawn.run = {.voxel_mm = voxel_mm, .milling_rate_hz = draw.one_in(2.0) ? 100.0 : 1000.0};
    c.name = fmt::format(
        "{:.2f} mm {}, {:.2f} deep{}, spindle {:.0f}/{:.0f} deg, up {:.3f} {:.3f} {:.3f}, {}{:.3g} mm/s, "
        "{:.0f} rpm, {} edges, {:.0f} Hz",
        c.burr.diameter_mm, c.burr.sense == SpindleSense::clockwise ? "clockwise" : "counter-clockwise",
        c.depth_mm,
        c.previous_groove_mm_higher ? fmt::format(" after {:.2f} less", *c.previous_groove_mm_higher) : "",
        drawn.tilt_deg, drawn.azimuth_deg, c.up.x, c.up.y, c.up.z,
        drawn.dives ? fmt::format("diving at {:.0f} deg ", dive_deg) : "", feed_mm_per_s,
        60.0 * c.burr.spindle_rev_per_s, c.burr.edges, drawn.run.milling_rate_hz);
    return drawn;
}

/// Mean of what `of_case` says of the burr at each depth of the path.
template <typename OfCase>
auto mean_over_path(const RandomMotion& drawn, OfCase&& of_case) {
    if (!drawn.dives) return of_case(drawn.motion);
    // By Gauss's five points.
    constexpr std::array<double, 5> points{0.046910077030668, 0.230765344947158, 0.5, 0.769234655052841,
                                           0.953089922969332};
    constexpr std::array<double, 5> weights{0.118463442528095, 0.239314335249683, 0.284444444444444,
                                            0.239314335249683, 0.118463442528095};
    const SteadyPath path = path_of(drawn.motion, drawn.run);
    const double depth_at_start_mm = above_lowest_mm(drawn.motion) - glm::dot(path.start_mm, drawn.motion.up);
    const double deeper_mm = glm::dot(path.start_mm - path.end_mm, drawn.motion.up);
    decltype(of_case(drawn.motion)) mean(0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        SteadyCase c = drawn.motion;
        c.depth_mm = depth_at_start_mm + points[i] * deeper_mm;
        mean += weights[i] * of_case(c);
    }
    return mean;
}

}  // namespace

glm::dvec3 reference_over_path_n(const RandomMotion& drawn) {
    return mean_over_path(
        drawn, [](const SteadyCase& c) { return mean_reference_force_n(motion_of(c), bone_of(c)); });
}

double reference_parts_over_path_n(const RandomMotion& drawn) {
    return mean_over_path(
        drawn, [](const SteadyCase& c) { return mean_reference_parts_n(motion_of(c), bone_of(c)); });
}

std::vector<RandomMotion> random_motions(int count, std::uint64_t seed, double voxel_mm) {
    Draw draw(seed);
    std::vector<RandomMotion> motions;
    for (int i = 0; i < count; ++i) motions.push_back(draw_motion(draw, voxel_mm));
    return motions;
}

void set_depth(std::vector<RandomMotion>& motions, double depth_mm) {
    for (RandomMotion& drawn : motions) {
        drawn.motion.depth_mm = depth_mm;
        drawn.motion.previous_groove_mm_higher.reset();
        drawn.motion.name += fmt::format(", all {:.3f} deep", depth_mm);
    }
}

void draw_edge_forces(std::vector<RandomMotion>& motions, std::uint64_t seed) {
    Draw draw(seed);
    for (RandomMotion& drawn : motions) {
        glm::dvec3& edge = drawn.motion.burr.edge_coefficients_n_per_mm;
        edge.x = draw.uniform(0.0, 1.0);
        edge.y = draw.uniform(0.0, 1.0);
        edge.z = draw.uniform(0.0, 0.2);
        drawn.motion.name += fmt::format(", edges {:.3f} {:.3f} {:.3f} N/mm", edge.x, edge.y, edge.z);
    }
}

void draw_heads(std::vector<RandomMotion>& motions, std::uint64_t seed) {
    Draw draw(seed);
    constexpr std::array shapes{HeadShape::cylinder, HeadShape::cone, HeadShape::barrel, HeadShape::pear};
    for (RandomMotion& drawn : motions) {
        Burr& burr = drawn.motion.burr;
        const HeadShape shape = shapes[static_cast<std::size_t>(draw.uniform(0.0, 4.0))];
        burr.head = usual_head(shape, burr.diameter_mm, burr.diameter_mm * draw.uniform(1.0, 3.0));
        const double end_mm = burr.diameter_mm * draw.uniform(0.4, 0.9);
        if (shape == HeadShape::cone) {
            burr.head.tip_diameter_mm = burr.diameter_mm;
            (draw.one_in(2.0) ? burr.head.tip_diameter_mm : burr.head.neck_diameter_mm) = end_mm;
        }
        drawn.motion.name += fmt::format(
            ", {} {:.2f} mm long, tip {:.2f}, neck {:.2f}", head_shape_names[static_cast<std::size_t>(shape)],
            burr.head.length_mm, burr.head.tip_diameter_mm, burr.head.neck_diameter_mm);
    }
}

}  // namespace osteomill::study
