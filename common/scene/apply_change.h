// Application of a change (scene_change.h) to a scene's table before the table is read.
#pragma once

#include <toml++/toml.h>

#include "common/scene/scene_change.h"

namespace osteomill {

/// The table's reader checks whether the key exists. Throws SceneError, without file and line, if the path to
/// the key leads through a value, or through a list without an entry of that name.
void apply(const SceneChange& change, toml::table& scene);

}  // namespace osteomill
