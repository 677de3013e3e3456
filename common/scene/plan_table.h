// The [plan] and [pass] tables of a scene file.
#pragma once

#include <optional>
#include <span>

#include "common/scene/plan.h"
#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

/// Takes one of `tissue`, `sphere` and `cylinder`; nothing: none of them is there. Throws SceneError for more
/// than one, and for a tissue that is not one of the scene's.
/// `table`: how the table is called in messages.
std::optional<PlanRegion> read_region(TomlReader& reader, std::span<const Tissue> tissues, const char* table);

/// Takes `tissue`, `sphere` or `cylinder`, and `margin_mm`. Throws SceneError, also for a tissue that is not
/// one of the scene's.
Plan read_plan(TomlReader reader, std::span<const Tissue> tissues);

/// Takes the keys of pass_mark_kinds. Throws SceneError, also for a mark of the plan where the scene has
/// none, of points where it rates nothing, and of touches where it protects nothing: it could not be missed.
PassMarks read_pass_marks(TomlReader reader, const Scene& scene);

}  // namespace osteomill
