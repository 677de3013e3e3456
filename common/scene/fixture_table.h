// The [[fixture]] tables of a scene file.
#pragma once

#include <span>
#include <vector>

#include "common/scene/fixture.h"
#include "common/scene/scene.h"
#include "common/scene/toml_reader.h"

namespace osteomill {

/// Takes `name`, `kind`, `on` and the keys of the kind. Throws SceneError, also for two of one name and for a
/// tissue that is not one of the scene's protected ones.
std::vector<Fixture> read_fixtures(std::vector<TomlReader> readers, std::span<const Tissue> tissues);

}  // namespace osteomill
