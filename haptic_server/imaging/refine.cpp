#include "haptic_server/imaging/refine.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <thread>

#include "haptic_server/imaging/cubic_spline.h"
#include "haptic_server/imaging/image_part.h"

namespace osteomill {

namespace {

struct HuRange {
    float low = 0.0F;
    float high = 0.0F;
    std::int16_t whole(float value) const {
        return static_cast<std::int16_t>(std::lround(std::clamp(value, low, high)));
    }
};

HuRange range_of(const std::vector<float>& values) {
    constexpr float lowest = std::numeric_limits<std::int16_t>::min();
    constexpr float highest = std::numeric_limits<std::int16_t>::max();
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {.low = std::clamp(*low, lowest, highest), .high = std::clamp(*high, lowest, highest)};
}

std::size_t voxels_of_slice(const Grid& grid) {
    return static_cast<std::size_t>(grid.size_voxels.x) * static_cast<std::size_t>(grid.size_voxels.y);
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
class AlignedSampler {
  public:
    AlignedSampler(const SourceImage& part, const Grid& grid, HuRange range)
        : part_(part),
          range_(range),
          x_(taps_along(part, grid, 0)),
          y_(taps_along(part, grid, 1)),
          z_(taps_along(part, grid, 2)) {}

    void slice(int z, std::int16_t* out) const {
        const auto row_length = static_cast<std::size_t>(part_.size_voxels.x);
        const std::size_t slice_length = row_length * static_cast<std::size_t>(part_.size_voxels.y);
        std::vector<float> plane(slice_length);
        std::vector<float> row(row_length);
        blend_rows(z_[static_cast<std::size_t>(z)], part_.values.data(), slice_length, plane);
        for (const SplineTaps& y : y_) {
            blend_rows(y, plane.data(), row_length, row);
            for (const SplineTaps& x : x_) *out++ = range_.whole(blend(x, row.data(), 1));
        }
    }

  private:
    const SourceImage& part_;
    HuRange range_;
    std::vector<SplineTaps> x_, y_, z_;
};

/// A turned scan: 64 taps a voxel.
class ObliqueSampler {
  public:
    ObliqueSampler(const SourceImage& part, const Grid& grid, HuRange range)
        : part_(part), grid_(grid), range_(range) {}

    void slice(int z, std::int16_t* out) const {
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
                             &part_.values[static_cast<std::size_t>(z.index[k]) * slice +
                                           static_cast<std::size_t>(y.index[j]) * row],
                             1);
        return sum;
    }

    const SourceImage& part_;
    const Grid& grid_;
    HuRange range_;
};

/// Every thread takes the next slice that is left; the calling thread reports.
template <typename Sampler>
void sample_slices(const Sampler& sampler, HuVolume& volume, const ReportProgress& report) {
    const int slices = volume.grid.size_voxels.z;
    const std::size_t length = voxels_of_slice(volume.grid);
    std::atomic<int> next{0};
    const auto work = [&](bool reports) {
        for (int z = next++; z < slices; z = next++) {
            sampler.slice(z, volume.hu.data() + static_cast<std::size_t>(z) * length);
            if (reports) report(static_cast<double>(z) / slices);
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) helpers.emplace_back(work, false);
        work(true);
    }
    report(1.0);
}

}  // namespace

HuVolume refine(SourceImage part, const Grid& grid, const ReportProgress& report) {
    require_valid(grid);
    const HuRange range = range_of(part.values);
    smooth_for_spacing(part, grid.spacing_mm);
    values_to_coefficients(part);
    HuVolume volume{.grid = grid, .hu = {}, .tissue = {}};
    volume.hu.resize(voxels_of_slice(grid) * static_cast<std::size_t>(grid.size_voxels.z));
    if (part.direction == glm::dmat3(1.0))
        sample_slices(AlignedSampler(part, grid, range), volume, report);
    else
        sample_slices(ObliqueSampler(part, grid, range), volume, report);
    return volume;
}

}  // namespace osteomill
