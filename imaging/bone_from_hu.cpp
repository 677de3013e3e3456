#include "imaging/bone_from_hu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "common/bone/bone_builder.h"

namespace osteomill {

namespace {

constexpr std::array<glm::ivec3, 6> face_neighbours{glm::ivec3(-1, 0, 0), glm::ivec3(1, 0, 0),
                                                    glm::ivec3(0, -1, 0), glm::ivec3(0, 1, 0),
                                                    glm::ivec3(0, 0, -1), glm::ivec3(0, 0, 1)};

/// The slices of one layer of bricks, and one below and above; beyond the grid's edge the outermost voxels
/// repeat.
class HuLayer {
  public:
    explicit HuLayer(const HuSlices& slices)
        : slices_(slices),
          size_(slices.grid.size_voxels),
          slice_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y)),
          hu_(slice_ * std::min(held_slices, static_cast<std::size_t>(size_.z) + 1)),
          label_(slices.labelled ? hu_.size() : 0),
          lowest_(static_cast<std::size_t>(size_.x)),
          highest_(lowest_) {}

    /// To be called for each layer, ascending.
    void read(int layer) {
        const int first = layer * brick_edge_voxels;
        if (layer > 0) {
            keep_last_two(hu_);
            keep_last_two(label_);
        }
        base_z_ = first - 1;
        const int from = layer == 0 ? 0 : first + 1;
        const int end = std::min(first + brick_edge_voxels + 1, size_.z);
        if (from >= end) return;
        const std::size_t offset = slice_ * static_cast<std::size_t>(from - base_z_);
        const std::size_t count = slice_ * static_cast<std::size_t>(end - from);
        slices_.read(std::span(hu_).subspan(offset, count),
                     slices_.labelled ? std::span(label_).subspan(offset, count) : std::span<std::uint8_t>());
    }

    std::size_t index(const glm::ivec3& voxel) const {
        const glm::ivec3 within = glm::clamp(voxel, glm::ivec3(0), size_ - 1);
        return static_cast<std::size_t>(within.x) +
               static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(within.y) +
               slice_ * static_cast<std::size_t>(within.z - base_z_);
    }
    double hu(const glm::ivec3& voxel) const { return hu_[index(voxel)]; }
    std::uint8_t label(const glm::ivec3& voxel) const { return label_[index(voxel)]; }

    /// To be called for each row of bricks before its bricks are requested: the extremes over y and z, for
    /// each x. Whole rows, since compilers make these fast.
    void look_at_row(int brick_y, int brick_z) {
        const glm::ivec2 first =
            glm::max(glm::ivec2(brick_y, brick_z) * brick_edge_voxels - 1, glm::ivec2(0));
        const glm::ivec2 end = glm::min((glm::ivec2(brick_y, brick_z) + 1) * brick_edge_voxels + 1,
                                        glm::ivec2(size_.y, size_.z));
        std::copy_n(&hu_[index({0, first.x, first.y})], size_.x, lowest_.begin());
        highest_ = lowest_;
        for (int z = first.y; z < end.y; ++z)
            for (int y = first.x; y < end.x; ++y) {
                const std::int16_t* row = &hu_[index({0, y, z})];
                std::int16_t* low = lowest_.data();
                std::int16_t* high = highest_.data();
                for (int x = 0; x < size_.x; ++x) {
                    low[x] = std::min(low[x], row[x]);
                    high[x] = std::max(high[x], row[x]);
                }
            }
    }

    /// Smallest and largest HU of a brick of that row and the voxels around it.
    std::pair<double, double> range_around_brick(int brick_x) const {
        const int first = std::max(brick_x * brick_edge_voxels - 1, 0);
        const int end = std::min((brick_x + 1) * brick_edge_voxels + 1, size_.x);
        return {*std::min_element(lowest_.begin() + first, lowest_.begin() + end),
                *std::max_element(highest_.begin() + first, highest_.begin() + end)};
    }

  private:
    static constexpr std::size_t held_slices = brick_edge_voxels + 2;

    template <typename Voxel>
    void keep_last_two(std::vector<Voxel>& channel) const {
        if (channel.empty()) return;
        const auto last_two = channel.begin() + static_cast<std::ptrdiff_t>(slice_ * brick_edge_voxels);
        std::copy(last_two, channel.end(), channel.begin());
    }

    const HuSlices& slices_;
    glm::ivec3 size_;
    std::size_t slice_;
    int base_z_ = 0;  // z of the first slice held
    std::vector<std::int16_t> hu_;
    std::vector<std::uint8_t> label_;
    std::vector<std::int16_t> lowest_, highest_;  // see look_at_row
};

/// Part of a voxel that lies on the bone's side of the surface HU = threshold.
double cover(const HuLayer& field, const glm::ivec3& voxel, double threshold_hu) {
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

double cover(const HuSlices& slices, const HuLayer& field, const glm::ivec3& voxel, double threshold_hu) {
    if (!slices.surface_distance_voxels) return cover(field, voxel, threshold_hu);
    return std::clamp(0.5 - slices.surface_distance_voxels(voxel), 0.0, 1.0);
}

std::uint8_t stiffness_code(double relative) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(relative / stiffness_per_code), 1L, 255L));
}

/// Stiffness codes for every HU of 16 bits, so that a voxel costs a look-up, and of the tissues that have
/// one, or a factor, of their own.
struct CodeTable {
    explicit CodeTable(const StiffnessRelation& relation) : of_hu(65536) {
        for (int hu = -32768; hu < 32768; ++hu)
            of_hu[static_cast<std::size_t>(hu + 32768)] = stiffness_code(relative_stiffness(relation, hu));
        for (const TissueStiffness& tissue : relation.tissues)
            of_tissue[tissue.label] = stiffness_code(tissue.relative_stiffness);
        for (const TissueFactor& tissue : relation.factors) {
            auto& codes = of_hu_in[tissue.label];
            codes.resize(65536);
            for (int hu = -32768; hu < 32768; ++hu)
                codes[static_cast<std::size_t>(hu + 32768)] =
                    stiffness_code(tissue.factor * relative_stiffness(relation, hu));
        }
    }

    std::uint8_t at(double hu, std::uint8_t label) const {
        if (of_tissue[label] != 0) return of_tissue[label];
        const auto index = static_cast<std::size_t>(hu + 32768.0);
        return of_hu_in[label].empty() ? of_hu[index] : of_hu_in[label][index];
    }

    std::vector<std::uint8_t> of_hu;
    std::array<std::uint8_t, 256> of_tissue{};              // 0: from the HU
    std::array<std::vector<std::uint8_t>, 256> of_hu_in{};  // by tissue; empty: as of_hu
};

struct BrickChannels {
    ByteBrick fraction{};
    ByteBrick stiffness{};
    ByteBrick tissue{};
};

/// The label for a surface voxel that the segmentation leaves out: that of the neighbour towards which the HU
/// rise most, if that neighbour is bone. The voxel's bone lies on that side.
std::uint8_t label_from_inside(const HuLayer& field, const glm::ivec3& voxel, double threshold_hu) {
    double steepest = 0.0;
    glm::ivec3 inner = voxel;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const glm::ivec3 back = voxel + face_neighbours[2 * axis];
        const glm::ivec3 ahead = voxel + face_neighbours[2 * axis + 1];
        const double rise = field.hu(ahead) - field.hu(back);
        if (std::abs(rise) <= steepest) continue;
        steepest = std::abs(rise);
        inner = rise > 0.0 ? ahead : back;
    }
    return field.hu(inner) >= threshold_hu ? field.label(inner) : std::uint8_t{0};
}

/// A voxel on the surface is a mixture of bone and its surroundings, so it takes the HU of the bone beside
/// it.
void fill_voxel(const HuLayer& field, const CodeTable& codes, bool labelled, const glm::ivec3& voxel,
                double covered, double threshold_hu, BrickChannels& out) {
    const std::size_t offset = offset_in_brick(voxel);
    const bool on_surface = covered < 1.0;
    std::uint8_t label = labelled ? field.label(voxel) : std::uint8_t{0};
    if (labelled && on_surface && label == 0) label = label_from_inside(field, voxel, threshold_hu);
    std::uint8_t code = codes.at(field.hu(voxel), label);
    for (std::size_t i = 0; on_surface && i < face_neighbours.size(); ++i)
        code = std::max(code, codes.at(field.hu(voxel + face_neighbours[i]), label));
    out.fraction[offset] = static_cast<std::uint8_t>(std::lround(255.0 * covered));
    out.stiffness[offset] = code;
    out.tissue[offset] = label;
}

BrickChannels channels_of(const HuSlices& slices, const HuLayer& field, const CodeTable& codes,
                          double threshold_hu, const glm::ivec3& brick, bool is_all_bone) {
    BrickChannels channels;
    const glm::ivec3 first = brick * brick_edge_voxels;
    const glm::ivec3 end = glm::min(first + brick_edge_voxels, slices.grid.size_voxels);
    for (int z = first.z; z < end.z; ++z)
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) {
                const glm::ivec3 voxel(x, y, z);
                const double covered = is_all_bone ? 1.0 : cover(slices, field, voxel, threshold_hu);
                if (covered * 255.0 >= 0.5)
                    fill_voxel(field, codes, slices.labelled, voxel, covered, threshold_hu, channels);
            }
    return channels;
}

/// Takes bricks in; keeps no stiffness channel until a second code comes, which in CT is soon.
class BrickCollector {
  public:
    BrickCollector(const Grid& grid, bool labelled) : grid_(grid), labelled_(labelled) {}

    void add(const glm::ivec3& brick, const BrickChannels& filled) {
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
            if (filled.fraction[voxel] != 0) look_at(filled.stiffness[voxel]);
        if (builder_) builder_->add_brick(brick, filled.fraction, &filled.stiffness, &filled.tissue);
    }

    Bone build() && {
        if (!builder_) return BoneBuilder::heterogeneous(grid_, stiffness_per_code, labelled_).build();
        return std::move(*builder_).build();
    }

  private:
    void look_at(std::uint8_t code) {
        if (is_heterogeneous_ || (builder_ && code == first_code_)) return;
        if (builder_) {
            builder_->make_heterogeneous(stiffness_per_code, first_code_);
            is_heterogeneous_ = true;
        } else {
            builder_ = BoneBuilder::homogeneous(grid_, code * stiffness_per_code, labelled_);
            first_code_ = code;
        }
    }

    Grid grid_;
    bool labelled_;
    bool is_heterogeneous_ = false;
    std::uint8_t first_code_ = 0;
    std::optional<BoneBuilder> builder_{};
};

}  // namespace

Bone bone_from_hu(const HuSlices& slices, double threshold_hu, const StiffnessRelation& relation) {
    require_valid(slices.grid);
    require_valid(relation);
    if (!std::isfinite(threshold_hu)) throw std::invalid_argument("the bone threshold is not a finite HU");
    const CodeTable codes(relation);
    HuLayer layer(slices);
    BrickCollector collector(slices.grid, slices.labelled);
    const glm::ivec3 size_bricks = size_in_bricks(slices.grid);
    for (int z = 0; z < size_bricks.z; ++z) {
        layer.read(z);
        for (int y = 0; y < size_bricks.y; ++y) {
            layer.look_at_row(y, z);
            for (int x = 0; x < size_bricks.x; ++x) {
                const auto [lowest, highest] = layer.range_around_brick(x);
                if (highest < threshold_hu) continue;
                collector.add({x, y, z}, channels_of(slices, layer, codes, threshold_hu, {x, y, z},
                                                     lowest >= threshold_hu));
            }
        }
    }
    return std::move(collector).build();
}

}  // namespace osteomill
