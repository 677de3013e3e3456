// The tissues of a scene file: its [[tissues]].
#pragma once

#include <vector>

#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

/// From how far a burr is warned of at most.
inline constexpr double most_warn_mm = 10.0;

/// Where a scene does not say at what distance to warn of a tissue.
inline double usual_warn_mm(bool is_protected) {
    return is_protected ? 1.0 : 0.0;
}

/// One of each table. Throws SceneError, in one line, for keys and values that cannot be, a label that stands
/// for two tissues, and a segment in a scene that names no segmentation.
std::vector<Tissue> read_tissues(std::vector<TomlReader> readers, bool has_segmentation);

}  // namespace osteomill
