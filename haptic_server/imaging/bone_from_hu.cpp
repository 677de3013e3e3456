#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>

#include "common/bone/bone_builder.h"
#include "haptic_server/imaging/hu_volume.h"

namespace osteomill {

namespace {

constexpr std::array<glm::ivec3, 6> face_neighbours{glm::ivec3(-1, 0, 0), glm::ivec3(1, 0, 0),
                                                    glm::ivec3(0, -1, 0), glm::ivec3(0, 1, 0),
                                                    glm::ivec3(0, 0, -1), glm::ivec3(0, 0, 1)};

/// Reads the dense volume; beyond its edge the outermost voxels repeat.
class HuField {
  public:
    explicit HuField(const HuVolume& volume) : volume_(volume) {}

    std::size_t index(const glm::ivec3& voxel) const {
        const glm::ivec3 size = volume_.grid.size_voxels;
        const glm::ivec3 within = glm::clamp(voxel, glm::ivec3(0), size - 1);
        return static_cast<std::size_t>(within.x) +
               static_cast<std::size_t>(size.x) *
                   (static_cast<std::size_t>(within.y) + static_cast<std::size_t>(size.y) * within.z);
    }
    double hu(const glm::ivec3& voxel) const { return volume_.hu[index(voxel)]; }
    std::uint8_t label(const glm::ivec3& voxel) const { return volume_.tissue[index(voxel)]; }

    /// Smallest and largest HU of a brick and the voxels around it.
    std::pair<double, double> range_around_brick(const glm::ivec3& brick) const {
        const glm::ivec3 first = glm::max(brick * brick_edge_voxels - 1, glm::ivec3(0));
        const glm::ivec3 end = glm::min((brick + 1) * brick_edge_voxels + 1, volume_.grid.size_voxels);
        std::int16_t lowest = volume_.hu[index(first)];
        std::int16_t highest = lowest;
        for (int z = first.z; z < end.z; ++z)
            for (int y = first.y; y < end.y; ++y) {
                const std::int16_t* row = &volume_.hu[index({first.x, y, z})];
                for (int i = 0; i < end.x - first.x; ++i) {
                    lowest = std::min(lowest, row[i]);
                    highest = std::max(highest, row[i]);
                }
            }
        return {lowest, highest};
    }

  private:
    const HuVolume& volume_;
};

/// Part of a voxel that lies on the bone's side of the surface HU = threshold.
double cover(const HuField& field, const glm::ivec3& voxel, double threshold_hu) {
    bool any_above = false;
    bool any_below = false;
    const auto look = [&](double hu) { (hu >= threshold_hu ? any_above : any_below) = true; };
    look(field.hu(voxel));
    std::array<double, 6> neighbour{};
    for (std::size_t i = 0; i < 6; ++i) look(neighbour[i] = field.hu(voxel + face_neighbours[i]));
    if (!any_below) return 1.0;
    if (!any_above) return 0.0;
    const glm::dvec3 gradient_per_voxel =
        0.5 *
        glm::dvec3(neighbour[1] - neighbour[0], neighbour[3] - neighbour[2], neighbour[5] - neighbour[4]);
    const double steepness = glm::length(gradient_per_voxel);
    const double excess = field.hu(voxel) - threshold_hu;
    if (steepness == 0.0) return excess >= 0.0 ? 1.0 : 0.0;
    return std::clamp(0.5 + excess / steepness, 0.0, 1.0);
}

std::uint8_t stiffness_code(double relative) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(relative / stiffness_per_code), 1L, 255L));
}

/// Codes for every HU of 16 bits, so that a voxel costs a look-up.
std::vector<std::uint8_t> code_table(const StiffnessRelation& relation) {
    std::vector<std::uint8_t> codes(65536);
    for (int hu = -32768; hu < 32768; ++hu)
        codes[static_cast<std::size_t>(hu + 32768)] = stiffness_code(relative_stiffness(relation, hu));
    return codes;
}

/// A brick that may hold bone.
struct Candidate {
    glm::ivec3 brick;
    bool is_all_bone = false;  ///< of its voxels and those around it
};

std::vector<Candidate> candidates(const HuField& field, const Grid& grid, double threshold_hu) {
    const glm::ivec3 size_bricks = size_in_bricks(grid);
    std::vector<Candidate> found;
    for (int z = 0; z < size_bricks.z; ++z)
        for (int y = 0; y < size_bricks.y; ++y)
            for (int x = 0; x < size_bricks.x; ++x) {
                const auto [lowest, highest] = field.range_around_brick({x, y, z});
                if (highest >= threshold_hu) found.push_back({{x, y, z}, lowest >= threshold_hu});
            }
    return found;
}

struct BrickChannels {
    ByteBrick fraction{};
    ByteBrick stiffness{};
    ByteBrick tissue{};
};

/// A voxel on the surface is a mixture with what lies outside: its stiffness and label are those of the bone
/// beside it.
void fill_voxel(const HuField& field, const std::vector<std::uint8_t>& codes, bool labelled,
                const glm::ivec3& voxel, double covered, BrickChannels& out) {
    const std::size_t offset = offset_in_brick(voxel);
    const auto code_at = [&](const glm::ivec3& place) {
        return codes[static_cast<std::size_t>(field.hu(place) + 32768.0)];
    };
    out.fraction[offset] = static_cast<std::uint8_t>(std::lround(255.0 * covered));
    out.stiffness[offset] = code_at(voxel);
    if (labelled) out.tissue[offset] = field.label(voxel);
    const bool unlabelled = labelled && out.tissue[offset] == 0;
    if (covered >= 1.0 && !unlabelled) return;
    for (const glm::ivec3& step : face_neighbours) {
        out.stiffness[offset] = std::max(out.stiffness[offset], code_at(voxel + step));
        if (unlabelled && out.tissue[offset] == 0) out.tissue[offset] = field.label(voxel + step);
    }
}

BrickChannels channels_of(const HuField& field, const std::vector<std::uint8_t>& codes, bool labelled,
                          const Grid& grid, double threshold_hu, const Candidate& candidate) {
    BrickChannels channels;
    const bool is_all_bone = candidate.is_all_bone;
    const glm::ivec3 first = candidate.brick * brick_edge_voxels;
    const glm::ivec3 end = glm::min(first + brick_edge_voxels, grid.size_voxels);
    for (int z = first.z; z < end.z; ++z)
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) {
                const glm::ivec3 voxel(x, y, z);
                const double covered = is_all_bone ? 1.0 : cover(field, voxel, threshold_hu);
                if (covered * 255.0 >= 0.5) fill_voxel(field, codes, labelled, voxel, covered, channels);
            }
    return channels;
}

/// The bone, if all its voxels have one code; gives up at the first that has another, which in CT is soon.
template <typename ChannelsOf>
std::optional<Bone> homogeneous_bone(const Grid& grid, bool labelled, const std::vector<Candidate>& bricks,
                                     const ChannelsOf& channels) {
    std::optional<std::uint8_t> common;
    std::optional<BoneBuilder> builder;
    for (const Candidate& brick : bricks) {
        const BrickChannels filled = channels(brick);
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel) {
            if (filled.fraction[voxel] == 0) continue;
            if (common && *common != filled.stiffness[voxel]) return std::nullopt;
            common = filled.stiffness[voxel];
        }
        if (!common) continue;
        if (!builder) {
            builder = BoneBuilder::homogeneous(grid, *common * stiffness_per_code, labelled);
            builder->reserve_bricks(bricks.size());
        }
        builder->add_brick(brick.brick, filled.fraction, nullptr, &filled.tissue);
    }
    if (!builder) return std::nullopt;
    return std::move(*builder).build();
}

template <typename ChannelsOf>
Bone heterogeneous_bone(const Grid& grid, bool labelled, const std::vector<Candidate>& bricks,
                        const ChannelsOf& channels) {
    BoneBuilder builder = BoneBuilder::heterogeneous(grid, stiffness_per_code, labelled);
    builder.reserve_bricks(bricks.size());
    for (const Candidate& brick : bricks) {
        const BrickChannels filled = channels(brick);
        builder.add_brick(brick.brick, filled.fraction, &filled.stiffness, &filled.tissue);
    }
    return std::move(builder).build();
}

}  // namespace

Bone bone_from_hu(const HuVolume& volume, double threshold_hu, const StiffnessRelation& relation) {
    require_valid(volume.grid);
    require_valid(relation);
    if (!std::isfinite(threshold_hu)) throw std::invalid_argument("the bone threshold is not a finite HU");
    const glm::ivec3 size = volume.grid.size_voxels;
    const std::size_t voxels = static_cast<std::size_t>(size.x) * size.y * size.z;
    const bool labelled = !volume.tissue.empty();
    if (volume.hu.size() != voxels || (labelled && volume.tissue.size() != voxels))
        throw std::invalid_argument("the HU volume's channels do not fit its grid");

    const HuField field(volume);
    const std::vector<std::uint8_t> codes = code_table(relation);
    const std::vector<Candidate> bricks = candidates(field, volume.grid, threshold_hu);
    const auto channels = [&](const Candidate& brick) {
        return channels_of(field, codes, labelled, volume.grid, threshold_hu, brick);
    };

    if (auto bone = homogeneous_bone(volume.grid, labelled, bricks, channels)) return *std::move(bone);
    return heterogeneous_bone(volume.grid, labelled, bricks, channels);
}

}  // namespace osteomill
