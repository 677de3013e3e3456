#include "imaging/resampling/specks.h"

#include <algorithm>
#include <utility>

#include "imaging/bone_from_hu.h"

namespace osteomill {

SpeckSearch::SpeckSearch(const Grid& grid, double threshold_hu)
    : grid_(grid),
      threshold_hu_(threshold_hu),
      most_voxels_(speck_mm3 / voxel_volume_mm3(grid)),
      rows_(static_cast<std::size_t>(grid.size_voxels.y)),
      rows_before_(rows_.size()) {}

std::uint32_t SpeckSearch::root(std::uint32_t part) {
    while (parts_[part].joined_to != part) {
        parts_[part].joined_to = parts_[parts_[part].joined_to].joined_to;
        part = parts_[part].joined_to;
    }
    return part;
}

std::uint32_t SpeckSearch::join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return a;
    if (parts_[a].voxels < parts_[b].voxels) std::swap(a, b);
    Part& kept = parts_[a];
    Part& joined = parts_[b];
    joined.joined_to = a;
    kept.voxels += joined.voxels;
    if (is_small(kept))
        kept.runs.insert(kept.runs.end(), joined.runs.begin(), joined.runs.end());
    else
        kept.runs = {};
    joined.runs = {};
    return a;
}

void SpeckSearch::touch(Run& run, const Row& row) {
    // The first that reaches the run's corner; runs ascend.
    auto other = std::ranges::partition_point(row, [&](const Run& one) { return one.end_x < run.first_x; });
    for (; other != row.end() && other->first_x <= run.end_x; ++other)
        run.part = run.part == no_part ? root(other->part) : join(run.part, other->part);
}

void SpeckSearch::add(std::span<const std::int16_t> hu) {
    const int z = next_z_++;
    if (has_given_up()) return;
    std::swap(rows_, rows_before_);
    const int rows = grid_.size_voxels.y, size_x = grid_.size_voxels.x;
    for (int y = 0; y < rows; ++y) {
        Row& row = rows_[static_cast<std::size_t>(y)];
        row.clear();
        const auto values = hu.subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(size_x),
                                       static_cast<std::size_t>(size_x));
        for (int x = 0; x < size_x; ++x) {
            if (values[static_cast<std::size_t>(x)] < threshold_hu_) continue;
            const int first = x;
            while (x < size_x && values[static_cast<std::size_t>(x)] >= threshold_hu_) ++x;
            Run run{first, x, no_part};
            if (y > 0) touch(run, rows_[static_cast<std::size_t>(y - 1)]);
            for (int beside = std::max(y - 1, 0); beside <= std::min(y + 1, rows - 1); ++beside)
                touch(run, rows_before_[static_cast<std::size_t>(beside)]);
            if (run.part == no_part) {
                run.part = static_cast<std::uint32_t>(parts_.size());
                parts_.push_back({.joined_to = run.part});
            }
            Part& part = parts_[run.part];
            part.voxels += static_cast<std::uint64_t>(x - first);
            if (is_small(part))
                part.runs.push_back({z, y, first, x});
            else
                part.runs = {};
            row.push_back(run);
            if (has_given_up()) return;
        }
    }
}

Specks SpeckSearch::found() const {
    Specks specks;
    std::size_t largest = parts_.size();
    const auto is_part = [&](std::size_t part) { return parts_[part].joined_to == part; };
    for (std::size_t part = 0; part < parts_.size(); ++part)
        if (is_part(part) && (largest == parts_.size() || parts_[part].voxels > parts_[largest].voxels))
            largest = part;
    for (std::size_t part = 0; part < parts_.size(); ++part) {
        if (!is_part(part) || part == largest || !is_small(parts_[part])) continue;
        ++specks.count;
        specks.voxels += parts_[part].voxels;
        specks.runs.insert(specks.runs.end(), parts_[part].runs.begin(), parts_[part].runs.end());
    }
    std::ranges::sort(specks.runs, {}, [](const VoxelRun& run) { return std::pair(run.z, run.y); });
    return specks;
}

void clear_specks(const Specks& specks, int z, int size_x, std::span<std::int16_t> hu) {
    for (auto run = std::ranges::lower_bound(specks.runs, z, {}, &VoxelRun::z);
         run != specks.runs.end() && run->z == z; ++run) {
        const auto row = hu.subspan(static_cast<std::size_t>(run->y) * static_cast<std::size_t>(size_x),
                                    static_cast<std::size_t>(size_x));
        std::fill(row.begin() + run->first_x, row.begin() + run->end_x, air_hu);
    }
}

}  // namespace osteomill
