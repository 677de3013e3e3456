// Tables of a scene file that say what is to be done, and with what help: [plan], [pass], [[rating]],
// [[fixture]].
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/scene/fixture.h"
#include "common/scene/plan.h"
#include "common/scene/rating.h"
#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

// The [plan] and [pass] tables of a scene file.

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

// The [[rating]] tables of a scene file.

/// Takes `name`, `points`, `when`, `source` and one of `tissue`, `sphere` and `cylinder`, the item's region.
/// Throws SceneError, with the item's name, also for a condition that cannot be read, and for one that needs
/// a plan, tissue, burr or structure that the scene does not have.
Rating read_rating(std::vector<TomlReader> readers, const Scene& scene);

// The [[fixture]] tables of a scene file.

/// Takes `name`, `kind`, `on` and the keys of the kind. Throws SceneError, also for two of one name and for a
/// tissue that is not one of the scene's protected ones.
std::vector<Fixture> read_fixtures(std::vector<TomlReader> readers, std::span<const Tissue> tissues);

}  // namespace osteomill
