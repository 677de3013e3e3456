// The tissues of a scene file: its [[tissues]].
#pragma once

#include <vector>

#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

/// Greatest distance of a burr at which a warning can be set.
inline constexpr double most_warn_mm = 10.0;

/// Distance at which to warn of a tissue, if the scene gives none.
inline double usual_warn_mm(bool is_protected) {
    return is_protected ? 1.0 : 0.0;
}

/// One tissue from each table. Throws SceneError, in one line, for bad keys and values, a label that stands
/// for two tissues, and a segment in a scene that names no segmentation.
std::vector<Tissue> read_tissues(std::vector<TomlReader> readers, bool has_segmentation);

}  // namespace osteomill
