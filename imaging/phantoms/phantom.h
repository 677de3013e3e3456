// Bones made by code: deterministic, no download. The default scenes stand on them.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "common/scene/scene.h"
#include "common/scene/scene_change.h"
#include "imaging/bone_from_hu.h"

namespace osteomill {

/// Labels of the tissues of tooth and jaw; 0 is all that is not bone.
enum class DentalTissue : std::uint8_t {
    cortical_bone = 1,
    trabecular_bone = 2,
    dentine = 3,
    enamel = 4,
    pulp = 5,
    nerve_canal = 6,
    carious_lesion = 7,
    gum = 8  ///< of the jaw
};

/// A molar in a block of jaw, 512 x 512 x 128 voxels of 0.1 mm: +z is occlusal (crown up). Enamel, dentine,
/// pulp, cortical and trabecular bone, a nerve canal and a carious lesion that opens on the occlusal surface.
/// The roots are shorter than life, so that crown, roots and jaw fit into 12.8 mm, and the canal runs beside
/// their tips instead of below.
HuSlices make_tooth_phantom();

/// The left body of a lower jaw with its teeth from canine to second molar in their sockets, 0.125 mm, as
/// dental cone beams have: enamel, dentine, pulp, a periodontal gap of 0.25 to 0.32 mm, cortical and
/// trabecular bone, the mandibular canal, gum, and caries in the first molar. The row runs front to back, the
/// cheek is at +x. The jaw is sawn off at both ends. Sources of its sizes: tooth_shape.h, jaw_phantom.cpp.
HuSlices make_jaw_phantom();

/// Labels of the mastoid phantom's tissues: those of FIVRS (scenes/fivrs.ctbl).
enum class TemporalTissue : std::uint8_t {
    bone = 1,
    malleus = 2,
    incus = 3,
    stapes = 4,
    bony_labyrinth = 5,
    iac = 6,
    superior_vestibular_nerve = 7,
    inferior_vestibular_nerve = 8,
    cochlear_nerve = 9,
    facial_nerve = 10,
    chorda_tympani = 11,
    ica = 12,
    sinus_and_dura = 13,
    vestibular_aqueduct = 14,
    tmj = 15,
    ear_canal = 16
};

/// A left temporal bone, 0.15 mm: mastoid with air cells, antrum and tympanic cavity with the ossicles, ear
/// canal, labyrinth, internal canal with its nerves, facial nerve, sigmoid sinus, carotid artery, dura.
/// Sources of its sizes: temporal_bone.h.
HuSlices make_mastoid_phantom();

/// The homogeneous cube of the polishing experiment: 50 x 50 x 12 mm at 0.1 mm, relative stiffness 1, top
/// face exactly at z = 0, bone below.
HuSlices make_cube_phantom();

/// Threshold at which each phantom's HU becomes bone.
inline constexpr double phantom_threshold_hu = 150.0;

/// The scene that goes with a phantom: tissues, six burrs (1, 1.5, 2, 3, 4, 5 mm), start pose and trajectory.
/// The tooth's trajectory is the cavity that drills out the lesion with the 1.5 mm burr to a hole of 4.5 mm;
/// the jaw's likewise with the 1.5 mm burr; the cube's is the polishing slide with the 5 mm burr; the head's
/// (see head_phantom.h) thins the vault at its top with the 3 mm burr. Throws std::invalid_argument for an
/// unknown name, listing the known ones, and SceneError for a bad change (scene_file.h).
Scene phantom_scene(const std::string& name, const SceneChanges& changes = {});

/// A phantom: CT numbers to make bone from, or the bone itself if CT numbers would take too long to make.
/// Throws like phantom_scene.
std::variant<HuSlices, Bone> make_phantom(const std::string& name);

}  // namespace osteomill
