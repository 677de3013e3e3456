#include "studies/render/carved_sphere.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <vector>

#include "common/statistics/percentile.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/shaders/lighting.h"
#include "studies/render/made_bone.h"
#include "studies/render/picture_difference.h"
#include "studies/render/reference_image.h"

namespace osteomill::study {

namespace {

constexpr glm::ivec2 picture_px(160, 160);
// Off the lattice.
const glm::dvec3 centre_mm(0.013, -0.021, 0.037);
constexpr double radius_mm = 2.5;

/// Bone below z = 0.8 mm, with the hole of a 5 mm burr.
Bone holed_block() {
    const Grid grid{.size_voxels = {80, 80, 64}, .spacing_mm = 0.1, .origin_mm = {-3.95, -3.95, -4.25}};
    Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 0.8 - p.z; });
    carve_sphere(bone, centre_mm, radius_mm);
    return bone;
}

Camera into_hole(double px_per_voxel) {
    Camera camera = camera_on(centre_mm + glm::dvec3(0.3, 0.2, -radius_mm), 1.0);
    camera.elevation_rad = 1.2;
    camera.distance_mm = 0.5 * picture_px.y / px_per_voxel * 0.1 / std::tan(0.5 * camera.field_of_view_rad);
    camera.near_mm = 0.1 * camera.distance_mm;
    return camera;
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::acos(std::min(1.0, glm::dot(a, b) / (glm::length(a) * glm::length(b)))));
}

/// The point at which a ray from the eye leaves the sphere: the wall of the hole.
glm::dvec3 wall_mm(const Camera& camera, const glm::dvec3& direction) {
    const glm::dvec3 from_centre = camera.eye_mm() - centre_mm;
    const double along = glm::dot(from_centre, direction);
    return camera.eye_mm() +
           (-along + std::sqrt(along * along - glm::dot(from_centre, from_centre) + radius_mm * radius_mm)) *
               direction;
}

}  // namespace

double carved_sphere_psnr_db(double px_per_voxel) {
    const Bone bone = holed_block();
    const BoneTextures textures(bone, {});
    const ReferenceVolume volume(bone, {}, {});
    const Camera camera = into_hole(px_per_voxel);
    const gl::Framebuffer framebuffer(picture_px);
    framebuffer.bind();
    RaycastRenderer renderer;
    renderer.set_appearance({.smooth_silhouettes = false});
    renderer.draw(textures, camera, picture_px);
    Picture analytic(picture_px);
    const glm::dvec3 colour(plain_bone_colour());
    for (int y = 0; y < picture_px.y; ++y)
        for (int x = 0; x < picture_px.x; ++x) {
            const glm::dvec3 wall =
                wall_mm(camera, direction_through(camera, glm::dvec2(x, y) + 0.5, picture_px));
            if (wall.z > 0.5) throw std::logic_error("the hole does not fill the picture");
            const glm::dvec3 normal = glm::normalize(centre_mm - wall);
            const double openness = volume.ambient_occlusion(textures.to_box_voxels(wall), normal);
            const glm::dvec3 shown = display(lit(colour, normal, openness));
            for (int channel = 0; channel < 3; ++channel)
                analytic.rgb[3 * (static_cast<std::size_t>(y) * picture_px.x + x) + channel] =
                    static_cast<std::uint8_t>(std::lround(255.0 * shown[channel]));
        }
    return psnr_db(framebuffer.read_back(), analytic);
}

double carved_sphere_normals_p95_deg() {
    const Bone bone = holed_block();
    const ReferenceVolume volume(bone, {}, {});
    std::vector<double> angles_deg;
    for (double z = -0.95; z < -0.1; z += 0.01)
        for (int turn = 0; turn < 60; ++turn) {
            // A golden angle apart, so that no two lie alike in the lattice.
            const double azimuth = 2.399963 * (turn + 60.0 * static_cast<double>(angles_deg.size()));
            const double r = std::sqrt(1.0 - z * z);
            const glm::dvec3 outward(r * std::cos(azimuth), r * std::sin(azimuth), z);
            const glm::dvec3 place = to_voxel_coordinates(bone.grid(), centre_mm + radius_mm * outward) +
                                     0.5 - glm::dvec3(volume.box().first);
            angles_deg.push_back(angle_deg(volume.eight_corner_gradient_at(place), outward));
        }
    return percentile(angles_deg, 0.95);
}

}  // namespace osteomill::study
