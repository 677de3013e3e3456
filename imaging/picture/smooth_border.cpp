#include "imaging/picture/smooth_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <span>

namespace osteomill {

namespace {

constexpr double wide_deviation = 2.0;
constexpr double narrow_deviation = 0.8;
/// Difference between wide and narrow smoothing, voxels: up to the first the wide one is taken, from the
/// second on the narrow one.
constexpr float apart_for_wide = 0.2f;
constexpr float apart_for_narrow = 0.5f;
/// Each voxel's centre stays at least so far on its side.
constexpr float least_distance = 0.05f;
constexpr float far = 1e6f;

/// Calls `work(line)` for each line of a block along an axis; the line is put back.
template <typename Work>
void for_lines(const glm::ivec3& size, int axis, std::vector<float>& values, Work&& work) {
    const std::array<std::size_t, 3> strides{
        1, static_cast<std::size_t>(size.x),
        static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const std::size_t stride = strides[static_cast<std::size_t>(axis)];
    std::vector<float> line(static_cast<std::size_t>(size[axis]));
    for (int j = 0; j < size[v]; ++j)
        for (int i = 0; i < size[u]; ++i) {
            const std::size_t first = static_cast<std::size_t>(i) * strides[static_cast<std::size_t>(u)] +
                                      static_cast<std::size_t>(j) * strides[static_cast<std::size_t>(v)];
            for (std::size_t k = 0; k < line.size(); ++k) line[k] = values[first + k * stride];
            work(std::span<float>(line));
            for (std::size_t k = 0; k < line.size(); ++k) values[first + k * stride] = line[k];
        }
}

/// The squares of the distances to the nearest of the voxels with the value 0 on a line, or the like for
/// values that an axis before has left; `far` where there is none.
class LineTransform {
  public:
    void operator()(std::span<float> line) {
        const int count = static_cast<int>(line.size());
        places_.clear();
        for (int j = 0; j < count; ++j)
            if (const float height = line[static_cast<std::size_t>(j)]; height < far) add(j, height);
        if (places_.empty()) return;
        std::size_t at = 0;
        for (int j = 0; j < count; ++j) {
            while (at + 1 < places_.size() && places_[at + 1].from <= static_cast<float>(j)) ++at;
            const auto apart = static_cast<float>(j - places_[at].place);
            line[static_cast<std::size_t>(j)] = apart * apart + places_[at].height;
        }
    }

  private:
    struct Place {
        int place;
        float height;
        float from;  // where its parabola begins to be the lowest
    };
    void add(int place, float height) {
        float from = -far;
        while (!places_.empty()) {
            const Place& last = places_.back();
            from = 0.5f * static_cast<float>(place + last.place) +
                   0.5f * (height - last.height) / static_cast<float>(place - last.place);
            if (from > last.from) break;
            places_.pop_back();
            from = -far;
        }
        places_.push_back({place, height, from});
    }
    std::vector<Place> places_;
};

/// From each voxel's centre to that of the nearest one of the set.
std::vector<float> distances_to(const glm::ivec3& size, const std::vector<char>& set, char wanted) {
    std::vector<float> squares(set.size());
    std::ranges::transform(set, squares.begin(), [&](char one) { return one == wanted ? 0.0f : far; });
    LineTransform transform;
    for (int axis = 0; axis < 3; ++axis) for_lines(size, axis, squares, transform);
    std::ranges::transform(squares, squares.begin(), [](float square) { return std::sqrt(square); });
    return squares;
}

std::vector<float> gaussian_weights(double deviation) {
    const int reach = static_cast<int>(std::ceil(2.5 * deviation));
    std::vector<float> weights;
    for (int i = -reach; i <= reach; ++i)
        weights.push_back(static_cast<float>(std::exp(-0.5 * i * i / (deviation * deviation))));
    const float sum = std::accumulate(weights.begin(), weights.end(), 0.0f);
    for (float& weight : weights) weight /= sum;
    return weights;
}

/// Each value becomes what `of_window` makes of it and its neighbours within `reach`; beyond the block as at
/// its edge.
template <typename OfWindow>
void filter(const glm::ivec3& size, std::vector<float>& values, std::size_t reach, OfWindow&& of_window) {
    std::vector<float> padded;
    for (int axis = 0; axis < 3; ++axis)
        for_lines(size, axis, values, [&](std::span<float> line) {
            padded.assign(line.size() + 2 * reach, line.front());
            std::copy(line.begin(), line.end(), padded.begin() + static_cast<std::ptrdiff_t>(reach));
            std::fill(padded.end() - static_cast<std::ptrdiff_t>(reach), padded.end(), line.back());
            for (std::size_t i = 0; i < line.size(); ++i)
                line[i] = of_window(std::span<const float>(padded).subspan(i, 2 * reach + 1));
        });
}

/// 2 G v - G G v.
std::vector<float> smoothed(const glm::ivec3& size, const std::vector<float>& values, double deviation) {
    const std::vector<float> weights = gaussian_weights(deviation);
    const auto mean = [&](std::span<const float> window) {
        return std::inner_product(weights.begin(), weights.end(), window.begin(), 0.0f);
    };
    std::vector<float> once = values;
    filter(size, once, weights.size() / 2, mean);
    std::vector<float> twice = once;
    filter(size, twice, weights.size() / 2, mean);
    std::ranges::transform(once, twice, once.begin(), [](float a, float b) { return 2.0f * a - b; });
    return once;
}

/// Wide where the two agree, narrow where they do not and beside that.
void blend(const glm::ivec3& size, std::vector<float>& wide, const std::vector<float>& narrow) {
    std::vector<float> parts(wide.size());
    std::ranges::transform(wide, narrow, parts.begin(), [](float a, float b) {
        return std::clamp((std::abs(a - b) - apart_for_wide) / (apart_for_narrow - apart_for_wide), 0.0f,
                          1.0f);
    });
    filter(size, parts, 1, [](std::span<const float> window) { return std::ranges::max(window); });
    for (std::size_t i = 0; i < wide.size(); ++i) wide[i] += parts[i] * (narrow[i] - wide[i]);
}

}  // namespace

SmoothBorder::SmoothBorder(const VoxelBounds& box, const std::function<bool(const glm::ivec3& voxel)>& is_in)
    : first_(box.first), size_(glm::max(box.last - box.first + 1, 2)) {
    const glm::ivec3 wide_size = size_ + 2 * reach_voxels;
    std::vector<char> set;
    set.reserve(static_cast<std::size_t>(wide_size.x) * static_cast<std::size_t>(wide_size.y) *
                static_cast<std::size_t>(wide_size.z));
    for (int z = 0; z < wide_size.z; ++z)
        for (int y = 0; y < wide_size.y; ++y)
            for (int x = 0; x < wide_size.x; ++x) {
                set.push_back(is_in(first_ - reach_voxels + glm::ivec3(x, y, z)) ? 1 : 0);
                (set.back() != 0 ? is_empty_ : is_full_) = false;
            }
    if (is_empty_ || is_full_) return;

    std::vector<float> distances = distances_to(wide_size, set, 1);
    {
        // To the faces: half a voxel before the centre.
        const std::vector<float> to_rest = distances_to(wide_size, set, 0);
        constexpr auto most = static_cast<float>(reach_voxels);
        for (std::size_t i = 0; i < set.size(); ++i)
            distances[i] = std::clamp(set[i] != 0 ? 0.5f - to_rest[i] : distances[i] - 0.5f, -most, most);
    }
    std::vector<float> smooth = smoothed(wide_size, distances, wide_deviation);
    blend(wide_size, smooth, smoothed(wide_size, distances, narrow_deviation));
    distances_.reserve(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                       static_cast<std::size_t>(size_.z));
    for (int z = 0; z < size_.z; ++z)
        for (int y = 0; y < size_.y; ++y)
            for (int x = 0; x < size_.x; ++x) {
                const glm::ivec3 there = glm::ivec3(x, y, z) + reach_voxels;
                const std::size_t i = voxel_index(there, wide_size);
                distances_.push_back(set[i] != 0 ? std::min(smooth[i], -least_distance)
                                                 : std::max(smooth[i], least_distance));
            }
}

double SmoothBorder::distance(const glm::dvec3& place) const {
    if (is_empty_) return reach_voxels;
    if (is_full_) return -reach_voxels;
    const glm::dvec3 inside = glm::clamp(place - glm::dvec3(first_), glm::dvec3(0.0), glm::dvec3(size_ - 1));
    const glm::ivec3 low = glm::min(glm::ivec3(glm::floor(inside)), size_ - 2);
    const glm::dvec3 part = inside - glm::dvec3(low);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 weights = glm::mix(1.0 - part, part, glm::dvec3(side));
        sum += weights.x * weights.y * weights.z * at(low + side);
    }
    return sum;
}

}  // namespace osteomill
