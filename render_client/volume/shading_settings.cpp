#include "render_client/volume/shading_settings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "render_client/volume/tissue_shades.h"

namespace osteomill {

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

}  // namespace

namespace {

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

}  // namespace osteomill
