#include "simulation/cutting_force/axis_singularity_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osteomill::axis_singularity_kernel_test {
namespace {

constexpr double a = axis_disc_voxels;

/// w of the header, by the distance from the voxel.
double weight(double distance) {
    const double t = distance * distance / (a * a);
    return t < 1.0 ? 0.6 * (13.0 - 32.0 * t) * (1.0 - t) * (1.0 - t) / (std::numbers::pi * a * a) : 0.0;
}

/// The means about (r, 0) by quadrature in polar coordinates about the axis, where 1/r does no harm.
AxisKernel<double> means_by_quadrature(double r) {
    constexpr int angles = 720;
    constexpr int radii = 2000;
    const double farthest = r + a;
    AxisKernel<double> sum{};
    for (int i = 0; i < angles; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + 0.5) / angles;
        for (int j = 0; j < radii; ++j) {
            const double s = farthest * (j + 0.5) / radii;
            const double w = weight(std::hypot(s * std::cos(angle) - r, s * std::sin(angle)));
            sum.swirl += w * std::cos(angle);
            sum.outward += w * std::cos(angle) * s;
            sum.inverse += w;
        }
    }
    const double cell = farthest / radii * 2.0 * std::numbers::pi / angles;
    return {sum.swirl * cell, sum.outward * cell, sum.inverse * cell};
}

TEST(AxisKernel, AreThoseOverTheWeightedDisc) {
    for (const double r : {0.05, 0.2, 0.5, 0.9, 1.3, 1.7, 1.92, 1.94, 2.2, 3.5, 8.0}) {
        const AxisKernel<double> exact = means_by_quadrature(r);
        const AxisKernel<float> means =
            axis_kernel(static_cast<float>(r * r), static_cast<float>(1.0 / std::max(r, 0.1)));
        EXPECT_NEAR(r * static_cast<double>(means.swirl), exact.swirl, 2e-3) << "r " << r;
        EXPECT_NEAR(r * static_cast<double>(means.outward), exact.outward, 6e-3) << "r " << r;
        EXPECT_NEAR(static_cast<double>(means.inverse) / exact.inverse, 1.0, 1e-2) << "r " << r;
    }
}

TEST(AxisKernel, AreMadeUpForWhatTheyLoseOnAFaceThatEndsAtTheAxis) {
    // Over the half of a disc of radius R to the right of a line through the axis the integral of cos psi / r
    // is 2 R. Voxels count for the part of them to the right.
    constexpr double radius = 6.0;
    constexpr int cells = 1200;
    constexpr double cell = 2.0 * radius / cells;
    double without = 0.0;
    double with = 0.0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const double x = (i + 0.5) * cell - radius;
            const double y = (j + 0.5) * cell - radius;
            const double r_squared = x * x + y * y;
            if (r_squared > radius * radius) continue;
            const double part = std::clamp(0.5 + x, 0.0, 1.0) * x * cell * cell;
            const double swirl = axis_kernel(r_squared, 1.0 / std::sqrt(r_squared)).swirl;
            without += part * swirl;
            with += part * (swirl + swirl_lost_at_line(r_squared));
        }
    EXPECT_NEAR(without, 2.0 * radius - 1.05, 0.03) << "half a voxel each of what two edges have";
    EXPECT_NEAR(with, 2.0 * radius, 0.03);
}

TEST(AxisKernel, DoNotTellWhereThePlanesOfTheLatticeLie) {
    constexpr double step = 0.01;                       // along the planes, where bone is the same
    for (const double spacing : {1.0, std::sqrt(2.0)})  // seen along the lattice, and aslant
        for (const double place : {0.0, 0.13, 0.25, 0.5}) {
            double sum = 0.0;
            for (int plane = -3; plane <= 3; ++plane)
                for (double y = -a; y <= a; y += step)
                    sum += spacing * step * weight(std::hypot(spacing * (plane - place), y));
            EXPECT_NEAR(sum, 1.0, 0.03) << spacing << ' ' << place;
        }
}

TEST(AxisKernel, AllButLeaveCurvaturesAsTheyAre) {
    constexpr int steps = 10'000;
    double total = 0.0;
    double second_moment = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double r = a * (i + 0.5) / steps;
        const double ring = weight(r) * 2.0 * std::numbers::pi * r * a / steps;
        total += ring;
        second_moment += ring * r * r;
    }
    EXPECT_NEAR(total, 1.0, 1e-6);
    EXPECT_NEAR(second_moment, 0.01 * a * a, 1e-6) << "a square's is 1/6";
}

}  // namespace
}  // namespace osteomill::axis_singularity_kernel_test
