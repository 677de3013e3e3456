#include "studies/render/trial_bone.h"

#include <sstream>
#include <stdexcept>

#include "common/program/available_memory.h"
#include "imaging/case/bone_source.h"
#include "imaging/import_bone.h"
#include "imaging/phantoms/phantom.h"
#include "studies/render/picture_trial.h"

namespace osteomill::study {

namespace {

TrialBone with_views(Bone bone, std::vector<TissueColour> tissues, double close_radius_mm) {
    const Camera overview = overview_of(bone);
    const Camera close_up = close_up_of(bone, overview, close_radius_mm);
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
    return with_views(load_bone(scene).bone, tissue_colours(scene.tissues), 7.0);
}

}  // namespace

TrialBone trial_bone(const std::string& name, const std::filesystem::path& scans,
                     const std::filesystem::path& folder) {
    if (name == tooth_trial) return tooth();
    if (name == skull_trial) return skull(scans, folder);
    throw std::invalid_argument("no trial bone is called '" + name + "'");
}

}  // namespace osteomill::study
