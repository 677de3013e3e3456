// Bones of the phantoms that are large, made once for all tests of the program.
#pragma once

#include <map>
#include <string>

#include "imaging/bone_from_hu.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill::testing {

/// The bone of the phantom "tooth", "jaw" or "mastoid". Throws std::invalid_argument for an unknown name.
inline Bone make_bone(const std::string& phantom) {
    return bone_from_hu(std::get<HuSlices>(make_phantom(phantom)), phantom_threshold_hu,
                        stiffness_of(phantom_scene(phantom)));
}
inline const Bone& made_bone(const char* phantom) {
    static std::map<std::string, Bone> made;
    const auto found = made.find(phantom);
    return found != made.end() ? found->second : made.emplace(phantom, make_bone(phantom)).first->second;
}

}  // namespace osteomill::testing
