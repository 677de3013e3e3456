#include "imaging/resampling/cubic_spline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "imaging/in_parallel.h"

namespace osteomill {

namespace {

constexpr double fwhm_per_sigma = 2.3548200450309493;
/// A result coarser by less than this is not worth smoothing.
constexpr double coarser_tolerance = 1.01;

/// Calls filter(line), which changes the values of a line along `axis` (0: x), for each such line, on all
/// cores. `size` counts voxels; values lie x fastest, then y, then z. `pause` is called between rows, from
/// any thread, so that memory that was touched can be let go.
template <typename Filter>
void filter_lines(
    const glm::ivec3& size, std::span<float> values, int axis, const Filter& filter,
    const std::function<void()>& pause = [] {}) {
    const auto nx = static_cast<std::size_t>(size.x);
    const auto ny = static_cast<std::size_t>(size.y);
    const auto length = static_cast<std::size_t>(size[axis]);
    // A sheet holds the axis and, unless that is x, x: its lines are worked on next to each other, since they
    // lie next to each other in memory.
    const std::size_t step = axis == 0 ? 1 : axis == 1 ? nx : nx * ny;
    const int sheets = axis == 2 ? size.y : size.z;
    const std::size_t step_of_sheet = axis == 2 ? nx : nx * ny;
    const std::size_t lines = axis == 0 ? ny : nx;
    const std::size_t step_of_line = axis == 0 ? nx : 1;
    constexpr std::size_t values_at_once = 1u << 17;
    const std::size_t lines_at_once = std::clamp<std::size_t>(values_at_once / length, 1, lines);
    in_parallel(sheets, [&](int sheet) {
        float* first = values.data() + static_cast<std::size_t>(sheet) * step_of_sheet;
        std::vector<double> tile(lines_at_once * length);
        for (std::size_t begin = 0; begin < lines; begin += lines_at_once) {
            const std::size_t count = std::min(lines_at_once, lines - begin);
            float* corner = first + begin * step_of_line;
            for (std::size_t i = 0; i < length; ++i)
                for (std::size_t line = 0; line < count; ++line)
                    tile[line * length + i] = corner[i * step + line * step_of_line];
            for (std::size_t line = 0; line < count; ++line)
                filter(std::span(tile).subspan(line * length, length));
            for (std::size_t i = 0; i < length; ++i)
                for (std::size_t line = 0; line < count; ++line)
                    corner[i * step + line * step_of_line] = static_cast<float>(tile[line * length + i]);
        }
        pause();
    });
}

/// The pole of the cubic spline's filter, sqrt(3) - 2: a value's part in the coefficients fades by this
/// factor a voxel.
const double pole = std::sqrt(3.0) - 2.0;
/// The first coefficient is a sum over the line; terms that have faded below this share are left out.
constexpr double tolerance = 1e-10;

/// Unser 1999, box 2.
void line_to_coefficients(std::span<double> line) {
    const std::size_t size = line.size();
    if (size == 1) return;
    const double gain = (1.0 - pole) * (1.0 - 1.0 / pole);
    for (double& value : line) value *= gain;
    const auto horizon = static_cast<std::size_t>(std::ceil(std::log(tolerance) / std::log(std::abs(pole))));
    double power = pole;
    if (horizon < size) {
        double sum = line[0];
        for (std::size_t i = 1; i < horizon; ++i, power *= pole) sum += power * line[i];
        line[0] = sum;
    } else {
        double mirrored_power = std::pow(pole, static_cast<double>(size - 1));
        double sum = line[0] + mirrored_power * line[size - 1];
        mirrored_power *= mirrored_power / pole;
        for (std::size_t i = 1; i + 1 < size; ++i, power *= pole, mirrored_power /= pole)
            sum += (power + mirrored_power) * line[i];
        line[0] = sum / (1.0 - power * power);
    }
    for (std::size_t i = 1; i < size; ++i) line[i] += pole * line[i - 1];
    line[size - 1] = pole / (pole * pole - 1.0) * (pole * line[size - 2] + line[size - 1]);
    for (std::size_t i = size - 1; i-- > 0;) line[i] = pole * (line[i + 1] - line[i]);
}

/// The discrete Gaussian (T. Lindeberg, "Scale-space for discrete signals", 1990): exp(-t) I_n(t), t the
/// variance, cut off where a hundredth is left outside, and of sum one.
std::vector<double> gaussian(double sigma_voxels) {
    constexpr double most_outside = 0.01;
    const double variance = sigma_voxels * sigma_voxels;
    std::vector<double> half;
    double sum = 0.0;
    while (sum < 1.0 - most_outside || half.size() < 2) {
        // exp(-t) I_n(t) by its integral over a period, which the trapezoidal rule gives to the last digit.
        const int n = static_cast<int>(half.size());
        const int steps = 64 + 8 * (n + static_cast<int>(std::ceil(sigma_voxels)));
        double weight = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / steps;
            weight += std::exp(variance * (std::cos(angle) - 1.0)) * std::cos(n * angle) / steps;
        }
        half.push_back(weight);
        sum += n == 0 ? weight : 2.0 * weight;
    }
    std::vector<double> kernel(half.rbegin(), half.rend());
    kernel.insert(kernel.end(), half.begin() + 1, half.end());
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

/// The line's ends repeat beyond them.
void convolve(const std::vector<double>& kernel, std::span<double> line) {
    const std::vector<double> before(line.begin(), line.end());
    const auto reach = static_cast<std::ptrdiff_t>(kernel.size() / 2);
    const auto last = static_cast<std::ptrdiff_t>(line.size()) - 1;
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        double sum = 0.0;
        for (std::ptrdiff_t k = -reach; k <= reach; ++k)
            sum += kernel[static_cast<std::size_t>(k + reach)] *
                   before[static_cast<std::size_t>(std::clamp(i + k, std::ptrdiff_t{0}, last))];
        line[static_cast<std::size_t>(i)] = sum;
    }
}

int mirrored(int index, int size) {
    if (size == 1) return 0;
    const int period = 2 * (size - 1);
    const int within = ((index % period) + period) % period;
    return std::min(within, period - within);
}

}  // namespace

SplineTaps spline_taps(double at, int size) {
    const double below = std::floor(at);
    const double t = at - below;
    const double u = 1.0 - t;
    const std::array<double, 4> weight{u * u * u / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
                                       (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0, t * t * t / 6.0};
    SplineTaps taps;
    for (int i = 0; i < 4; ++i) {
        const auto tap = static_cast<std::size_t>(i);
        taps.index[tap] = mirrored(static_cast<int>(below) - 1 + i, size);
        taps.weight[tap] = static_cast<float>(weight[tap]);
    }
    return taps;
}

void values_to_coefficients(const Lattice& lattice) {
    for (int axis = 0; axis < 3; ++axis)
        filter_lines(lattice.size_voxels, lattice.values, axis, line_to_coefficients, lattice.pause);
}

void smooth_for_spacing(const Lattice& lattice, double spacing_mm) {
    for (int axis = 2; axis >= 0; --axis) {
        const double ratio = spacing_mm / lattice.spacing_mm[axis];
        if (ratio < coarser_tolerance) continue;
        const std::vector<double> kernel = gaussian(std::sqrt(ratio * ratio - 1.0) / fwhm_per_sigma);
        filter_lines(
            lattice.size_voxels, lattice.values, axis,
            [&](std::span<double> line) { convolve(kernel, line); }, lattice.pause);
    }
}

}  // namespace osteomill
