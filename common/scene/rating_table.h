// The [[rating]] tables of a scene file.
#pragma once

#include <vector>

#include "common/scene/rating.h"
#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

/// Takes `name`, `points`, `when`, `source` and one of `tissue`, `sphere` and `cylinder`, the item's region.
/// Throws SceneError, with the item's name, also for a condition that cannot be read, and for one that needs
/// a plan, tissue, burr or structure that the scene does not have.
Rating read_rating(std::vector<TomlReader> readers, const Scene& scene);

}  // namespace osteomill
