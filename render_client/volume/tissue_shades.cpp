#include "render_client/volume/tissue_shades.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <map>

namespace osteomill {

namespace {

constexpr std::size_t most_bricks_looked_at = 1000;
constexpr std::size_t usable_codes = 255;  // 0 is no bone
constexpr std::size_t most_shades = 32;    // of a tissue: neighbours differ by less than one sees
constexpr double least_variation = 1.1;
constexpr float darkest_ratio = 0.45f, brightest_ratio = 1.6f;

using StiffnessCounts = std::array<std::size_t, 256>;

/// Count of each stiffness code, by label.
std::map<std::uint8_t, StiffnessCounts> counts_by_label(const BoneContent& content) {
    std::map<std::uint8_t, StiffnessCounts> counts;
    const std::size_t bricks = content.tissue.size();
    const std::size_t stride = (bricks + most_bricks_looked_at - 1) / most_bricks_looked_at;
    for (std::size_t slot = 0; slot < bricks; slot += stride)
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
            if (const std::uint8_t stiffness = content.stiffness[slot][voxel]; stiffness > 0)
                ++counts[content.tissue[slot][voxel]][stiffness];
    return counts;
}

/// The stiffness code below which a share of a tissue's voxels lies.
std::uint8_t percentile(const StiffnessCounts& counts, double share) {
    std::size_t all = 0;
    for (const std::size_t count : counts) all += count;
    std::size_t below = 0;
    for (std::size_t code = 0; code < counts.size(); ++code) {
        below += counts[code];
        if (static_cast<double>(below) > share * static_cast<double>(all))
            return static_cast<std::uint8_t>(code);
    }
    return 255;
}

struct Range {
    std::uint8_t soft = 0, median = 0, hard = 0;  ///< stiffness codes
    std::size_t shades = 1;

    bool varies() const { return hard >= soft + 2 && hard >= least_variation * soft; }
    /// Number of the shade of a stiffness, from 0.
    std::size_t shade_of(std::size_t stiffness) const {
        const std::size_t above = std::clamp<std::size_t>(stiffness, soft, hard) - soft;
        return shades == 1 ? 0 : (above * (shades - 1) + (hard - soft) / 2) / (hard - soft);
    }
    /// The stiffness in the middle of a shade.
    double stiffness_of(std::size_t shade) const {
        return shades == 1
                   ? median
                   : soft + static_cast<double>(shade) * (hard - soft) / static_cast<double>(shades - 1);
    }
};

std::map<std::uint8_t, Range> ranges_by_label(const BoneContent& content) {
    std::map<std::uint8_t, Range> ranges;
    std::size_t varying = 0;
    for (const auto& [label, counts] : counts_by_label(content)) {
        const Range range{percentile(counts, 0.05), percentile(counts, 0.5), percentile(counts, 0.95)};
        ranges[label] = range;
        if (range.varies()) ++varying;
    }
    if (varying == 0 || ranges.size() > usable_codes) return {};
    const std::size_t each = (usable_codes - (ranges.size() - varying)) / varying;
    for (auto& [label, range] : ranges)
        if (range.varies())
            range.shades = std::clamp<std::size_t>(
                each, 1, std::min<std::size_t>(most_shades, range.hard - range.soft + 1u));
    return ranges;
}

}  // namespace

std::optional<TissueShades> tissue_shades(const BoneContent& content, std::span<const TissueColour> tissues) {
    if (content.tissue.empty() || content.stiffness.empty()) return std::nullopt;
    const std::map<std::uint8_t, Range> ranges = ranges_by_label(content);
    if (ranges.empty()) return std::nullopt;
    const ColourTable own = colours_by_tissue(tissues);
    TissueShades shades;
    shades.codes.by_tissue_and_stiffness.assign(std::size_t{256} * 256, std::uint8_t{0});
    shades.by_code.fill(plain_bone_colour());
    shades.relative_stiffness.fill(1.0);
    std::size_t first_code = 1;
    for (const auto& [label, range] : ranges) {
        const glm::vec3 median_colour = colour_of_stiffness(content.stiffness_per_code * range.median);
        for (std::size_t shade = 0; shade < range.shades; ++shade) {
            const glm::vec3 ratio =
                colour_of_stiffness(content.stiffness_per_code * range.stiffness_of(shade)) / median_colour;
            const std::size_t code = first_code + shade;
            shades.by_code[code] =
                glm::min(own[label] * glm::clamp(ratio, darkest_ratio, brightest_ratio), glm::vec3(1.0f));
            shades.label[code] = label;
            shades.relative_stiffness[code] = content.stiffness_per_code * range.stiffness_of(shade);
        }
        for (std::size_t stiffness = 1; stiffness < 256; ++stiffness)
            shades.codes.by_tissue_and_stiffness[std::size_t{256} * label + stiffness] =
                static_cast<std::uint8_t>(first_code + range.shade_of(stiffness));
        first_code += range.shades;
    }
    return shades;
}

std::array<double, 256> median_stiffness_by_label(const BoneContent& content) {
    std::array<double, 256> medians{};
    medians.fill(content.stiffness.empty() ? content.homogeneous_stiffness : 1.0);
    if (!content.stiffness.empty() && !content.tissue.empty())
        for (const auto& [label, counts] : counts_by_label(content))
            medians[label] = content.stiffness_per_code * percentile(counts, 0.5);
    return medians;
}

}  // namespace osteomill
