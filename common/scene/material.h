// Presets of materials: what cutting bone, tooth or a test block takes, from scenes/materials.toml, which
// says for each how the numbers were got and from what sources.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace osteomill {

/// How the numbers of a material were got.
enum class MaterialQuality {
    measured,  ///< with this kind of tool
    inferred,  ///< from another tool, or from a property of the material
    assumed    ///< neither
};

struct Material {
    std::string name{};
    double cutting_n_per_mm2 = 0.0;  ///< K_t
    double edge_n_per_mm = 0.0;      ///< K_te
    MaterialQuality quality = MaterialQuality::assumed;
    std::vector<std::string> segments{};  ///< words of names of segments that are of it

    /// Both as shares of those of the bone for which a burr's coefficients hold: the file's first, cortical
    /// bone.
    double relative_stiffness = 1.0;
    double relative_edge = 1.0;
};

/// What a segment is said to be made of where it is no bone.
inline constexpr const char* soft_material = "soft";

/// Those of scenes/materials.toml, built in.
const std::vector<Material>& shipped_materials();

/// What a tissue's strength is where its material alone is said; of a strength without material, where its
/// relative_stiffness alone is. An unknown material says nothing.
TissueStrength usual_strength(const TissueStrength& strength);

/// What a segment is made of by its name ("vertebrae_L1", "Lower Teeth"); nullptr where that is no bone, or
/// says nothing.
const Material* material_of_segment(const std::string& name);

}  // namespace osteomill
