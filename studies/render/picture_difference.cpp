#include "studies/render/picture_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace osteomill::study {

namespace {

constexpr int window_reach_px = 5;
constexpr double window_sigma_px = 1.5;

void require_same_size(const Picture& a, const Picture& b) {
    if (a.size_px != b.size_px) throw std::invalid_argument("pictures of different sizes are compared");
}

/// One number a pixel.
struct Plane {
    glm::ivec2 size_px{0};
    std::vector<double> values{};

    double at(int x, int y) const { return values[static_cast<std::size_t>(y) * size_px.x + x]; }
};

Plane luma(const Picture& picture) {
    Plane plane{picture.size_px, {}};
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        plane.values.push_back(0.299 * picture.rgb[i] + 0.587 * picture.rgb[i + 1] +
                               0.114 * picture.rgb[i + 2]);
    return plane;
}

Plane product(const Plane& a, const Plane& b) {
    Plane plane{a.size_px, a.values};
    std::transform(a.values.begin(), a.values.end(), b.values.begin(), plane.values.begin(),
                   std::multiplies<>());
    return plane;
}

/// The Gaussian window along one axis; pixels beyond the edge are left out and the rest weigh more.
Plane smoothed_along(const Plane& plane, const glm::ivec2& axis) {
    std::array<double, 2 * window_reach_px + 1> weights{};
    for (int i = -window_reach_px; i <= window_reach_px; ++i)
        weights[static_cast<std::size_t>(i + window_reach_px)] =
            std::exp(-0.5 * i * i / (window_sigma_px * window_sigma_px));
    Plane smooth{plane.size_px, {}};
    smooth.values.reserve(plane.values.size());
    for (int y = 0; y < plane.size_px.y; ++y)
        for (int x = 0; x < plane.size_px.x; ++x) {
            double sum = 0.0, weight_sum = 0.0;
            for (int i = -window_reach_px; i <= window_reach_px; ++i) {
                const int at_x = x + i * axis.x, at_y = y + i * axis.y;
                if (at_x < 0 || at_y < 0 || at_x >= plane.size_px.x || at_y >= plane.size_px.y) continue;
                const double weight = weights[static_cast<std::size_t>(i + window_reach_px)];
                sum += weight * plane.at(at_x, at_y);
                weight_sum += weight;
            }
            smooth.values.push_back(sum / weight_sum);
        }
    return smooth;
}

Plane smoothed(const Plane& plane) {
    return smoothed_along(smoothed_along(plane, {1, 0}), {0, 1});
}

}  // namespace

double psnr_db(const Picture& picture, const Picture& reference) {
    require_same_size(picture, reference);
    double squares = 0.0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const double difference = static_cast<double>(picture.rgb[i]) - reference.rgb[i];
        squares += difference * difference;
    }
    if (squares == 0.0) return std::numeric_limits<double>::infinity();
    return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(picture.rgb.size()) / squares);
}

double ssim(const Picture& picture, const Picture& reference) {
    require_same_size(picture, reference);
    constexpr double c1 = (0.01 * 255.0) * (0.01 * 255.0);
    constexpr double c2 = (0.03 * 255.0) * (0.03 * 255.0);
    const Plane a = luma(picture), b = luma(reference);
    const Plane mean_a = smoothed(a), mean_b = smoothed(b);
    const Plane mean_aa = smoothed(product(a, a));
    const Plane mean_bb = smoothed(product(b, b));
    const Plane mean_ab = smoothed(product(a, b));
    double sum = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double ma = mean_a.values[i], mb = mean_b.values[i];
        const double variance_a = mean_aa.values[i] - ma * ma;
        const double variance_b = mean_bb.values[i] - mb * mb;
        const double covariance = mean_ab.values[i] - ma * mb;
        sum += (2.0 * ma * mb + c1) * (2.0 * covariance + c2) /
               ((ma * ma + mb * mb + c1) * (variance_a + variance_b + c2));
    }
    return sum / static_cast<double>(a.values.size());
}

}  // namespace osteomill::study
