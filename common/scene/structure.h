// A structure of a scene: where one of its tissues is, on the bone's grid.
#pragma once

#include <cstddef>

#include "common/bone/structure_mask.h"

namespace osteomill {

struct Structure {
    std::size_t tissue = 0;  ///< index in the scene's tissues
    StructureMask mask{};
};

}  // namespace osteomill
