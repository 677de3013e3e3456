#include "render_client/volume/passes/detail_control.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace osteomill {

namespace {

constexpr std::array<double, 11> divisors{1.0, 1.25, 1.5, 1.75, 2.0, 2.25, 2.5, 2.75, 3.0, 3.5, 4.0};
constexpr double coarsest_whole = 4.0;
constexpr double coarsest_parts = 2.0;
constexpr double least_part_for_drawing = 0.25;
constexpr double frames_in_one_at_rest = 3.0;
constexpr double least_part_at_rest = 0.5;
constexpr double rise_a_measurement = 0.5;
constexpr double fall_a_measurement = 0.2;
constexpr double full_enough_to_refine = 0.8;
constexpr double assumed_s_per_px = 1e-6;

/// The estimate follows a rise faster than a fall; it begins with the first measurement.
double followed(double known, double measured) {
    if (known == 0.0) return measured;
    return known + (measured > known ? rise_a_measurement : fall_a_measurement) * (measured - known);
}

/// The finest divisor at which so many pixels fit.
double finest(std::int64_t pixels, double affordable) {
    const auto* fits = std::find_if(divisors.begin(), divisors.end(), [&](double divisor) {
        return static_cast<double>(pixels) <= affordable * divisor * divisor;
    });
    return fits != divisors.end() ? *fits : divisors.back();
}

}  // namespace

DetailControl::DetailControl(double frame_s) : frame_s_(frame_s) {
    if (!(frame_s > 0.0)) throw std::invalid_argument("a frame must be given some time");
}

void DetailControl::drew(Extent extent, std::int64_t pixels, double took_s) {
    if (pixels <= 0 || !(took_s > 0.0)) return;
    const double measured = took_s / static_cast<double>(pixels);
    double& s_per_px = (extent == Extent::whole ? whole_ : parts_).s_per_px;
    // The first part may show nothing but background, and must not stand for the cost of all parts.
    if (extent == Extent::parts && s_per_px == 0.0) s_per_px = std::max(whole_.s_per_px, measured);
    s_per_px = followed(s_per_px, measured);
}

void DetailControl::frame_took(double frame_s, double drawing_s) {
    rest_s_ = followed(rest_s_, std::max(frame_s - drawing_s, 0.0));
}

void DetailControl::forget_costs() {
    whole_.s_per_px = parts_.s_per_px = 0.0;
}

std::int64_t DetailControl::affordable_pixels(Extent extent) const {
    return pixels_in(extent, std::max(frame_s_ - rest_s_, least_part_for_drawing * frame_s_));
}

std::int64_t DetailControl::affordable_pixels_at_rest() const {
    const double frame_s = frames_in_one_at_rest * frame_s_;
    return pixels_in(Extent::parts, std::max(frame_s - rest_s_, least_part_at_rest * frame_s));
}

std::int64_t DetailControl::pixels_in(Extent extent, double room_s) const {
    const bool parts_known = extent == Extent::parts && parts_.s_per_px > 0.0;
    const double known_s_per_px = parts_known ? parts_.s_per_px : whole_.s_per_px;
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    const double affordable = room_s / (known_s_per_px > 0.0 ? known_s_per_px : assumed_s_per_px);
    return affordable < static_cast<double>(most) ? static_cast<std::int64_t>(affordable) : most;
}

double DetailControl::divisor_for(Extent extent, std::int64_t pixels) {
    const auto affordable = static_cast<double>(affordable_pixels(extent));
    const double needed = finest(pixels, affordable);
    const double with_reserve = finest(pixels, full_enough_to_refine * affordable);
    double& divisor = (extent == Extent::whole ? whole_ : parts_).divisor;
    divisor = std::clamp(divisor, needed, with_reserve);
    return std::min(divisor, extent == Extent::whole ? coarsest_whole : coarsest_parts);
}

}  // namespace osteomill
