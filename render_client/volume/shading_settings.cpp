#include "render_client/volume/shading_settings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <iterator>
#include <map>
#include <numeric>

namespace osteomill {

// Trabecular bone has about a tenth of cortical bone's stiffness, enamel more than twice as much
// (bone_colours.cpp).
glm::vec2 grain_of_stiffness(double relative_stiffness) {
    constexpr double cortical_fine = 0.08, cortical_coarse = 0.05, trabecular_coarse = 0.20;
    const double trabecular = 1.0 - glm::smoothstep(0.15, 0.5, relative_stiffness);
    const double enamel = glm::smoothstep(1.5, 2.2, relative_stiffness);
    return {static_cast<float>(cortical_fine * (1.0 - 0.8 * enamel)),
            static_cast<float>(glm::mix(cortical_coarse, trabecular_coarse, trabecular) * (1.0 - enamel))};
}

namespace {

GrainTable grain_by_stiffness(double stiffness_per_code) {
    GrainTable grain;
    for (std::size_t code = 0; code < grain.size(); ++code)
        grain[code] = grain_of_stiffness(static_cast<double>(code) * stiffness_per_code);
    return grain;
}

TransferTable by_stiffness(const BoneContent& content, const TransferFunction& transfer) {
    require_valid(transfer);
    TransferTable table{.mode = transfer.mode};
    if (content.stiffness.empty()) {
        table.by_code.fill(look_of(transfer, content.homogeneous_stiffness));
        table.grain_by_code.fill(grain_of_stiffness(content.homogeneous_stiffness));
        return table;
    }
    table.codes.channel = BoneChannel::stiffness;
    table.grain_by_code = grain_by_stiffness(content.stiffness_per_code);
    for (std::size_t code = 0; code < table.by_code.size(); ++code)
        table.by_code[code] = look_of(transfer, static_cast<double>(code) * content.stiffness_per_code);
    return table;
}

TransferTable opaque(std::optional<BoneChannel> channel, const ColourTable& colours) {
    TransferTable table{.codes = {.channel = channel}};
    for (std::size_t code = 0; code < colours.size(); ++code)
        table.by_code[code] = glm::vec4(colours[code], 1.0f);
    return table;
}

TransferTable by_tissue(const BoneContent& content, std::span<const TissueColour> tissues) {
    TransferTable table = opaque(BoneChannel::tissue, colours_by_tissue(tissues));
    std::array<double, 256> stiffness{};
    std::array<std::uint8_t, 256> label_by_code{};
    std::iota(label_by_code.begin(), label_by_code.end(), std::uint8_t{0});
    if (const std::optional<TissueShades> shades = tissue_shades(content, tissues)) {
        table = opaque(std::nullopt, shades->by_code);
        table.codes = shades->codes;
        label_by_code = shades->label;
        stiffness = shades->relative_stiffness;
    } else {
        stiffness = median_stiffness_by_label(content);
    }
    std::ranges::transform(stiffness, table.grain_by_code.begin(), grain_of_stiffness);
    for (const TissueColour& tissue : tissues) {
        for (std::size_t code = 0; code < label_by_code.size(); ++code)
            if (label_by_code[code] == tissue.label)
                table.by_code[code].a = static_cast<float>(std::clamp(tissue.opacity, 0.0, 1.0));
        if (tissue.opacity > 0.0 && tissue.opacity < 1.0) table.mode = TransferMode::translucent;
    }
    return table;
}

TransferTable table_without_seen(const BoneContent& content, std::span<const TissueColour> tissues,
                                 const ShadingSettings& look) {
    if (look.transfer) return by_stiffness(content, *look.transfer);
    if (!content.tissue.empty()) return by_tissue(content, tissues);
    if (!content.stiffness.empty()) {
        TransferTable table =
            opaque(BoneChannel::stiffness, colours_by_stiffness(content.stiffness_per_code));
        table.grain_by_code = grain_by_stiffness(content.stiffness_per_code);
        return table;
    }
    ColourTable plain;
    plain.fill(plain_bone_colour());
    TransferTable table = opaque(std::nullopt, plain);
    table.grain_by_code.fill(grain_of_stiffness(content.homogeneous_stiffness));
    return table;
}

bool shows_through(const TissueColour& tissue) {
    return tissue.shows_through_mm > 0.0 && tissue.shows_through_strength > 0.0 && tissue.opacity > 0.0;
}

}  // namespace

TransferTable transfer_table(const BoneContent& content, std::span<const TissueColour> tissues,
                             const ShadingSettings& look) {
    TransferTable table = table_without_seen(content, tissues, look);
    std::vector<TissueColour> seen;
    std::ranges::copy_if(tissues, std::back_inserter(seen), shows_through);
    const bool is_usual_look = !look.transfer && look.shading == Shading::gradient;
    if (is_usual_look && table.mode == TransferMode::surface && !seen.empty())
        table.seen = seen_tissues(seen);
    return table;
}

double colour_depth_voxels(const TransferTable& table) {
    return table.codes.channel == BoneChannel::stiffness || table.codes.are_of_both() ? 2.5 : 1.0;
}

std::array<std::uint8_t, 256> shown_part_by_code(const TransferTable& table) {
    std::array<std::uint8_t, 256> parts{};
    for (std::size_t code = 0; code < parts.size(); ++code) {
        const float opacity = table.by_code[code].a;
        const float part = table.mode == TransferMode::surface ? opacity : std::ceil(opacity);
        parts[code] = static_cast<std::uint8_t>(std::lround(255.0f * part));
    }
    // Code 0 is a voxel of which the channel knows nothing, but it may be bone.
    if (table.codes.exist()) parts[0] = 255;
    return parts;
}

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
