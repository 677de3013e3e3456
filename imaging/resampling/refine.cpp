#include "imaging/resampling/refine.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <vector>

#include "imaging/bone_from_hu.h"
#include "imaging/resampling/cubic_spline.h"

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

/// The places of the grid's voxels along an axis, in continuous voxel coordinates of a part whose axes are
/// the grid's.
std::vector<double> places_along(const SourceImage& part, const Grid& grid, int axis) {
    std::vector<double> places;
    for (int i = 0; i < grid.size_voxels[axis]; ++i) {
        const double at =
            (grid.origin_mm[axis] + grid.spacing_mm * i - part.origin_mm[axis]) / part.spacing_mm[axis];
        places.push_back(std::clamp(at, -1.0, double(part.size_voxels[axis])));
    }
    return places;
}

std::vector<SplineTaps> taps_at(const std::vector<double>& places, int size) {
    std::vector<SplineTaps> taps;
    for (const double at : places) taps.push_back(spline_taps(at, size));
    return taps;
}

/// The spline anywhere in the scan: 64 taps a place.
class SplineField {
  public:
    SplineField(const SourceImage& part, std::span<const float> coefficients)
        : size_(part.size_voxels), coefficients_(coefficients) {}

    float at(const glm::dvec3& voxel) const {
        const SplineTaps x = spline_taps(voxel.x, size_.x);
        const SplineTaps y = spline_taps(voxel.y, size_.y);
        const SplineTaps z = spline_taps(voxel.z, size_.z);
        const auto row = static_cast<std::size_t>(size_.x);
        const std::size_t slice = row * static_cast<std::size_t>(size_.y);
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

    /// The weighted mean of the HU blended in place and the HU of the same depth in the slices around.
    float following(const SliceShapes& shapes, const glm::dvec3& voxel, float in_place) const {
        const auto from = shapes.places(voxel);
        if (!from) return in_place;
        const auto upper_share = static_cast<float>(from->upper_share);
        const float moved = (1.0F - upper_share) * at(from->lower) + upper_share * at(from->upper);
        return in_place + static_cast<float>(from->weight) * (moved - in_place);
    }

  private:
    glm::ivec3 size_;
    std::span<const float> coefficients_;
};

struct Field {
    SourceImage part{};
    std::span<const float> coefficients{};
    Grid grid{};
    HuRange range{};
    const SliceShapes* shapes = nullptr;
};

/// Axes of scan and grid agree, so the spline separates: a slice costs three passes of four taps.
class AlignedSampler : public Refiner::Sampler {
  public:
    explicit AlignedSampler(const Field& field)
        : field_(field),
          spline_(field.part, field.coefficients),
          places_{places_along(field.part, field.grid, 0), places_along(field.part, field.grid, 1),
                  places_along(field.part, field.grid, 2)},
          x_(taps_at(places_[0], field.part.size_voxels.x)),
          y_(taps_at(places_[1], field.part.size_voxels.y)),
          z_(taps_at(places_[2], field.part.size_voxels.z)) {}

    void slice(int z, std::int16_t* out) const override {
        const auto row_length = static_cast<std::size_t>(field_.part.size_voxels.x);
        const std::size_t slice_length = row_length * static_cast<std::size_t>(field_.part.size_voxels.y);
        std::vector<float> plane(slice_length);
        std::vector<float> row(row_length);
        // Whether the contour moves in each cell of the scan's current row; kept, because a cell is many of
        // the grid's rows thick.
        std::vector<char> moves(row_length + 1, 0);
        int known_row = std::numeric_limits<int>::min();
        glm::dvec3 at(0.0, 0.0, places_[2][static_cast<std::size_t>(z)]);
        blend_rows(z_[static_cast<std::size_t>(z)], field_.coefficients.data(), slice_length, plane);
        for (int y = 0; y < field_.grid.size_voxels.y; ++y) {
            blend_rows(y_[static_cast<std::size_t>(y)], plane.data(), row_length, row);
            if (!field_.shapes) {
                for (const SplineTaps& x : x_) *out++ = field_.range.whole(blend(x, row.data(), 1));
                continue;
            }
            at.y = places_[1][static_cast<std::size_t>(y)];
            if (const int row_of_cells = static_cast<int>(std::floor(at.y)); row_of_cells != known_row) {
                known_row = row_of_cells;
                for (int i = 0; i < field_.part.size_voxels.x; ++i)
                    moves[static_cast<std::size_t>(i)] =
                        field_.shapes->may_move({i, known_row, static_cast<int>(std::floor(at.z))});
            }
            for (std::size_t x = 0; x < x_.size(); ++x) {
                const float in_place = blend(x_[x], row.data(), 1);
                at.x = places_[0][x];
                const bool moved = at.x >= 0.0 && moves[static_cast<std::size_t>(at.x)] != 0;
                *out++ =
                    field_.range.whole(moved ? spline_.following(*field_.shapes, at, in_place) : in_place);
            }
        }
    }

  private:
    Field field_;
    SplineField spline_;
    std::vector<double> places_[3];
    std::vector<SplineTaps> x_, y_, z_;
};

/// A turned scan.
class ObliqueSampler : public Refiner::Sampler {
  public:
    explicit ObliqueSampler(const Field& field) : field_(field), spline_(field.part, field.coefficients) {}

    void slice(int z, std::int16_t* out) const override {
        for (int y = 0; y < field_.grid.size_voxels.y; ++y)
            for (int x = 0; x < field_.grid.size_voxels.x; ++x) {
                const glm::dvec3 at = voxel_at(field_.part, centre_of_voxel_mm(field_.grid, {x, y, z}));
                if (!within(at)) {
                    *out++ = air_hu;
                    continue;
                }
                const float in_place = spline_.at(at);
                const bool moves = field_.shapes && field_.shapes->may_move(glm::ivec3(glm::floor(at)));
                *out++ =
                    field_.range.whole(moves ? spline_.following(*field_.shapes, at, in_place) : in_place);
            }
    }

  private:
    bool within(const glm::dvec3& at) const {
        return glm::all(glm::greaterThanEqual(at, glm::dvec3(-0.5))) &&
               glm::all(glm::lessThanEqual(at, glm::dvec3(field_.part.size_voxels) - 0.5));
    }

    Field field_;
    SplineField spline_;
};

}  // namespace

Refiner::Refiner(const SourceImage& part, std::span<float> values, const Grid& grid,
                 const SliceShapes* shapes, const std::function<void()>& pause) {
    require_valid(grid);
    const HuRange range = range_of(values);
    const Lattice lattice{
        .size_voxels = part.size_voxels, .spacing_mm = part.spacing_mm, .values = values, .pause = pause};
    smooth_for_spacing(lattice, grid.spacing_mm);
    values_to_coefficients(lattice);
    const Field field{.part = part, .coefficients = values, .grid = grid, .range = range, .shapes = shapes};
    if (part.direction == glm::dmat3(1.0))
        sampler_ = std::make_unique<AlignedSampler>(field);
    else
        sampler_ = std::make_unique<ObliqueSampler>(field);
}

Refiner::~Refiner() = default;

void Refiner::slice(int z, std::span<std::int16_t> hu) const {
    sampler_->slice(z, hu.data());
}

}  // namespace osteomill
