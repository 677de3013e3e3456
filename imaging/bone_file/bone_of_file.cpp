#include "imaging/bone_file/bone_of_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "imaging/bone_file/carved_bone.h"
#include "imaging/imaging_error.h"
#include "imaging/resampling/hu_histogram.h"

namespace osteomill {

namespace {

/// Fraction and stiffness of the milling loop's bone, fraction of the copy that clients are shown.
constexpr std::uint64_t bytes_of_bone_voxel = 3;

/// Looks at the CT numbers as they come by.
class Watch {
  public:
    Watch(const BoneFile& file, double threshold_hu, std::optional<std::uint64_t> available_memory_bytes)
        : path_(file.path()),
          voxels_(voxel_count(file.grid())),
          threshold_hu_(threshold_hu),
          available_bytes_(available_memory_bytes) {
        // bone_import has already checked the files that it wrote.
        if (!file.key_values().contains(hu_digest_key)) histogram_.emplace();
    }

    void look_at(std::span<const std::int16_t> hu) {
        for (const std::int16_t value : hu) {
            highest_ = std::max(highest_, value);
            bone_voxels_ += value >= threshold_hu_ ? 1 : 0;
        }
        if (histogram_) histogram_->add(hu);
        if (available_bytes_ && bytes_of_bone_voxel * bone_voxels_ > *available_bytes_)
            throw ImagingError(
                path_, fmt::format("has more bone, from {} HU on, than fits in the {:.1f} GiB of memory that "
                                   "are available; give bone_import a smaller --region, a larger "
                                   "--spacing-mm, or say from which HU on it is bone (--threshold-hu)",
                                   threshold_hu_, static_cast<double>(*available_bytes_) / (1u << 30)));
    }

    std::string doubt() const {
        if (const std::string doubt = histogram_ ? histogram_->doubt() : std::string(); !doubt.empty())
            return doubt;
        if (bone_voxels_ < voxels_) return {};
        return fmt::format("every voxel reaches {} HU, so that all of it is bone", threshold_hu_);
    }

    ImagingError no_bone() const {
        const std::string why = doubt();
        return {path_, fmt::format("holds no bone: no voxel reaches {} HU, the highest has {}{}",
                                   threshold_hu_, highest_, why.empty() ? "" : "; " + why)};
    }

  private:
    std::filesystem::path path_;
    std::uint64_t voxels_;
    double threshold_hu_;
    std::optional<std::uint64_t> available_bytes_;
    std::optional<HuHistogram> histogram_{};
    std::int16_t highest_ = std::numeric_limits<std::int16_t>::min();
    std::uint64_t bone_voxels_ = 0;
};

HuSlices watched(HuSlices slices, Watch& watch) {
    return {.grid = slices.grid,
            .labelled = slices.labelled,
            .read = [read = std::move(slices.read), &watch](std::span<std::int16_t> hu,
                                                            std::span<std::uint8_t> tissue) {
                read(hu, tissue);
                watch.look_at(hu);
            }};
}

HuSlices labelled(HuSlices slices, const FillLabels& fill_labels) {
    const std::size_t voxels_a_slice = voxels_of_slice(slices.grid);
    return {.grid = slices.grid,
            .labelled = true,
            .read = [read = std::move(slices.read), &fill_labels, voxels_a_slice, z = 0](
                        std::span<std::int16_t> hu, std::span<std::uint8_t> tissue) mutable {
                read(hu, {});
                std::ranges::fill(tissue, std::uint8_t{0});
                fill_labels(z, tissue);
                z += static_cast<int>(tissue.size() / voxels_a_slice);
            }};
}

BoneOfFile read(const std::filesystem::path& path, std::optional<double> threshold,
                const StiffnessRelation& relation, std::optional<std::uint64_t> available_memory_bytes,
                const FillLabels& fill_labels) {
    auto file = std::make_shared<const BoneFile>(path);
    const double threshold_hu = threshold.value_or(file->threshold_hu().value_or(default_threshold_hu));
    if (is_carved(*file)) {
        RestoredBone restored = restore_carved_bone(*file);
        if (restored.bone.stored_bricks() == 0) throw ImagingError(path, "nothing is left of its bone");
        return {.bone = std::move(restored.bone),
                .file = std::move(file),
                .hu_digest = std::move(restored.hu_digest),
                .threshold_hu = threshold_hu,
                .doubt = {}};
    }
    HuReader reader(*file);
    Watch watch(*file, threshold_hu, available_memory_bytes);
    HuSlices slices = watched(slices_of(reader, *file), watch);
    if (fill_labels) slices = labelled(std::move(slices), fill_labels);
    Bone bone = bone_from_hu(slices, threshold_hu, relation);
    if (bone.stored_bricks() == 0) throw watch.no_bone();
    return {.bone = std::move(bone),
            .file = std::move(file),
            .hu_digest = reader.digest(),
            .threshold_hu = threshold_hu,
            .doubt = watch.doubt()};
}

}  // namespace

BoneOfFile bone_of_file(const std::filesystem::path& path, std::optional<double> threshold_hu,
                        const StiffnessRelation& relation,
                        std::optional<std::uint64_t> available_memory_bytes, const FillLabels& fill_labels) {
    try {
        return read(path, threshold_hu, relation, available_memory_bytes, fill_labels);
    } catch (const std::bad_alloc&) {
        throw ImagingError(path, "does not fit in memory");
    }
}

namespace {

std::size_t count_of(const glm::ivec3& size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
}

int coarsening_of(const Grid& grid, std::size_t most_voxels) {
    int coarsening = 1;
    while (count_of((grid.size_voxels + (coarsening - 1)) / coarsening) > most_voxels) ++coarsening;
    return coarsening;
}

}  // namespace

CtVolume ct_overview(const HuSlices& slices, std::size_t most_voxels) {
    const Grid& fine = slices.grid;
    const int by = coarsening_of(fine, most_voxels);
    CtVolume ct{.grid = {.size_voxels = (fine.size_voxels + (by - 1)) / by,
                         .spacing_mm = by * fine.spacing_mm,
                         .origin_mm = fine.origin_mm + 0.5 * (by - 1) * fine.spacing_mm},
                .hu = {}};
    const glm::ivec3 size = ct.grid.size_voxels;
    ct.hu.resize(count_of(size));
    const auto slice_size = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    const auto fine_slice_size =
        static_cast<std::size_t>(fine.size_voxels.x) * static_cast<std::size_t>(fine.size_voxels.y);
    std::vector<std::int16_t> hu(fine_slice_size);
    std::vector<std::uint8_t> tissue(slices.labelled ? fine_slice_size : 0);
    std::vector<std::int32_t> sum(slice_size), count(slice_size);
    for (int z = 0; z < fine.size_voxels.z; ++z) {
        slices.read(hu, tissue);
        for (int y = 0; y < fine.size_voxels.y; ++y)
            for (int x = 0; x < fine.size_voxels.x; ++x) {
                const auto to = static_cast<std::size_t>(x / by) +
                                static_cast<std::size_t>(size.x) * static_cast<std::size_t>(y / by);
                sum[to] += hu[static_cast<std::size_t>(x) +
                              static_cast<std::size_t>(fine.size_voxels.x) * static_cast<std::size_t>(y)];
                ++count[to];
            }
        if ((z + 1) % by != 0 && z + 1 != fine.size_voxels.z) continue;
        const std::size_t first = slice_size * static_cast<std::size_t>(z / by);
        for (std::size_t i = 0; i < slice_size; ++i) {
            ct.hu[first + i] = static_cast<std::int16_t>(std::lround(static_cast<double>(sum[i]) / count[i]));
            sum[i] = count[i] = 0;
        }
    }
    return ct;
}

}  // namespace osteomill
