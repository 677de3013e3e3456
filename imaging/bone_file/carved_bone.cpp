#include "imaging/bone_file/carved_bone.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/bone/bone_builder.h"
#include "common/scene/stiffness_relation.h"
#include "imaging/bone_file/nrrd_writer.h"
#include "imaging/bone_from_hu.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr const char* bricks_key = "osteomill_carved_bricks";
constexpr const char* key_of_0_1 = "osteomill_fraction_file";
constexpr const char* bone_checksum_key = "osteomill_bone_checksum";
constexpr const char* stiffness_per_code_key = "osteomill_stiffness_per_code";
constexpr const char* homogeneous_stiffness_key = "osteomill_homogeneous_stiffness";
constexpr const char* bone_grid_key = "osteomill_bone_grid";
constexpr const char* fraction_digest_key = "osteomill_fraction_digest";
constexpr const char* stiffness_digest_key = "osteomill_stiffness_digest";
constexpr const char* tissue_digest_key = "osteomill_tissue_digest";

using KeyValues = std::map<std::string, std::string>;

std::string bone_checksum_text(const Bone& bone) {
    return fmt::format("{:016x}", checksum(bone));
}

/// A number above 0.
double number_of_key(const BoneFile& file, const char* key) {
    const std::string& text = file.value(key);
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(number > 0.0) || number > largest_relative_stiffness)
        throw ImagingError(file.path(), fmt::format("{}:={} is not a number above 0, at most {:g}", key, text,
                                                    largest_relative_stiffness));
    return number;
}

bool has_fraction(BrickFractions fractions) {
    return std::any_of(fractions.begin(), fractions.end(), [](std::uint8_t f) { return f != 0; });
}

/// The record of one brick, before the voxels.
struct BrickRecord {
    BrickIndex brick = 0;
    ByteBrick fraction{};
    ByteBrick stiffness{};
    ByteBrick tissue{};
};

/// Which of the channels are there; calls visit with the bytes of each, in their order in the file.
struct RecordLayout {
    bool has_stiffness = false;
    bool has_tissue = false;

    std::uint64_t bytes() const {
        return sizeof(BrickIndex) +
               brick_voxel_count * (1u + (has_stiffness ? 1u : 0u) + (has_tissue ? 1u : 0u));
    }
    template <typename Record, typename Visit>
    void for_each_part(Record& record, const Visit& visit) const {
        visit(std::span(&record.brick, 1));
        visit(std::span(record.fraction));
        if (has_stiffness) visit(std::span(record.stiffness));
        if (has_tissue) visit(std::span(record.tissue));
    }
};

struct ChannelDigests {
    Digest fraction;  ///< and which bricks they belong to
    Digest stiffness;
    Digest tissue;

    void add(const BrickRecord& record, const RecordLayout& layout) {
        fraction.add(std::as_bytes(std::span(&record.brick, 1)));
        fraction.add(std::as_bytes(std::span(record.fraction)));
        if (layout.has_stiffness) stiffness.add(std::as_bytes(std::span(record.stiffness)));
        if (layout.has_tissue) tissue.add(std::as_bytes(std::span(record.tissue)));
    }
};

/// Calls visit(record) for every brick of which anything is left, ascending.
template <typename Visit>
void for_each_record(const Bone& bone, const RecordLayout& layout, const Visit& visit) {
    const BoneContent& content = bone.content();
    BrickRecord record;
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const auto left = bone.fractions(static_cast<std::int32_t>(slot));
        if (!has_fraction(left)) continue;
        record.brick = content.brick_of_slot[slot];
        std::copy(left.begin(), left.end(), record.fraction.begin());
        if (layout.has_stiffness) record.stiffness = content.stiffness[slot];
        if (layout.has_tissue) record.tissue = content.tissue[slot];
        visit(std::as_const(record));
    }
}

/// Keys of all but the HU.
KeyValues describe(const Bone& bone, const RecordLayout& layout, std::uint64_t& bricks) {
    ChannelDigests digests;
    bricks = 0;
    for_each_record(bone, layout, [&](const BrickRecord& record) {
        digests.add(record, layout);
        ++bricks;
    });
    KeyValues keys{{bricks_key, fmt::format("{}", bricks)},
                   {bone_checksum_key, bone_checksum_text(bone)},
                   {fraction_digest_key, digests.fraction.text()}};
    if (layout.has_stiffness) {
        keys[stiffness_per_code_key] = fmt::format("{}", bone.content().stiffness_per_code);
        keys[stiffness_digest_key] = digests.stiffness.text();
    } else {
        keys[homogeneous_stiffness_key] = fmt::format("{}", bone.content().homogeneous_stiffness);
    }
    if (layout.has_tissue) keys[tissue_digest_key] = digests.tissue.text();
    return keys;
}

/// Sets milled voxels to air in the layer of slices from `first_z` on, at which bricks begin.
///
/// Only bone can have been milled away: air and soft tissue have no fraction to lose, and a voxel outside
/// bone, stored with fraction 0, has no stiffness code, which only bone has.
void clear_milled(const Bone& bone, int first_z, std::span<std::int16_t> hu) {
    const Grid& grid = bone.grid();
    const BoneContent& content = bone.content();
    const auto per_layer =
        static_cast<BrickIndex>(content.size_bricks.x) * static_cast<BrickIndex>(content.size_bricks.y);
    const BrickIndex first = per_layer * static_cast<BrickIndex>(first_z / brick_edge_voxels);
    auto slot = static_cast<std::size_t>(
        std::lower_bound(content.brick_of_slot.begin(), content.brick_of_slot.end(), first) -
        content.brick_of_slot.begin());
    for (; slot < bone.stored_bricks() && content.brick_of_slot[slot] - first < per_layer; ++slot) {
        const auto left = bone.fractions(static_cast<std::int32_t>(slot));
        const glm::ivec3 corner =
            brick_position(content.size_bricks, content.brick_of_slot[slot]) * brick_edge_voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const bool was_bone = content.stiffness.empty() || content.stiffness[slot][offset] != 0;
            if (left[offset] != 0 || !was_bone) continue;
            const glm::ivec3 voxel = corner + voxel_in_brick(offset);
            if (!contains(grid, voxel)) continue;
            hu[static_cast<std::size_t>(voxel.x) +
               static_cast<std::size_t>(grid.size_voxels.x) *
                   (static_cast<std::size_t>(voxel.y) + static_cast<std::size_t>(grid.size_voxels.y) *
                                                            static_cast<std::size_t>(voxel.z - first_z))] =
                milled_away_hu;
        }
    }
}

/// Changes slices that were read, from `first_z` on.
using ChangeSlices = std::function<void(int first_z, std::span<std::int16_t> hu)>;

/// The bone, and behind it the slices as `change` leaves them.
void save(const std::filesystem::path& path, const Bone& bone, const HuSlices& slices,
          const ChangeSlices& change, const KeyValues& more_keys, const ReportProgress& report) {
    const RecordLayout layout{.has_stiffness = !bone.content().stiffness.empty(),
                              .has_tissue = !bone.content().tissue.empty()};
    std::uint64_t bricks = 0;
    KeyValues key_values = describe(bone, layout, bricks);
    key_values.insert(more_keys.begin(), more_keys.end());

    BoneFileWriter writer(path, slices.grid, std::move(key_values), bricks * layout.bytes());
    for_each_record(bone, layout, [&](const BrickRecord& record) {
        layout.for_each_part(record,
                             [&](const auto& part) { writer.add_before_voxels(std::as_bytes(part)); });
    });
    const auto slice = static_cast<std::size_t>(voxels_of_slice(slices.grid));
    const int end = slices.grid.size_voxels.z;
    const auto layer_slices = static_cast<std::size_t>(std::min(end, brick_edge_voxels));
    std::vector<std::int16_t> layer(slice * layer_slices);
    std::vector<std::uint8_t> labels(slices.labelled ? layer.size() : 0);  // which are made with the HU
    for (int z = 0; z < end; z += brick_edge_voxels) {
        const std::size_t voxels = slice * static_cast<std::size_t>(std::min(end - z, brick_edge_voxels));
        const auto hu = std::span(layer).first(voxels);
        slices.read(hu, std::span(labels).first(slices.labelled ? voxels : 0));
        change(z, hu);
        writer.add(hu);
        report(static_cast<double>(z) / end);
    }
    writer.commit();
    report(1.0);
}

std::string text_of(const Grid& grid) {
    return fmt::format("{} {} {} {} {} {} {}", grid.size_voxels.x, grid.size_voxels.y, grid.size_voxels.z,
                       grid.spacing_mm, grid.origin_mm.x, grid.origin_mm.y, grid.origin_mm.z);
}

/// The bone's grid, which is finer than the grid of the file's voxels if those are a picture of the bone.
Grid bone_grid_of(const BoneFile& file) {
    if (!file.key_values().contains(bone_grid_key)) return file.grid();
    Grid grid;
    std::istringstream text(file.value(bone_grid_key));
    text >> grid.size_voxels.x >> grid.size_voxels.y >> grid.size_voxels.z >> grid.spacing_mm >>
        grid.origin_mm.x >> grid.origin_mm.y >> grid.origin_mm.z;
    try {
        require_valid(grid);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(file.path(), fmt::format("damaged: {}: {}", bone_grid_key, error.what()));
    }
    if (text.fail() || picture_grid(grid).size_voxels != file.grid().size_voxels)
        throw ImagingError(file.path(), fmt::format("damaged: {}:={} is not the grid of a bone that its "
                                                    "voxels show",
                                                    bone_grid_key, file.value(bone_grid_key)));
    return grid;
}

BoneBuilder builder_for(const BoneFile& file, const Grid& grid, const RecordLayout& layout) {
    return layout.has_stiffness
               ? BoneBuilder::heterogeneous(grid, number_of_key(file, stiffness_per_code_key),
                                            layout.has_tissue)
               : BoneBuilder::homogeneous(grid, number_of_key(file, homogeneous_stiffness_key),
                                          layout.has_tissue);
}

}  // namespace

void save_carved_bone(const std::filesystem::path& path, const HuSlices& source, const Bone& bone,
                      const KeyValues& key_values, const ReportProgress& report) {
    if (source.grid != bone.grid())
        throw std::invalid_argument(
            "the carved bone does not lie on the grid of the volume it was built from");
    save(
        path, bone, source, [&](int z, std::span<std::int16_t> hu) { clear_milled(bone, z, hu); }, key_values,
        report);
}

void save_carved_bone(const std::filesystem::path& path, const Bone& bone, KeyValues key_values,
                      const ReportProgress& report) {
    const HuSlices picture = picture_of(bone);
    if (picture.grid != bone.grid()) key_values[bone_grid_key] = text_of(bone.grid());
    save(
        path, bone, picture, [](int, std::span<std::int16_t>) {}, key_values, report);
}

bool is_carved(const BoneFile& file) {
    return file.key_values().contains(bricks_key) || file.key_values().contains(key_of_0_1);
}

RestoredBone restore_carved_bone(const BoneFile& file) {
    if (file.key_values().contains(key_of_0_1))
        throw ImagingError(
            file.path(),
            "was saved by version 0.1, in several files; load it with version 0.2 and save it again");
    const RecordLayout layout{.has_stiffness = file.key_values().contains(stiffness_digest_key),
                              .has_tissue = file.key_values().contains(tissue_digest_key)};
    const auto bricks =
        static_cast<std::uint64_t>(std::strtoull(file.value(bricks_key).c_str(), nullptr, 10));
    if (bricks * layout.bytes() != file.form().bytes_before_voxels)
        throw ImagingError(file.path(), fmt::format("damaged: {}:={} does not fit its byte skip of {}",
                                                    bricks_key, bricks, file.form().bytes_before_voxels));
    NrrdData data = file.data();
    ChannelDigests digests;
    const Grid grid = bone_grid_of(file);
    BoneBuilder builder = builder_for(file, grid, layout);
    const glm::ivec3 size_bricks = size_in_bricks(grid);
    std::string misplaced;
    for (std::uint64_t i = 0; i < bricks; ++i) {
        BrickRecord record;
        layout.for_each_part(
            record, [&](const auto& part) { data.read_before_voxels(std::as_writable_bytes(part)); });
        digests.add(record, layout);
        try {
            builder.add_brick(brick_position(size_bricks, record.brick), record.fraction, &record.stiffness,
                              &record.tissue);
        } catch (const std::invalid_argument& error) {
            misplaced = error.what();  // the digest's error is clearer
        }
    }
    require_digest(file, fraction_digest_key, digests.fraction, "fractions (what is left of each voxel) are");
    if (layout.has_stiffness)
        require_digest(file, stiffness_digest_key, digests.stiffness, "stiffness codes are");
    if (layout.has_tissue) require_digest(file, tissue_digest_key, digests.tissue, "tissue labels are");
    if (!misplaced.empty()) throw ImagingError(file.path(), "damaged: " + misplaced);
    HuReader hu(file, std::move(data));
    hu.read_to_end();
    try {
        Bone bone = std::move(builder).build();
        if (bone_checksum_text(bone) != file.value(bone_checksum_key))
            throw ImagingError(file.path(),
                               fmt::format("its bone has checksum {}, not the {} that was saved",
                                           bone_checksum_text(bone), file.value(bone_checksum_key)));
        return {std::move(bone), hu.digest()};
    } catch (const std::invalid_argument& error) {
        throw ImagingError(file.path(), std::string("damaged: ") + error.what());
    }
}

namespace {

constexpr std::uint64_t most_voxels_of_picture = std::uint64_t{1} << 25;

Grid coarser(const Grid& grid, int times) {
    Grid coarse = grid;
    coarse.size_voxels = (grid.size_voxels + times - 1) / times;
    coarse.spacing_mm = grid.spacing_mm * times;
    coarse.origin_mm = grid.origin_mm + 0.5 * (times - 1) * grid.spacing_mm;
    return coarse;
}

/// Edge of the picture's voxels in voxels of the bone: a power of two, so that none lies in two bricks.
int times_as_long(const Grid& bone) {
    int times = 1;
    while (times < brick_edge_voxels && voxel_count(coarser(bone, times)) > most_voxels_of_picture)
        times *= 2;
    return times;
}

/// The bone left in a brick, summed over the picture's voxels in it, x fastest.
struct BrickSums {
    std::array<std::uint32_t, brick_voxel_count> left{};

    BrickSums(BrickFractions fractions, int times) {
        const int halvings = std::countr_zero(static_cast<unsigned>(times));
        const int edge = brick_edge_voxels >> halvings;
        // Most bricks are whole.
        if (std::memcmp(fractions.data(), fractions.data() + 1, fractions.size() - 1) == 0) {
            left.fill(static_cast<std::uint32_t>(fractions[0]) << 3 * halvings);
            return;
        }
        std::size_t offset = 0;
        for (int z = 0; z < brick_edge_voxels; ++z)
            for (int y = 0; y < brick_edge_voxels; ++y) {
                const std::span row(
                    &left[static_cast<std::size_t>(edge * ((y >> halvings) + edge * (z >> halvings)))],
                    static_cast<std::size_t>(edge));
                for (std::size_t x = 0; x < brick_edge_voxels; ++x) row[x >> halvings] += fractions[offset++];
            }
    }
};

}  // namespace

Grid picture_grid(const Grid& bone) {
    return coarser(bone, times_as_long(bone));
}

HuSlices picture_of(const Bone& bone) {
    const int times = times_as_long(bone.grid());
    const Grid grid = coarser(bone.grid(), times);
    const auto read = [&bone, grid, times, z = 0](std::span<std::int16_t> hu,
                                                  std::span<std::uint8_t>) mutable {
        const auto slice = static_cast<std::size_t>(voxels_of_slice(grid));
        const int end = z + static_cast<int>(hu.size() / slice);
        const int edge = brick_edge_voxels / times;
        const auto whole =
            static_cast<std::uint64_t>(255) * static_cast<std::uint64_t>(times * times * times);
        constexpr auto span_hu = static_cast<std::uint64_t>(reference_bone_hu - air_hu);
        std::fill(hu.begin(), hu.end(), air_hu);
        const BoneContent& content = bone.content();
        for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
            const glm::ivec3 corner = brick_position(content.size_bricks, content.brick_of_slot[slot]) * edge;
            if (corner.z >= end || corner.z + edge <= z) continue;
            const BrickSums sums(bone.fractions(static_cast<std::int32_t>(slot)), times);
            std::size_t i = 0;
            for (int dz = 0; dz < edge; ++dz)
                for (int dy = 0; dy < edge; ++dy)
                    for (int dx = 0; dx < edge; ++dx, ++i) {
                        const glm::ivec3 voxel = corner + glm::ivec3(dx, dy, dz);
                        if (sums.left[i] == 0 || voxel.z < z || voxel.z >= end) continue;
                        hu[static_cast<std::size_t>(voxel.x) +
                           static_cast<std::size_t>(grid.size_voxels.x) * static_cast<std::size_t>(voxel.y) +
                           slice * static_cast<std::size_t>(voxel.z - z)] =
                            static_cast<std::int16_t>(air_hu +
                                                      static_cast<int>(span_hu * sums.left[i] / whole));
                    }
        }
        z = end;
    };
    return {.grid = grid, .labelled = false, .read = read};
}

}  // namespace osteomill
