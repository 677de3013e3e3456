// Presets of materials: the coefficients for cutting bone, tooth or a test block, from scenes/materials.toml,
// which names the method and the sources of each.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace osteomill {

/// Origin of a material's numbers.
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

/// Material of a segment that is no bone.
inline constexpr const char* soft_material = "soft";

/// The materials of scenes/materials.toml, built in.
const std::vector<Material>& shipped_materials();

/// Strength of a tissue of which only the material is given, or, without material, only the
/// relative_stiffness. An unknown material gives no values.
TissueStrength usual_strength(const TissueStrength& strength);

/// Material that a segment's name ("vertebrae_L1", "Lower Teeth") implies; nullptr if it is no bone, or the
/// name implies none.
const Material* material_of_segment(const std::string& name);

}  // namespace osteomill
