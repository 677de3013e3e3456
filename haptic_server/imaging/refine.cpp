#include "haptic_server/imaging/refine.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <vector>

#include "haptic_server/imaging/cubic_spline.h"
#include "haptic_server/imaging/hu_volume.h"

namespace osteomill {

class Refiner::Sampler {
  public:
    virtual ~Sampler() = default;
    virtual void slice(int z, std::int16_t* out) const = 0;
};

namespace {

struct HuRange {
    float low = 0.0F;
    float high = 0.0F;
    /// To the nearest, halves away from 0, as std::lround has it but in a loop that vectorises.
    std::int16_t whole(float value) const {
        const double clamped = std::clamp(value, low, high);
        return static_cast<std::int16_t>(clamped + std::copysign(0.5, clamped));
    }
};

HuRange range_of(std::span<const float> values) {
    constexpr float lowest = std::numeric_limits<std::int16_t>::min();
    constexpr float highest = std::numeric_limits<std::int16_t>::max();
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {.low = std::clamp(*low, lowest, highest), .high = std::clamp(*high, lowest, highest)};
}

float blend(const SplineTaps& taps, const float* values, std::size_t step) {
    float sum = 0.0F;
    for (std::size_t i = 0; i < 4; ++i)
        sum += taps.weight[i] * values[static_cast<std::size_t>(taps.index[i]) * step];
    return sum;
}

/// out[i] = sum of weight * rows[index][i]; rows of `length` floats follow each other.
void blend_rows(const SplineTaps& taps, const float* rows, std::size_t length, std::vector<float>& out) {
    const float* row[4];
    for (std::size_t i = 0; i < 4; ++i) row[i] = rows + static_cast<std::size_t>(taps.index[i]) * length;
    for (std::size_t i = 0; i < length; ++i)
        out[i] = taps.weight[0] * row[0][i] + taps.weight[1] * row[1][i] + taps.weight[2] * row[2][i] +
                 taps.weight[3] * row[3][i];
}

std::vector<SplineTaps> taps_along(const SourceImage& part, const Grid& grid, int axis) {
    std::vector<SplineTaps> taps;
    for (int i = 0; i < grid.size_voxels[axis]; ++i) {
        const double at =
            (grid.origin_mm[axis] + grid.spacing_mm * i - part.origin_mm[axis]) / part.spacing_mm[axis];
        taps.push_back(
            spline_taps(std::clamp(at, -1.0, double(part.size_voxels[axis])), part.size_voxels[axis]));
    }
    return taps;
}

/// Axes of scan and grid agree, so the spline separates: a slice costs three passes of four taps.
class AlignedSampler : public Refiner::Sampler {
  public:
    AlignedSampler(const SourceImage& part, std::span<const float> coefficients, const Grid& grid,
                   HuRange range)
        : part_(part),
          coefficients_(coefficients),
          range_(range),
          x_(taps_along(part, grid, 0)),
          y_(taps_along(part, grid, 1)),
          z_(taps_along(part, grid, 2)) {}

    void slice(int z, std::int16_t* out) const override {
        const auto row_length = static_cast<std::size_t>(part_.size_voxels.x);
        const std::size_t slice_length = row_length * static_cast<std::size_t>(part_.size_voxels.y);
        std::vector<float> plane(slice_length);
        std::vector<float> row(row_length);
        blend_rows(z_[static_cast<std::size_t>(z)], coefficients_.data(), slice_length, plane);
        for (const SplineTaps& y : y_) {
            blend_rows(y, plane.data(), row_length, row);
            for (const SplineTaps& x : x_) *out++ = range_.whole(blend(x, row.data(), 1));
        }
    }

  private:
    SourceImage part_;
    std::span<const float> coefficients_;
    HuRange range_;
    std::vector<SplineTaps> x_, y_, z_;
};

/// A turned scan: 64 taps a voxel.
class ObliqueSampler : public Refiner::Sampler {
  public:
    ObliqueSampler(const SourceImage& part, std::span<const float> coefficients, const Grid& grid,
                   HuRange range)
        : part_(part), coefficients_(coefficients), grid_(grid), range_(range) {}

    void slice(int z, std::int16_t* out) const override {
        for (int y = 0; y < grid_.size_voxels.y; ++y)
            for (int x = 0; x < grid_.size_voxels.x; ++x) {
                const glm::dvec3 at = voxel_at(part_, centre_of_voxel_mm(grid_, {x, y, z}));
                *out++ = within(at) ? range_.whole(value(at)) : air_hu;
            }
    }

  private:
    bool within(const glm::dvec3& at) const {
        return glm::all(glm::greaterThanEqual(at, glm::dvec3(-0.5))) &&
               glm::all(glm::lessThanEqual(at, glm::dvec3(part_.size_voxels) - 0.5));
    }
    float value(const glm::dvec3& at) const {
        const SplineTaps x = spline_taps(at.x, part_.size_voxels.x);
        const SplineTaps y = spline_taps(at.y, part_.size_voxels.y);
        const SplineTaps z = spline_taps(at.z, part_.size_voxels.z);
        const auto row = static_cast<std::size_t>(part_.size_voxels.x);
        const std::size_t slice = row * static_cast<std::size_t>(part_.size_voxels.y);
        float sum = 0.0F;
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t j = 0; j < 4; ++j)
                sum += z.weight[k] * y.weight[j] *
                       blend(x,
                             &coefficients_[static_cast<std::size_t>(z.index[k]) * slice +
                                            static_cast<std::size_t>(y.index[j]) * row],
                             1);
        return sum;
    }

    SourceImage part_;
    std::span<const float> coefficients_;
    Grid grid_;
    HuRange range_;
};

}  // namespace

Refiner::Refiner(const SourceImage& part, std::span<float> values, const Grid& grid,
                 const std::function<void()>& pause) {
    require_valid(grid);
    const HuRange range = range_of(values);
    const Lattice lattice{
        .size_voxels = part.size_voxels, .spacing_mm = part.spacing_mm, .values = values, .pause = pause};
    smooth_for_spacing(lattice, grid.spacing_mm);
    values_to_coefficients(lattice);
    SourceImage geometry{.size_voxels = part.size_voxels,
                         .spacing_mm = part.spacing_mm,
                         .origin_mm = part.origin_mm,
                         .direction = part.direction};
    if (part.direction == glm::dmat3(1.0))
        sampler_ = std::make_unique<AlignedSampler>(geometry, values, grid, range);
    else
        sampler_ = std::make_unique<ObliqueSampler>(geometry, values, grid, range);
}

Refiner::~Refiner() = default;

void Refiner::slice(int z, std::span<std::int16_t> hu) const {
    sampler_->slice(z, hu.data());
}

}  // namespace osteomill
