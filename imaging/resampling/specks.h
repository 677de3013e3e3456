// Specks of bone: parts that are small and touch no other part, as noise, calcifications and crumbs make
// them.
//
// Parts are of voxels that reach the threshold and share a face, an edge or a corner; found slice by slice,
// by runs along x and a union of those that touch (Rosenfeld and Pfaltz 1966, J ACM 13:471). Only parts that
// may still be specks keep their runs, so memory follows the specks and one slice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/bone/grid.h"

namespace osteomill {

/// A part of less is a speck: a ball 1.6 mm wide.
inline constexpr double speck_mm3 = 2.0;

/// Voxels in a row.
struct VoxelRun {
    int z = 0, y = 0, first_x = 0, end_x = 0;

    bool operator==(const VoxelRun&) const = default;
};

struct Specks {
    std::size_t count = 0;
    std::uint64_t voxels = 0;
    std::vector<VoxelRun> runs{};  ///< ascending by z
};

class SpeckSearch {
  public:
    /// So many parts are noise, not bone: nothing is searched any more.
    static constexpr std::size_t most_parts = std::size_t{1} << 20U;

    SpeckSearch(const Grid& grid, double threshold_hu);

    /// The next slice, from z = 0 on.
    void add(std::span<const std::int16_t> hu);
    bool has_given_up() const { return parts_.size() > most_parts; }
    /// After the last slice: all parts of less than speck_mm3 but the largest part of the bone.
    Specks found() const;

  private:
    static constexpr std::uint32_t no_part = ~std::uint32_t{0};
    struct Part {
        std::uint32_t joined_to;  ///< itself, until it touches another
        std::uint64_t voxels = 0;
        std::vector<VoxelRun> runs{};
    };
    struct Run {
        int first_x = 0, end_x = 0;
        std::uint32_t part = 0;
    };
    using Row = std::vector<Run>;

    std::uint32_t root(std::uint32_t part);
    std::uint32_t join(std::uint32_t a, std::uint32_t b);
    void touch(Run& run, const Row& row);
    bool is_small(const Part& part) const { return static_cast<double>(part.voxels) < most_voxels_; }

    Grid grid_;
    double threshold_hu_;
    double most_voxels_;
    int next_z_ = 0;
    std::vector<Part> parts_;
    std::vector<Row> rows_, rows_before_;  // of the slice under way and of the one before it
};

/// Makes the runs in slice z air, -1000 HU.
void clear_specks(const Specks& specks, int z, int size_x, std::span<std::int16_t> hu);

}  // namespace osteomill
