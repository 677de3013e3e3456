#include "common/scene/tissue_tables.h"

#include <fmt/format.h>

#include <array>
#include <set>
#include <string>
#include <utility>

#include "common/scene/material.h"
#include "common/scene/scene_keys.h"
#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

std::optional<std::array<std::uint8_t, 3>> read_colour(TomlReader& reader, const char* key) {
    const std::optional<std::string> said = reader.text(key);
    if (!said) return std::nullopt;
    const std::string& text = *said;
    const bool good = text.size() == 7 && text[0] == '#' &&
                      text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!good) reader.fail(key, fmt::format("'{}' must look like \"#f6f4ec\"", key));
    const unsigned long rgb = std::stoul(text.substr(1), nullptr, 16);
    return std::array{static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U & 0xffU),
                      static_cast<std::uint8_t>(rgb & 0xffU)};
}

std::optional<TissueStrength> read_strength(TomlReader& reader) {
    std::vector<std::string> names;
    for (const Material& material : shipped_materials()) names.push_back(material.name);
    const std::optional<std::size_t> preset = reader.choice("material", names);
    const std::optional<double> stiffness =
        reader.number("relative_stiffness", {stiffness_per_code, largest_relative_stiffness});
    const std::optional<double> edge = reader.number("relative_edge", {0.0, 100.0});
    if (preset) {
        const Material& material = shipped_materials()[*preset];
        return TissueStrength{material.name, stiffness.value_or(material.relative_stiffness),
                              edge.value_or(material.relative_edge)};
    }
    if (edge && !stiffness)
        reader.fail("relative_edge", "'relative_edge' goes with 'relative_stiffness' or 'material'");
    if (stiffness) return TissueStrength{{}, *stiffness, edge.value_or(*stiffness)};
    return std::nullopt;
}

/// If a tissue's strength is given, a bone must be able to hold its product with the factor.
void require_that_bone_holds(double factor, const std::optional<TissueStrength>& strength,
                             const TomlReader& reader) {
    if (strength && !(factor * strength->relative_stiffness >= stiffness_per_code &&
                      factor * strength->relative_stiffness <= largest_relative_stiffness))
        reader.fail(
            "stiffness_factor",
            fmt::format("'stiffness_factor' times the tissue's relative stiffness {} must be {:g} to {:g}",
                        strength->relative_stiffness, stiffness_per_code, largest_relative_stiffness));
}

}  // namespace

std::vector<Tissue> read_tissues(std::vector<TomlReader> readers, bool has_segmentation) {
    std::vector<Tissue> tissues;
    std::set<int> labels;
    std::set<std::string> names;
    for (TomlReader& reader : readers) {
        Tissue tissue;
        tissue.label =
            static_cast<std::uint8_t>(required(reader, "label", reader.whole_number("label", 1, 255)));
        tissue.name = required(reader, "name", reader.text("name"));
        tissue.colour_rgb = required(reader, "colour", read_colour(reader, "colour"));
        tissue.identifier_rgb = read_colour(reader, "identifier");
        if (tissue.identifier_rgb == tissue.colour_rgb) tissue.identifier_rgb.reset();
        scene_keys::of_tissue(reader, tissue, Tissue());
        tissue.strength = read_strength(reader);
        scene_keys::of_tissue_under_burr(reader, tissue, Tissue());
        require_that_bone_holds(tissue.stiffness_factor, tissue.strength, reader);
        if (!tissue.segment.empty() && !has_segmentation)
            reader.fail("segment", "'segment' needs [bone] segmentation = \"FILE.seg.nrrd\"");
        reader.refuse_other_keys();
        if (!labels.insert(tissue.label).second)
            reader.fail("label", fmt::format("label {} stands for two tissues", tissue.label));
        if (is_name_of_sum(tissue.name))
            reader.fail("name",
                        fmt::format("'name' is \"{}\", as reports call a sum; give it another", tissue.name));
        if (!names.insert(tissue.name).second)
            reader.fail("name", fmt::format("two tissues are called \"{}\"", one_line(tissue.name)));
        tissues.push_back(std::move(tissue));
    }
    return tissues;
}

}  // namespace osteomill
