// Difference of two colours by CIEDE2000, also for the colour-blind.
//
// The formula, with the names of Sharma, Wu and Dalal 2005, Color Res Appl 30:21. Colours as a dichromat sees
// them: Machado, Oliveira and Fernandes 2009, IEEE Trans Vis Comput Graph 15:1291, table 1 at severity 1.0,
// applied to linear sRGB.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace osteomill::testing {

using Srgb = std::array<std::uint8_t, 3>;

/// L*, a*, b*, of linear sRGB under D65.
inline glm::dvec3 lab_of_linear(const glm::dvec3& rgb) {
    const glm::dmat3 rows(0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339,
                          0.1191920, 0.9503041);
    const glm::dvec3 xyz = glm::transpose(rows) * rgb / glm::dvec3(0.95047, 1.0, 1.08883);
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    };
    return {116.0 * f(xyz.y) - 16.0, 500.0 * (f(xyz.x) - f(xyz.y)), 200.0 * (f(xyz.y) - f(xyz.z))};
}

inline double ciede2000(const glm::dvec3& lab1, const glm::dvec3& lab2) {
    const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180.0; };
    const auto pow7 = [](double c) { return std::pow(c, 7.0); };
    const double c_mean = 0.5 * (std::hypot(lab1.y, lab1.z) + std::hypot(lab2.y, lab2.z));
    const double g = 0.5 * (1.0 - std::sqrt(pow7(c_mean) / (pow7(c_mean) + pow7(25.0))));
    const double a1 = (1.0 + g) * lab1.y, a2 = (1.0 + g) * lab2.y;
    const double c1 = std::hypot(a1, lab1.z), c2 = std::hypot(a2, lab2.z);
    const auto hue = [](double b, double a) {
        const double degrees = a == 0.0 && b == 0.0 ? 0.0 : std::atan2(b, a) * 180.0 / std::numbers::pi;
        return degrees < 0.0 ? degrees + 360.0 : degrees;
    };
    const double h1 = hue(lab1.z, a1), h2 = hue(lab2.z, a2);
    const bool is_grey = c1 * c2 == 0.0;
    double dh = is_grey ? 0.0 : h2 - h1;
    if (dh > 180.0) dh -= 360.0;
    if (dh < -180.0) dh += 360.0;
    const double dl = lab2.x - lab1.x, dc = c2 - c1;
    const double dhh = 2.0 * std::sqrt(c1 * c2) * std::sin(radians(0.5 * dh));
    const double l = 0.5 * (lab1.x + lab2.x), c = 0.5 * (c1 + c2);
    double h = h1 + h2;
    if (!is_grey) h = 0.5 * (std::abs(h1 - h2) <= 180.0 ? h : h < 360.0 ? h + 360.0 : h - 360.0);
    const double t = 1.0 - 0.17 * std::cos(radians(h - 30.0)) + 0.24 * std::cos(radians(2.0 * h)) +
                     0.32 * std::cos(radians(3.0 * h + 6.0)) - 0.20 * std::cos(radians(4.0 * h - 63.0));
    const double theta = 30.0 * std::exp(-std::pow((h - 275.0) / 25.0, 2.0));
    const double rt = -std::sin(radians(2.0 * theta)) * 2.0 * std::sqrt(pow7(c) / (pow7(c) + pow7(25.0)));
    const double l50 = (l - 50.0) * (l - 50.0);
    const double sl = 1.0 + 0.015 * l50 / std::sqrt(20.0 + l50), sc = 1.0 + 0.045 * c,
                 sh = 1.0 + 0.015 * c * t;
    return std::sqrt(dl * dl / (sl * sl) + dc * dc / (sc * sc) + dhh * dhh / (sh * sh) +
                     rt * dc / sc * dhh / sh);
}

/// Columns: red, green and blue as a protanope, a deuteranope and a tritanope see them.
inline const std::array<glm::dmat3, 3> dichromats{
    glm::transpose(glm::dmat3(0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882,
                              -0.048116, 1.051998)),
    glm::transpose(glm::dmat3(0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820,
                              0.042940, 0.968881)),
    glm::transpose(glm::dmat3(1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733,
                              0.691367, 0.303900))};

inline glm::dvec3 linear_of(const Srgb& srgb) {
    glm::dvec3 linear;
    for (int i = 0; i < 3; ++i) {
        const double value = srgb[static_cast<std::size_t>(i)] / 255.0;
        linear[i] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    }
    return linear;
}

/// To the eyes, of normal ones and the three kinds, that tell them apart worst.
inline double least_difference(const Srgb& one, const Srgb& other) {
    const glm::dvec3 a = linear_of(one), b = linear_of(other);
    double least = ciede2000(lab_of_linear(a), lab_of_linear(b));
    for (const glm::dmat3& seen : dichromats)
        least = std::min(least, ciede2000(lab_of_linear(glm::clamp(seen * a, 0.0, 1.0)),
                                          lab_of_linear(glm::clamp(seen * b, 0.0, 1.0))));
    return least;
}

}  // namespace osteomill::testing
