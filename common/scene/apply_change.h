// A change of a scene (scene_change.h), made in its table before that is read.
#pragma once

#include <toml++/toml.h>

#include "common/scene/scene_change.h"

namespace osteomill {

/// Whether there is such a key is for who reads the table then. Throws SceneError, without a place, where the
/// way to it leads through a value, or a list that has none of that name.
void apply(const SceneChange& change, toml::table& scene);

}  // namespace osteomill
