// A change of a scene (scene_change.h), made in its table before that is read.
#pragma once

#include <toml++/toml.h>

#include "common/scene/scene_change.h"

namespace osteomill {

/// Whether the key exists is checked by the table's reader. Throws SceneError, without file and line, if the
/// path to the key leads through a value, or through a list without an entry of that name.
void apply(const SceneChange& change, toml::table& scene);

}  // namespace osteomill
