#include "haptic_server/program/bone_source.h"

#include <utility>
#include <variant>

#include "haptic_server/imaging/carved_bone.h"
#include "haptic_server/imaging/hu_file.h"
#include "haptic_server/imaging/phantom.h"

namespace osteomill {

LoadedBone load_bone(const Scene& scene) {
    if (const auto* phantom = std::get_if<PhantomSource>(&scene.bone)) {
        std::variant<HuVolume, Bone> made = make_phantom(phantom->name);
        if (auto* bone = std::get_if<Bone>(&made)) return {std::move(*bone), std::nullopt};
        auto& volume = std::get<HuVolume>(made);
        Bone bone = bone_from_hu(volume, phantom_threshold_hu, scene.stiffness);
        return {std::move(bone), BoneSource{std::move(volume), phantom_threshold_hu}};
    }
    const auto& source = std::get<FileSource>(scene.bone);
    BoneFile file = read_bone_file(source.path);
    const double threshold_hu =
        source.threshold_hu.value_or(file.threshold_hu.value_or(default_threshold_hu));
    Bone bone = is_carved(file) ? restore_carved_bone(source.path, file)
                                : bone_from_hu(file.volume, threshold_hu, scene.stiffness);
    return {std::move(bone), BoneSource{std::move(file.volume), threshold_hu}};
}

}  // namespace osteomill
