// The [plan] and [pass] tables of a scene file.
#pragma once

#include <optional>
#include <span>

#include "common/scene/plan.h"
#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

/// Takes one of `tissue`, `sphere` and `cylinder`; nothing: none of them is there. Throws SceneError for more
/// than one, and for a tissue that the scene does not have. `table`: the table's name in messages.
std::optional<PlanRegion> read_region(TomlReader& reader, std::span<const Tissue> tissues, const char* table);

/// Takes `tissue`, `sphere` or `cylinder`, and `margin_mm`. Throws SceneError, also for a tissue that the
/// scene does not have.
Plan read_plan(TomlReader reader, std::span<const Tissue> tissues);

/// Takes the keys of pass_mark_kinds. Throws SceneError, also for a mark that could not be missed: of the
/// plan in a scene without one, of points in a scene that rates nothing, of touches in a scene that protects
/// nothing.
PassMarks read_pass_marks(TomlReader reader, const Scene& scene);

}  // namespace osteomill
