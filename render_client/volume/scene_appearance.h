// Cuts and background: the appearance of the scene apart from bone and camera.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "common/bone/ct_volume.h"
#include "render_client/volume/ct_slice.h"

namespace osteomill {

/// A cut hides the points of patient space with dot(normal, p) > offset_mm, for the eye only.
struct CutPlane {
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, patient LPS, towards the part taken away
    double offset_mm = 0.0;

    bool operator==(const CutPlane&) const = default;
};

/// A renderer heeds the first so many.
inline constexpr std::size_t most_cut_planes = 4;

/// Highlights on bone unless its user says otherwise, see SceneAppearance::specular.
inline constexpr float usual_wetness = 0.25f;

struct SceneAppearance {
    std::vector<CutPlane> cuts{};
    std::shared_ptr<const CtVolume>
        ct{};  ///< shown in grey in the cuts' faces; null: they have the bone's colours
    HuWindow ct_window{};
    glm::vec3 background_low{0.035f, 0.040f, 0.048f};  ///< linear RGB at the picture's lower edge
    glm::vec3 background_high{0.115f, 0.130f, 0.150f};

    bool ambient_occlusion = true;    ///< bone near by takes light away. Not on surface voxels
    bool thin_bone = true;            ///< thin bone shows tissue behind it (thin_bone.h)
    bool smooth_silhouettes = false;  ///< antialiased. Not of slices, nor where one sees through bone
    /// Highlights of the lamps on the bone, as on wet bone: 0 matt, 1 as bright as the lamps. Not on surface
    /// voxels.
    float specular = 0.0f;
    bool grain = false;               ///< of bone (shading_settings.h). Not on surface voxels
    bool neutral_sawn_faces = false;  ///< where the piece is sawn off (sawn_faces.h). Not on surface voxels
    bool light_field = false;         ///< only a microscope's round field is lit

    bool operator==(const SceneAppearance&) const = default;
};

}  // namespace osteomill
