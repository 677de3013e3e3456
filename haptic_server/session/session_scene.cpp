#include "haptic_server/session/session_scene.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "common/program/available_memory.h"
#include "common/scene/phantom_names.h"
#include "common/scene/scene_file.h"
#include "imaging/case/case_folder.h"
#include "imaging/case/case_placement.h"
#include "imaging/case/case_trust.h"
#include "imaging/case/scene_on_bone.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

/// Of a choice that names only a bone, one without a place for the tool yet.
Scene load_scene(const SceneChoice& choice) {
    Scene scene;
    if (choice.bone && !choice.name) {
        scene = scene_of_bone_file(*choice.bone);
    } else {
        const std::string name = choice.name.value_or(PhantomSource{}.name);
        const bool is_phantom = std::ranges::find(phantom_names, name) != phantom_names.end();
        scene = is_phantom ? phantom_scene(name, choice.changes) : read_scene(name, choice.changes);
        if (choice.case_folder) require_own_files(scene, *choice.case_folder);
        if (choice.bone) {
            const auto* before = std::get_if<FileSource>(&scene.bone);
            scene.bone = FileSource{.path = *choice.bone,
                                    .threshold_hu = {},
                                    .segmentation = before != nullptr ? before->segmentation : ""};
        }
    }
    if (choice.spindle_rpm)
        for (Burr& burr : scene.burrs) burr.spindle_rev_per_s = *choice.spindle_rpm / 60.0;
    if (choice.trajectory) scene.trajectory.source = *choice.trajectory;
    const bool is_pose_chosen = std::ranges::any_of(choice.changes.changes, [](const SceneChange& change) {
        return change.key.starts_with("start_pose");
    });
    if (choice.case_folder && !is_pose_chosen)
        scene.start_pose = placement_of_case(*choice.case_folder).value_or(scene.start_pose);
    return scene;
}

}  // namespace

SceneChoice case_chosen(const std::string& name) {
    SceneChoice choice{.name = scene_of_case(name)};
    if (choice.name != name) choice.case_folder = name;
    return choice;
}

SessionScene load_session_scene(const SceneChoice& choice) {
    Scene scene = load_scene(choice);
    if (choice.case_folder)
        if (const std::string line = unsigned_files(scene, *choice.case_folder); !line.empty())
            spdlog::warn("{}", line);
    LoadedBone loaded = load_bone(scene, available_memory_bytes());
    if (!loaded.doubt.empty())
        spdlog::warn("{}: {}", std::get<FileSource>(scene.bone).path.string(), loaded.doubt);
    if (choice.bone && !choice.name) place_on_bone(scene, loaded.bone);
    return {std::move(scene), std::move(loaded.bone), std::move(loaded.source), std::move(loaded.structures)};
}

}  // namespace osteomill
