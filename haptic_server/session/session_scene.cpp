#include "haptic_server/session/session_scene.h"

#include <xxhash.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "common/files/input_file.h"
#include "common/log/log.h"
#include "common/program/available_memory.h"
#include "common/scene/scene.h"
#include "common/scene/scene_file.h"
#include "imaging/case/case_folder.h"
#include "imaging/case/case_placement.h"
#include "imaging/case/case_trust.h"
#include "imaging/case/scene_on_bone.h"
#include "imaging/formats/image_reader.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

/// Loads the chosen scene; if the choice names only a bone, the scene has no place for the tool yet.
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

/// A bone that was chosen by itself may be saved over: the saved bone continues it.
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

std::uint64_t digest_of_file(const std::filesystem::path& file) {
    const std::string text = read_text(file, trajectory_kind);
    return XXH3_64bits(text.data(), text.size());
}

std::uint64_t digest_of(const std::vector<Structure>& structures) {
    std::uint64_t digest = 0;
    for (const Structure& structure : structures)
        for (const StructureBrick& brick : structure.mask.bricks()) {
            const std::uint64_t of_brick =
                XXH3_64bits_withSeed(brick.voxels.words().data(), sizeof(brick.voxels.words()), brick.brick);
            digest = 31 * digest + of_brick + structure.tissue;
        }
    return digest;
}

/// A bone takes from its scene where it is from, how stiff it is, and its tissues.
bool makes_same_bone(const Scene& a, const Scene& b) {
    const auto is_alike = [](const Tissue& one, const Tissue& other) {
        return one.label == other.label && one.name == other.name && one.segment == other.segment &&
               one.is_protected == other.is_protected && one.warn_mm == other.warn_mm;
    };
    return a.bone == b.bone && stiffness_of(a) == stiffness_of(b) &&
           std::ranges::equal(a.tissues, b.tissues, is_alike);
}

void add_file_digests(const SceneChoice& choice, const Scene& scene, SceneDigests& digests) {
    const bool is_file = choice.name && std::ranges::find(phantom_names, *choice.name) == phantom_names.end();
    digests.scene_file.reset();
    digests.trajectory.reset();
    if (is_file) digests.scene_file = digest_of_file(*choice.name);
    if (const auto* file = std::get_if<std::filesystem::path>(&scene.trajectory.source))
        digests.trajectory = digest_of_file(*file);
}

SceneDigests digests_of(const SceneChoice& choice, const Scene& scene, const LoadedBone& loaded) {
    SceneDigests digests{.bone = digest(loaded.bone), .structures = digest_of(loaded.structures)};
    add_file_digests(choice, scene, digests);
    return digests;
}

}  // namespace

SceneChoice case_chosen(const std::string& name) {
    SceneChoice choice{.name = scene_of_case(name)};
    if (choice.name != name) choice.case_folder = name;
    return choice;
}

SessionScene load_session_scene(const SceneChoice& choice, const SessionScene* similar) {
    Scene scene = load_scene(choice);
    if (choice.case_folder)
        if (const std::string line = unsigned_files(scene, *choice.case_folder); !line.empty())
            log_warning("{}", line);
    std::vector<NamedFile> files = files_read(choice, scene);
    if (similar != nullptr && choice.name && makes_same_bone(scene, similar->scene)) {
        SessionScene other = *similar;
        other.scene = std::move(scene);
        other.files_read = std::move(files);
        add_file_digests(choice, other.scene, other.digests);
        return other;
    }
    LoadedBone loaded = load_bone(scene, available_memory_bytes());
    if (!loaded.doubt.empty())
        log_warning("{}: {}", std::get<FileSource>(scene.bone).path.string(), loaded.doubt);
    if (choice.bone && !choice.name) place_on_bone(scene, loaded.bone);
    SceneDigests digests = digests_of(choice, scene, loaded);
    return {std::move(scene),         std::move(loaded.bone),
            std::move(loaded.source), std::move(loaded.structures),
            std::move(files),         digests};
}

}  // namespace osteomill
