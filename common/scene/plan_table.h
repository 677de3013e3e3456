// The [plan] table of a scene file, in and out.
#pragma once

#include <span>

#include "common/scene/plan.h"
#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

/// Takes `tissue`, `sphere` or `cylinder`, and `margin_mm`. Throws SceneError, also for a tissue that is not
/// one of the scene's.
Plan read_plan(TomlReader reader, std::span<const Tissue> tissues);

}  // namespace osteomill
