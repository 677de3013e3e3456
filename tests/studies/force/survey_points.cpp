#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "haptic_server/milling/burr_frame.h"
#include "tests/studies/force/survey.h"

namespace osteomill::study {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A motion in the words of a surgeon: angles, not vectors.
struct Description {
    double diameter_mm = 5.0;
    double depth_mm = 1.0;
    double tilt_deg = 0.0;          ///< of the spindle from the surface's normal
    double azimuth_deg = 0.0;       ///< of the tilt, from the feed towards its left
    double surface_tilt_deg = 0.0;  ///< of the surface's normal from the lattice's z
    double surface_azimuth_deg = 0.0;
    double heading_deg = 0.0;  ///< of the feed, in the surface
    double feed_mm_per_s = 6.0;
    double rpm = 10'000.0;
    int edges = 6;
    double rate_hz = 100.0;
    std::optional<double> groove_mm{};
    bool plunges = false;  ///< the feed is straight into the surface
    double voxel_mm = 0.1;
};

glm::dvec3 direction(double tilt_deg, double azimuth_deg) {
    return {std::sin(tilt_deg * degree) * std::cos(azimuth_deg * degree),
            std::sin(tilt_deg * degree) * std::sin(azimuth_deg * degree), std::cos(tilt_deg * degree)};
}

SurveyPoint point_of(const std::string& group, const Description& d) {
    SurveyPoint point{.group = group, .tilt_deg = d.tilt_deg, .azimuth_deg = d.azimuth_deg};
    SteadyCase& c = point.motion;
    c.burr = {.diameter_mm = d.diameter_mm,
              .edges = d.edges,
              .spindle_rev_per_s = d.rpm / 60.0,
              .sense = SpindleSense::counter_clockwise};
    c.up = direction(d.surface_tilt_deg, d.surface_azimuth_deg);
    const glm::dmat3 surface = burr_frame(c.up);
    const auto along_surface = [&](double heading_deg) { return surface * direction(90.0, heading_deg); };
    c.velocity_mm_per_s = d.feed_mm_per_s * (d.plunges ? -c.up : along_surface(d.heading_deg));
    c.spindle_axis =
        glm::normalize(std::cos(d.tilt_deg * degree) * c.up +
                       std::sin(d.tilt_deg * degree) * along_surface(d.heading_deg + d.azimuth_deg));
    c.depth_mm = d.depth_mm;
    c.previous_groove_mm_higher = d.groove_mm;
    point.run.milling_rate_hz = d.rate_hz;
    point.run.voxel_mm = d.voxel_mm;

    const bool is_5_mm = d.diameter_mm == 5.0;
    const bool upright = d.tilt_deg == 0.0 && d.surface_tilt_deg == 0.0;
    if (is_5_mm && upright && !d.groove_mm && !d.plunges && d.depth_mm > 3.0 * point.run.voxel_mm)
        point.most_error = 0.01;
    if (is_5_mm) point.most_ripple = 0.02;
    c.name = fmt::format(
        "{} mm, {:.2f} deep{}, spindle {:.0f}/{:.0f} deg, surface {:.0f}/{:.0f} deg, heading {:.0f} deg, "
        "{}{:.3g} mm/s, "
        "{:.0f} rpm, {} edges, {:.0f} Hz{}",
        d.diameter_mm, d.depth_mm, d.groove_mm ? fmt::format(" after {:.2f} less", *d.groove_mm) : "",
        d.tilt_deg, d.azimuth_deg, d.surface_tilt_deg, d.surface_azimuth_deg, d.heading_deg,
        d.plunges ? "plunging " : "", d.feed_mm_per_s, d.rpm, d.edges, d.rate_hz,
        d.voxel_mm == 0.1 ? "" : fmt::format(", voxels of {} mm", d.voxel_mm));
    return point;
}

/// Collects points; `quick` takes every third value of a list, and always its ends.
class PointList {
  public:
    explicit PointList(bool quick) : quick_(quick) {}

    template <typename Value, std::size_t count, typename Visit>
    void each(const std::array<Value, count>& values, Visit&& visit) const {
        for (std::size_t i = 0; i < count; ++i)
            if (!quick_ || i % 3 == 0 || i + 1 == count) visit(values[i]);
    }

    void add(const std::string& group, const Description& d) { points_.push_back(point_of(group, d)); }
    bool quick() const { return quick_; }
    std::vector<SurveyPoint> take() && { return std::move(points_); }

  private:
    bool quick_;
    std::vector<SurveyPoint> points_;
};

constexpr std::array diameters_mm{5.0, 4.0, 3.0, 2.0, 1.5, 1.0};

void add_depths(PointList& list) {
    constexpr std::array shares_of_radius{0.1, 0.2, 0.35, 0.5, 0.7, 1.0};
    list.each(diameters_mm, [&](double diameter_mm) {
        list.add("depth", {.diameter_mm = diameter_mm, .depth_mm = 0.1});
        list.each(shares_of_radius, [&](double share) {
            const double depth_mm = 0.5 * diameter_mm * share;
            if (depth_mm > 0.1) list.add("depth", {.diameter_mm = diameter_mm, .depth_mm = depth_mm});
        });
    });
}

void add_tilts(PointList& list) {
    constexpr std::array tilts_deg{15.0, 30.0, 45.0, 60.0, 75.0, 90.0};
    constexpr std::array azimuths_deg{0.0, 90.0, 180.0, 270.0, 37.0};
    list.each(tilts_deg, [&](double tilt) {
        list.each(azimuths_deg, [&](double azimuth) {
            for (const double depth_mm : {0.5, 2.5})
                list.add("tilt", {.depth_mm = depth_mm, .tilt_deg = tilt, .azimuth_deg = azimuth});
            list.add("tilt", {.diameter_mm = 1.0, .depth_mm = 0.3, .tilt_deg = tilt, .azimuth_deg = azimuth});
        });
    });
}

/// Small burrs that lean forward and cut with their tip: the spindle's axis lies within the cut or near its
/// edge, the forces of its sides nearly cancel, and there are only 10 to 20 voxels to tell them apart; or
/// twice as many.
void add_tips(PointList& list) {
    constexpr std::array small_diameters_mm{2.0, 1.5, 1.0};
    constexpr std::array tilts_deg{30.0, 45.0, 60.0, 75.0};
    const auto tip = [](double diameter_mm, double share_of_radius, double tilt, double voxel_mm) {
        return Description{.diameter_mm = diameter_mm,
                           .depth_mm = 0.5 * diameter_mm * share_of_radius,
                           .tilt_deg = tilt,
                           .azimuth_deg = 180.0,
                           .voxel_mm = voxel_mm};
    };
    list.each(tilts_deg, [&](double tilt) {
        for (const double diameter_mm : small_diameters_mm) {
            for (const double share : {0.7, 0.85, 1.0}) list.add("tip", tip(diameter_mm, share, tilt, 0.1));
            for (const double share : {0.6, 0.7, 0.85, 1.0})
                list.add("fine tip", tip(diameter_mm, share, tilt, 0.05));
        }
    });
}

/// The bone's face passes the spindle's axis within a voxel: all of the chip's edge is where the force of a
/// voxel depends most on its place. Along the lattice and aslant.
void add_tips_at_the_face(PointList& list) {
    constexpr std::array tilts_deg{30.0, 45.0, 60.0, 75.0};
    constexpr std::array azimuths_deg{110.0, 145.0, 180.0, 257.0};
    const auto add = [&](double diameter_mm, double tilt, double azimuth, double voxels_inside) {
        const double depth_mm = 0.5 * diameter_mm * (1.0 - std::cos(tilt * degree)) +
                                0.1 * voxels_inside * std::sin(tilt * degree);
        if (depth_mm < 0.1) return;
        const Description d{
            .diameter_mm = diameter_mm, .depth_mm = depth_mm, .tilt_deg = tilt, .azimuth_deg = azimuth};
        list.add("tip at the face", d);
        Description aslant = d;
        aslant.surface_tilt_deg = 139.0;
        aslant.surface_azimuth_deg = 206.0;
        aslant.heading_deg = 20.0;
        list.add("tip at the face", aslant);
    };
    list.each(tilts_deg, [&](double tilt) {
        list.each(azimuths_deg, [&](double azimuth) {
            for (const double diameter_mm : {5.0, 2.0, 1.5, 1.0})
                for (const double voxels_inside : {-1.0, 0.0, 1.0})
                    add(diameter_mm, tilt, azimuth, voxels_inside);
        });
    });
}

void add_surfaces(PointList& list) {
    struct Orientation {
        double tilt_deg;
        double azimuth_deg;
    };
    constexpr std::array orientations{Orientation{5, 20},    Orientation{15, 0},  Orientation{30, 65},
                                      Orientation{45, 0},    Orientation{45, 45}, Orientation{54.7356, 45},
                                      Orientation{70, 110},  Orientation{90, 30}, Orientation{90, 45},
                                      Orientation{135, 200}, Orientation{180, 0}};
    list.each(orientations, [&](const Orientation& o) {
        for (const double depth_mm : {0.1, 0.3, 1.0, 2.5})
            list.add(
                "surface",
                {.depth_mm = depth_mm, .surface_tilt_deg = o.tilt_deg, .surface_azimuth_deg = o.azimuth_deg});
        for (const double depth_mm : {0.1, 0.3})
            list.add("surface", {.diameter_mm = 1.0,
                                 .depth_mm = depth_mm,
                                 .surface_tilt_deg = o.tilt_deg,
                                 .surface_azimuth_deg = o.azimuth_deg});
    });
}

void add_second_passes(PointList& list) {
    constexpr std::array grooves_mm{0.05, 0.1, 0.2, 0.3};
    list.each(grooves_mm, [&](double groove_mm) {
        for (const double depth_mm : {0.5, 1.0, 2.5})
            for (const double tilt_deg : {0.0, 45.0})
                list.add("second pass", {.depth_mm = depth_mm, .tilt_deg = tilt_deg, .groove_mm = groove_mm});
        list.add(
            "second pass",
            {.depth_mm = 1.0, .surface_tilt_deg = 30.0, .surface_azimuth_deg = 20.0, .groove_mm = groove_mm});
        list.add("second pass", {.depth_mm = 1.0, .heading_deg = 33.0, .groove_mm = groove_mm});
        // So slow that a voxel loses few of its 255 steps at a time.
        for (const double feed_mm_per_s : {0.5, 2.0})
            list.add("slow second pass", {.feed_mm_per_s = feed_mm_per_s, .groove_mm = groove_mm});
        list.add("second pass", {.diameter_mm = 1.0, .depth_mm = 0.5, .groove_mm = groove_mm});
    });
}

void add_headings_and_feeds(PointList& list) {
    constexpr std::array headings_deg{10.0, 20.0, 30.0, 45.0, 60.0, 90.0};
    list.each(headings_deg, [&](double heading) { list.add("heading", {.heading_deg = heading}); });
    constexpr std::array feeds_mm_per_s{0.5, 1.0, 2.0, 6.0, 12.0, 25.0, 50.0};
    list.each(feeds_mm_per_s, [&](double feed) {
        for (const double heading : {0.0, 33.0})
            list.add("feed", {.heading_deg = heading, .feed_mm_per_s = feed});
        list.add("feed", {.tilt_deg = 45.0, .azimuth_deg = 90.0, .feed_mm_per_s = feed});
        list.add("feed", {.diameter_mm = 1.0, .depth_mm = 0.3, .feed_mm_per_s = feed});
    });
}

void add_spindles(PointList& list) {
    constexpr std::array speeds_rpm{10'000.0, 20'000.0, 40'000.0, 80'000.0};
    list.each(speeds_rpm, [&](double rpm) { list.add("rpm", {.rpm = rpm}); });
    constexpr std::array edges{2, 3, 6, 8, 12};
    list.each(edges, [&](int n) { list.add("edges", {.edges = n}); });
}

void add_plunges(PointList& list) {
    list.each(diameters_mm, [&](double diameter_mm) {
        list.add("plunge", {.diameter_mm = diameter_mm,
                            .depth_mm = 0.5 * diameter_mm,
                            .feed_mm_per_s = 2.0,
                            .plunges = true});
        list.add("plunge", {.diameter_mm = diameter_mm,
                            .depth_mm = 0.5 * diameter_mm,
                            .tilt_deg = 30.0,
                            .feed_mm_per_s = 2.0,
                            .plunges = true});
    });
}

void add_rates(PointList& list) {
    constexpr std::array rates_hz{100.0, 200.0, 500.0, 1000.0, 3000.0, 10'000.0};
    list.each(rates_hz, [&](double rate) {
        list.add("rate", {.rate_hz = rate});
        list.add(
            "rate",
            {.depth_mm = 0.5, .tilt_deg = 45.0, .azimuth_deg = 90.0, .feed_mm_per_s = 25.0, .rate_hz = rate});
        list.add("rate",
                 {.depth_mm = 1.0, .surface_tilt_deg = 30.0, .surface_azimuth_deg = 20.0, .rate_hz = rate});
        list.add("rate", {.diameter_mm = 1.0, .depth_mm = 0.3, .rate_hz = rate});
    });
}

/// Everything at once. Evenly spread: x_n = frac(1/2 + n / phi^k), phi the root of phi^(d+1) = phi + 1
/// (Roberts 2018, The unreasonable effectiveness of quasirandom sequences).
void add_mixed(PointList& list) {
    constexpr int dimensions = 10;
    double phi = 2.0;
    for (int i = 0; i < 60; ++i) phi = std::pow(1.0 + phi, 1.0 / (dimensions + 1));
    const int count = list.quick() ? 24 : 120;
    for (int n = 1; n <= count; ++n) {
        const auto share = [&](int k) {
            const double x = 0.5 + n * std::pow(phi, -(k + 1));
            return x - std::floor(x);
        };
        const auto between = [&](int k, double low, double high) { return low + (high - low) * share(k); };
        const auto log_between = [&](int k, double low, double high) {
            return low * std::pow(high / low, share(k));
        };
        const double diameter_mm = diameters_mm[static_cast<std::size_t>(share(0) * diameters_mm.size())];
        Description d{.diameter_mm = diameter_mm,
                      .depth_mm = log_between(1, 0.1, 0.5 * diameter_mm),
                      .tilt_deg = between(2, 0.0, 90.0),
                      .azimuth_deg = between(3, 0.0, 360.0),
                      .surface_tilt_deg = std::acos(between(4, -1.0, 1.0)) / degree,
                      .surface_azimuth_deg = between(5, 0.0, 360.0),
                      .heading_deg = between(6, 0.0, 360.0),
                      .feed_mm_per_s = log_between(7, 0.5, 50.0),
                      .rpm = log_between(8, 10'000.0, 80'000.0)};
        if (share(9) > 0.75 && d.depth_mm > 0.4) d.groove_mm = between(9, -0.7, 0.3);
        list.add("mixed", d);
    }
}

}  // namespace

std::vector<SurveyPoint> survey_points(bool quick) {
    PointList list(quick);
    add_depths(list);
    add_tilts(list);
    add_tips(list);
    add_tips_at_the_face(list);
    add_surfaces(list);
    add_second_passes(list);
    add_headings_and_feeds(list);
    add_spindles(list);
    add_plunges(list);
    add_rates(list);
    add_mixed(list);
    return std::move(list).take();
}

}  // namespace osteomill::study
