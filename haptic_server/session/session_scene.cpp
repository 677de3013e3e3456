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
#include "imaging/formats/image_reader.h"
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

/// A bone that was chosen by itself may be saved over: what is saved continues it.
std::vector<NamedFile> files_read(const SceneChoice& choice, const Scene& scene) {
    std::vector<NamedFile> files;
    const bool is_file = choice.name && std::ranges::find(phantom_names, *choice.name) == phantom_names.end();
    if (is_file) files.push_back({"the scene", *choice.name, false});
    if (const auto* bone = std::get_if<FileSource>(&scene.bone)) {
        files.push_back({.option = choice.bone ? "the bone" : "the scene's bone",
                         .path = bone->path,
                         .is_written = false,
                         .is_replaced_by = choice.bone ? "--save-bone" : ""});
        if (!bone->segmentation.empty())
            for (const auto& file : files_of_image(bone->segmentation))
                files.push_back({"the scene's segmentation", file, false});
    }
    if (const auto* trajectory = std::get_if<std::filesystem::path>(&scene.trajectory.source))
        files.push_back({"the trajectory", *trajectory, false});
    return files;
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
    std::vector<NamedFile> files = files_read(choice, scene);
    LoadedBone loaded = load_bone(scene, available_memory_bytes());
    if (!loaded.doubt.empty())
        spdlog::warn("{}: {}", std::get<FileSource>(scene.bone).path.string(), loaded.doubt);
    if (choice.bone && !choice.name) place_on_bone(scene, loaded.bone);
    return {std::move(scene), std::move(loaded.bone), std::move(loaded.source), std::move(loaded.structures),
            std::move(files)};
}

}  // namespace osteomill
