// The [plan] and [pass] tables of a scene file.
#pragma once

#include <span>

#include "common/scene/plan.h"
#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

/// Takes `tissue`, `sphere` or `cylinder`, and `margin_mm`. Throws SceneError, also for a tissue that is not
/// one of the scene's.
Plan read_plan(TomlReader reader, std::span<const Tissue> tissues);

/// Takes the keys of pass_mark_kinds. Throws SceneError, also for a mark of the plan where the scene has none,
/// and of touches where it protects nothing: it could not be missed.
PassMarks read_pass_marks(TomlReader reader, const Scene& scene);

}  // namespace osteomill
