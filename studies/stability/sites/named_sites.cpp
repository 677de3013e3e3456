#include "studies/stability/sites/named_sites.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace osteomill::study {
namespace {

/// Bone reaches so far beyond the burr's motion.
constexpr double clear_mm = 2.0;
constexpr double lift_mm = 0.5;
/// Off the lattice by an odd share of a voxel, as a hand is.
constexpr glm::dvec3 shift_off_the_lattice_mm(0.031, 0.017, 0.0);

/// A motion from point to point at given speeds.
class Path {
  public:
    explicit Path(const glm::dvec3& start_mm) : at_mm_(start_mm + shift_off_the_lattice_mm) {
        add(0.0);
        wait(0.2);
    }
    Path& to(const glm::dvec3& to_mm, double speed_mm_per_s) {
        const glm::dvec3 end_mm = to_mm + shift_off_the_lattice_mm;
        const double takes_s = glm::distance(end_mm, at_mm_) / speed_mm_per_s;
        at_mm_ = end_mm;
        if (takes_s > 0.0) add(takes_s);
        return *this;
    }
    Path& wait(double takes_s) {
        add(takes_s);
        return *this;
    }
    Path& pedal(bool pedal) {
        motion_.back().pedal = pedal_ = pedal;
        return *this;
    }
    std::vector<Waypoint> motion() const { return motion_; }

  private:
    void add(double takes_s) {
        time_s_ += takes_s;
        motion_.push_back({.time_s = time_s_, .pose = {at_mm_, {0.0, 0.0, 1.0}}, .pedal = pedal_});
    }

    glm::dvec3 at_mm_;
    double time_s_ = 0.0;
    bool pedal_ = true;
    std::vector<Waypoint> motion_;
};

/// Bone where all of some half spaces meet.
template <typename... Distances>
double meeting(Distances... distances_mm) {
    return std::max({distances_mm...});
}

class Sites {
  public:
    explicit Sites(const Burr& burr)
        : burr_(burr),
          radius_mm_(burr.radius_mm()),
          depth_mm_(std::min(1.0, 0.4 * burr.diameter_mm)),
          feed_mm_per_s_(std::min(6.0, 0.024 * burr.spindle_rev_per_s)),
          plunge_mm_per_s_(std::min(4.0, 0.012 * burr.spindle_rev_per_s)) {}

    std::vector<Site> all() {
        breakthroughs();
        edges();
        corners();
        thin_walls();
        pilot_holes();
        own_tunnel();
        entering_and_leaving();
        tissue_borders();
        spindle_stops();
        reversals();
        return std::move(sites_);
    }

  private:
    /// Bone within `beside_mm` of the z axis, or of a path along x from `from_mm` to `to_mm`, and down to
    /// `below_mm`.
    void add(const char* kind, std::string name, double from_mm, double to_mm, double below_mm,
             std::function<double(const glm::dvec3&)> distance_mm, std::vector<Waypoint> motion,
             std::function<double(const glm::dvec3&)> relative_stiffness = {}) {
        const double beside_mm = radius_mm_ + clear_mm;
        sites_.push_back({.kind = kind,
                          .name = std::move(name),
                          .burr = burr_,
                          .shape = {.distance_mm = std::move(distance_mm),
                                    .low_mm = {from_mm - beside_mm, -beside_mm - 2.0, -below_mm},
                                    .high_mm = {to_mm + beside_mm, beside_mm + 2.0, 2.0},
                                    .relative_stiffness = std::move(relative_stiffness)},
                          .motion = std::move(motion)});
    }

    glm::dvec3 above(double x_mm, double y_mm) const { return {x_mm, y_mm, radius_mm_ + lift_mm}; }
    glm::dvec3 in(double x_mm, double y_mm) const { return {x_mm, y_mm, radius_mm_ - depth_mm_}; }

    /// Down to the depth, along, and up again.
    std::vector<Waypoint> pass(const glm::dvec2& from_mm, const glm::dvec2& to_mm) const {
        return Path(above(from_mm.x, from_mm.y))
            .to(in(from_mm.x, from_mm.y), plunge_mm_per_s_)
            .to(in(to_mm.x, to_mm.y), feed_mm_per_s_)
            .to(above(to_mm.x, to_mm.y), 4.0)
            .motion();
    }

    void breakthroughs() {
        const auto through = [&](double thickness_mm, double slope) {
            const double rim_mm = slope * radius_mm_;
            return Path({0.0, 0.0, radius_mm_ + lift_mm + rim_mm})
                .to({0.0, 0.0, -thickness_mm * std::sqrt(1.0 + slope * slope) - rim_mm - 0.8 * radius_mm_},
                    plunge_mm_per_s_)
                .to({0.0, 0.0, radius_mm_ + lift_mm + rim_mm}, 6.0)
                .motion();
        };
        for (const double thickness_mm : {0.3, 1.0, 2.0, 4.0}) {
            for (const double tilt_deg : {0.0, 15.0, 30.0}) {
                const double tilt = tilt_deg * std::numbers::pi / 180.0;
                const glm::dvec3 normal(std::sin(tilt), 0.0, std::cos(tilt));
                const auto plate = [=](const glm::dvec3& p) {
                    const double height_mm = glm::dot(p, normal);
                    return meeting(height_mm, -thickness_mm - height_mm);
                };
                add("breakthrough", fmt::format("plate of {} mm tilted by {}", thickness_mm, tilt_deg), 0.0,
                    0.0, thickness_mm + 2.0 * radius_mm_ + clear_mm, plate,
                    through(thickness_mm, std::tan(tilt)));
            }
            constexpr double curvature_mm = 60.0;
            const auto shell = [=](const glm::dvec3& p) {
                const double height_mm = glm::distance(p, {0.0, 0.0, -curvature_mm}) - curvature_mm;
                return meeting(height_mm, -thickness_mm - height_mm);
            };
            add("breakthrough", fmt::format("curved plate of {} mm", thickness_mm), 0.0, 0.0,
                thickness_mm + 2.0 * radius_mm_ + clear_mm, shell, through(thickness_mm, 0.0));
        }
    }

    void edges() {
        const auto quarter = [](const glm::dvec3& p) { return meeting(p.z, p.y); };
        for (const double side : {-1.0, 1.0})
            for (const double direction : {-1.0, 1.0}) {
                const double y_mm = side < 0.0 ? -0.6 * radius_mm_ : 0.3 * radius_mm_;
                add("edge",
                    fmt::format("{} the edge, along {}x", side < 0.0 ? "inside" : "outside",
                                direction < 0.0 ? '-' : '+'),
                    -4.0, 4.0, depth_mm_ + clear_mm, quarter,
                    pass({-4.0 * direction, y_mm}, {4.0 * direction, y_mm}));
            }
    }

    void corners() {
        const auto eighth = [](const glm::dvec3& p) { return meeting(p.z, p.y, p.x); };
        add("corner", "over the corner, outward", -3.0, 2.0, depth_mm_ + clear_mm, eighth,
            pass({-2.5, -2.5}, {2.0, 2.0}));
        add("corner", "over the corner, inward", -3.0, 2.0, depth_mm_ + clear_mm, eighth,
            pass({2.0, 2.0}, {-2.5, -2.5}));
    }

    void thin_walls() {
        for (const double thickness_mm : {0.3, 1.0}) {
            const auto wall = [=](const glm::dvec3& p) {
                return meeting(p.z, std::abs(p.y) - 0.5 * thickness_mm);
            };
            const double beside_mm = radius_mm_ + 1.0;
            for (const double direction : {-1.0, 1.0})
                add("thin wall",
                    fmt::format("through {} mm, along {}y", thickness_mm, direction < 0.0 ? '-' : '+'), 0.0,
                    0.0, depth_mm_ + clear_mm, wall,
                    pass({0.0, -direction * beside_mm}, {0.0, direction * beside_mm}));
            add("thin wall", fmt::format("along {} mm", thickness_mm), -3.0, 3.0, depth_mm_ + clear_mm, wall,
                pass({-3.0, 0.0}, {3.0, 0.0}));
        }
    }

    void pilot_holes() {
        for (const double share : {0.4, 0.8}) {
            const double hole_mm = share * radius_mm_;
            const auto block = [=](const glm::dvec3& p) {
                return meeting(p.z, hole_mm - std::sqrt(p.x * p.x + p.y * p.y));
            };
            add("pilot hole", fmt::format("a hole of {:.0f} % enlarged", 100.0 * share), 0.0, 0.0,
                3.0 + radius_mm_ + clear_mm, block,
                Path(above(0.0, 0.0))
                    .to({0.0, 0.0, radius_mm_ - 3.0}, plunge_mm_per_s_)
                    .to(above(0.0, 0.0), 6.0)
                    .motion());
        }
    }

    void own_tunnel() {
        const double deep_mm = radius_mm_ - burr_.diameter_mm;
        add(
            "own tunnel", "up, down and aside", 0.0, 0.0, burr_.diameter_mm + clear_mm + 1.0,
            [](const glm::dvec3& p) { return p.z; },
            Path(above(0.0, 0.0))
                .to({0.0, 0.0, deep_mm}, plunge_mm_per_s_)
                .to({0.0, 0.0, deep_mm + 1.0}, 4.0)
                .to({0.0, 0.0, deep_mm}, 4.0)
                .to({0.15, 0.0, deep_mm}, 1.0)
                .to({-0.15, 0.1, deep_mm}, 1.0)
                .to({0.0, 0.0, deep_mm + 1.0}, 4.0)
                .to(above(0.0, 0.0), 6.0)
                .motion());
    }

    void entering_and_leaving() {
        const double outside_mm = 2.0 + radius_mm_ + 0.5;
        const auto ridge = [](const glm::dvec3& p) { return meeting(p.z, std::abs(p.x) - 2.0); };
        for (const double direction : {-1.0, 1.0})
            add("entering and leaving",
                fmt::format("a block of 4 mm, along {}x", direction < 0.0 ? '-' : '+'), -4.0, 4.0,
                depth_mm_ + clear_mm, ridge,
                pass({-direction * outside_mm, 0.0}, {direction * outside_mm, 0.0}));
    }

    void tissue_borders() {
        const auto block = [](const glm::dvec3& p) { return p.z; };
        for (const double direction : {-1.0, 1.0})
            add("tissue border", direction > 0.0 ? "from hard into soft" : "from soft into hard", -3.0, 3.0,
                depth_mm_ + clear_mm, block, pass({-3.0 * direction, 0.0}, {3.0 * direction, 0.0}),
                [](const glm::dvec3& p) { return p.x < 0.0 ? 1.0 : 0.3; });
    }

    void spindle_stops() {
        add(
            "spindle", "stopped and started under load", -3.0, 3.0, depth_mm_ + clear_mm,
            [](const glm::dvec3& p) { return p.z; },
            Path(above(-3.0, 0.0))
                .to(in(-3.0, 0.0), plunge_mm_per_s_)
                .to(in(0.0, 0.0), feed_mm_per_s_)
                .pedal(false)
                .wait(0.3)
                .pedal(true)
                .to(in(3.0, 0.0), feed_mm_per_s_)
                .to(above(3.0, 0.0), 4.0)
                .motion());
    }

    void reversals() {
        Path path(above(-2.0, 0.0));
        path.to(in(-2.0, 0.0), plunge_mm_per_s_);
        for (int i = 0; i < 2; ++i) path.to(in(2.0, 0.0), feed_mm_per_s_).to(in(-2.0, 0.0), feed_mm_per_s_);
        add(
            "reversal", "there and back in a slot", -2.0, 2.0, depth_mm_ + clear_mm,
            [](const glm::dvec3& p) { return p.z; }, path.to(above(-2.0, 0.0), 4.0).motion());
    }

    Burr burr_;
    double radius_mm_;
    double depth_mm_;
    double feed_mm_per_s_;
    double plunge_mm_per_s_;
    std::vector<Site> sites_;
};

}  // namespace

std::vector<Site> named_sites(const Burr& burr) {
    return Sites(burr).all();
}

std::vector<Site> tilts_in_holes() {
    const Burr burr{.name = "with a shank",
                    .diameter_mm = 2.0,
                    .spindle_rev_per_s = 10'000.0 / 60.0,
                    .shank = {{0.9, 0.4}, {8.0, 0.5}, {10.0, 1.2}, {24.0, 1.2}, {25.0, 6.0}, {80.0, 8.0}}};
    constexpr double depth_mm = 10.5;
    const glm::dvec3 bottom_mm = glm::dvec3(0.0, 0.0, -depth_mm) + shift_off_the_lattice_mm;
    const glm::dvec3 in_air_mm = bottom_mm + glm::dvec3(0.0, 0.0, 2.5);
    std::vector<Site> sites;
    for (const double hole_mm : {2.05, 2.1, 2.2, 2.3, 2.4})
        for (const double tilt_deg : {4.0, 5.5, 7.0, 8.5, 10.0}) {
            const auto leaning = [=](double azimuth) {
                const double tilt = tilt_deg * std::numbers::pi / 180.0;
                return glm::dvec3(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth),
                                  std::cos(tilt));
            };
            const glm::dvec3 upright(0.0, 0.0, 1.0);
            std::vector<Waypoint> motion;
            const auto add = [&](double time_s, const glm::dvec3& at_mm, const glm::dvec3& axis) {
                motion.push_back({.time_s = time_s, .pose = {at_mm, axis}, .pedal = true});
            };
            add(0.0, in_air_mm, upright);
            add(0.2, in_air_mm, upright);
            add(0.8, bottom_mm, upright);
            add(1.2, bottom_mm, leaning(0.0));
            add(2.0, bottom_mm, leaning(0.87 * std::numbers::pi));
            add(2.4, bottom_mm, upright);
            add(2.8, in_air_mm, upright);
            const auto block = [=](const glm::dvec3& p) {
                const glm::dvec3 in_hole_mm = p - shift_off_the_lattice_mm;
                const double aside_mm = 0.5 * hole_mm - std::hypot(in_hole_mm.x, in_hole_mm.y);
                return meeting(p.z, std::min(aside_mm, p.z + depth_mm + 1.5));
            };
            sites.push_back({.kind = "tilted in a hole",
                             .name = fmt::format("tilted by {} in a hole of {} mm", tilt_deg, hole_mm),
                             .burr = burr,
                             .shape = {.distance_mm = block,
                                       .low_mm = {-4.0, -4.0, -depth_mm - 3.0},
                                       .high_mm = {4.0, 4.0, 0.5}},
                             .motion = std::move(motion)});
        }
    return sites;
}

}  // namespace osteomill::study
