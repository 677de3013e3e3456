#include "render_client/dataset/image_files.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render_client/dataset/npy_file.h"
#include "render_client/volume/png_file.h"

namespace osteomill {

std::vector<std::array<std::uint8_t, 3>> colours_of(const std::vector<SurfaceLabel>& labels) {
    std::vector<std::array<std::uint8_t, 3>> colours;
    for (const SurfaceLabel& label : labels) colours.push_back(label.colour_rgb);
    return colours;
}

std::vector<float> along_rays(const SurfaceImage& surface, const Pinhole& pinhole) {
    std::vector<float> ray_mm(surface.depth_mm);
    std::size_t i = 0;
    for (int v = 0; v < surface.size_px.y; ++v)
        for (int u = 0; u < surface.size_px.x; ++u, ++i) {
            const glm::dvec2 slope = (glm::dvec2(u, v) - pinhole.centre_px) / pinhole.focal_px;
            ray_mm[i] = static_cast<float>(ray_mm[i] * std::sqrt(1.0 + glm::dot(slope, slope)));
        }
    return ray_mm;
}

nlohmann::ordered_json write_images(const std::filesystem::path& folder, const DatasetImages& wanted,
                                    std::size_t frame, const std::string& camera, const CameraImages& images,
                                    const std::vector<std::array<std::uint8_t, 3>>& colours_rgb) {
    nlohmann::ordered_json files;
    const auto named = [&](const char* kind, const char* ending) {
        const std::string name = fmt::format("{}/{:06}_{}.{}", camera, frame, kind, ending);
        files[kind] = name;
        return folder / name;
    };
    const SurfaceImage& surface = images.surface;
    if (wanted.colour) write_png(images.colour, named("colour", "png"));
    if (wanted.depth) write_npy(surface.size_px, surface.depth_mm, named("depth", "npy"));
    if (wanted.ray_depth)
        write_npy(surface.size_px, along_rays(surface, images.pinhole), named("ray_depth", "npy"));
    if (wanted.labels) write_indexed_png(surface.size_px, images.labels, colours_rgb, named("labels", "png"));
    if (wanted.normals) write_npy(surface.size_px, surface.normal, named("normals", "npy"));
    return files;
}

}  // namespace osteomill
