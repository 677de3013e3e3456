#include "studies/render/trial_bone.h"

#include <glm/geometric.hpp>
#include <sstream>
#include <stdexcept>

#include "common/program/available_memory.h"
#include "imaging/case/bone_source.h"
#include "imaging/import_bone.h"
#include "imaging/phantoms/phantom.h"
#include "render_client/volume/textures/voxel_box.h"

namespace osteomill::study {

namespace {

glm::dvec3 middle_mm(const Bone& bone) {
    const VoxelBox box = stored_box(bone.content());
    return 0.5 * (centre_of_voxel_mm(bone.grid(), box.first) +
                  centre_of_voxel_mm(bone.grid(), box.first + box.size - 1));
}

double radius_mm(const Bone& bone) {
    const VoxelBox box = stored_box(bone.content());
    return 0.5 * bone.grid().spacing_mm * glm::length(glm::dvec3(box.size));
}

/// Where the camera's axis first meets bone; throws std::runtime_error where it meets none.
glm::dvec3 seen_point_mm(const Bone& bone, const Camera& camera) {
    const double step_mm = 0.5 * bone.grid().spacing_mm;
    for (double distance = 0.0; distance < camera.far_mm; distance += step_mm) {
        const glm::dvec3 place = camera.eye_mm() + distance * camera.forward();
        const glm::ivec3 voxel(glm::round(to_voxel_coordinates(bone.grid(), place)));
        if (bone.fraction_at(voxel) >= 128) return place;
    }
    throw std::runtime_error("the view's middle shows no bone");
}

/// A view of what is in the middle of another, from there.
Camera closer(const Camera& view, const glm::dvec3& target_mm, double shown_radius_mm) {
    Camera camera = camera_on(target_mm, shown_radius_mm);
    camera.azimuth_rad = view.azimuth_rad;
    camera.elevation_rad = view.elevation_rad;
    return camera;
}

TrialBone with_views(Bone bone, std::vector<TissueColour> tissues, double close_radius_mm) {
    const Camera overview = camera_on(middle_mm(bone), radius_mm(bone));
    const Camera close_up = closer(overview, seen_point_mm(bone, overview), close_radius_mm);
    return {std::move(bone), std::move(tissues), overview, close_up};
}

TrialBone skull(const std::filesystem::path& scans, const std::filesystem::path& folder) {
    const ImportOptions options{.input = scans / "head_ct",
                                .output = folder / "trial.nrrd",
                                .spacing_mm = 0.1,
                                .threshold_hu = 300.0,
                                .region = parse_region("-60,10,730,-20,50,770")};
    std::ostringstream unheard;
    import_bone(options, {.messages = unheard, .available_memory_bytes = available_memory_bytes()});
    Scene scene;
    scene.bone = FileSource{.path = options.output};
    Bone bone = load_bone(scene).bone;
    std::filesystem::remove(options.output);
    return with_views(std::move(bone), {}, 9.0);
}

TrialBone tooth() {
    const Scene scene = phantom_scene("tooth");
    std::vector<TissueColour> tissues;
    for (const Tissue& tissue : scene.tissues) tissues.push_back({tissue.label, tissue.colour_rgb});
    return with_views(load_bone(scene).bone, tissues, 7.0);
}

}  // namespace

const TrialBone& TrialBones::operator[](const std::string& name) {
    auto found = made_.find(name);
    if (found == made_.end())
        found =
            made_.emplace(name, name == skull_trial ? skull(scans_.value_or(""), folder_) : tooth()).first;
    return found->second;
}

}  // namespace osteomill::study
