#include "common/scene/material.h"

#include <stdexcept>

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
    reader.refuse_other_keys();
    return material;
}

std::vector<Material> read_materials() {
    const toml::table root = toml::parse(shipped_materials_text, std::string_view("scenes/materials.toml"));
    TomlReader reader(root, "scenes/materials.toml", "the materials");
    std::vector<Material> materials;
    for (TomlReader& each : reader.tables("materials")) materials.push_back(read_material(each));
    reader.refuse_other_keys();
    for (Material& material : materials) {
        material.relative_stiffness = material.cutting_n_per_mm2 / materials.front().cutting_n_per_mm2;
        material.relative_edge = material.edge_n_per_mm / materials.front().edge_n_per_mm;
    }
    return materials;
}

}  // namespace

const std::vector<Material>& shipped_materials() {
    static const std::vector<Material> materials = read_materials();
    return materials;
}

}  // namespace osteomill
