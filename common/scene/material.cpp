#include "common/scene/material.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/scene/shipped_scenes.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

namespace {

const std::vector<std::string> quality_names{"measured", "inferred", "assumed"};

Material read_material(TomlReader& reader) {
    Material material;
    material.name = required(reader, "name", reader.text("name"));
    material.cutting_n_per_mm2 =
        required(reader, "cutting_n_per_mm2", reader.number("cutting_n_per_mm2", {0.1, 1e5}));
    material.edge_n_per_mm = required(reader, "edge_n_per_mm", reader.number("edge_n_per_mm", {0.0, 100.0}));
    material.quality =
        static_cast<MaterialQuality>(required(reader, "quality", reader.choice("quality", quality_names)));
    (void)required(reader, "got", reader.text("got"));
    (void)reader.texts("sources");
    material.segments = reader.texts("segments").value_or(std::vector<std::string>());
    reader.refuse_other_keys();
    return material;
}

struct MaterialsFile {
    std::vector<Material> materials{};
    std::vector<std::string> not_bone{};  ///< words of names of segments
};

MaterialsFile read_materials() {
    const toml::table root = toml::parse(shipped_materials_text, std::string_view("scenes/materials.toml"));
    TomlReader reader(root, "scenes/materials.toml", "the materials");
    MaterialsFile file{.not_bone = required(reader, "not_bone", reader.texts("not_bone"))};
    std::vector<Material>& materials = file.materials;
    for (TomlReader& each : reader.tables("materials")) materials.push_back(read_material(each));
    reader.refuse_other_keys();
    for (Material& material : materials) {
        material.relative_stiffness = material.cutting_n_per_mm2 / materials.front().cutting_n_per_mm2;
        material.relative_edge = material.edge_n_per_mm / materials.front().edge_n_per_mm;
    }
    return file;
}

const MaterialsFile& shipped_file() {
    static const MaterialsFile file = read_materials();
    return file;
}

/// In lower case: "UpperTeeth_2" is "upper", "teeth" and "2".
std::set<std::string> words_of_name(const std::string& name) {
    std::set<std::string> words;
    std::string word;
    const auto end_word = [&] { words.insert(std::exchange(word, {})); };
    bool was_small = false;
    for (const char letter : name) {
        const auto code = static_cast<unsigned char>(letter);
        if (was_small && std::isupper(code) != 0) end_word();
        was_small = std::islower(code) != 0;
        if (std::isalnum(code) != 0)
            word += static_cast<char>(std::tolower(code));
        else
            end_word();
    }
    end_word();
    return words;
}

}  // namespace

const std::vector<Material>& shipped_materials() {
    return shipped_file().materials;
}

TissueStrength usual_strength(const TissueStrength& strength) {
    for (const Material& material : shipped_materials())
        if (material.name == strength.material)
            return {material.name, material.relative_stiffness, material.relative_edge};
    return {strength.material, strength.relative_stiffness, strength.relative_stiffness};
}

const Material* material_of_segment(const std::string& name) {
    const std::set<std::string> words = words_of_name(name);
    const auto is_said = [&](const std::string& word) { return words.contains(word); };
    if (std::ranges::any_of(shipped_file().not_bone, is_said)) return nullptr;
    const Material* found = nullptr;
    for (const Material& material : shipped_materials())
        if (std::ranges::any_of(material.segments, is_said)) found = &material;
    return found;
}

}  // namespace osteomill
