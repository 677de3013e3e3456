#include "render_client/dataset/image_files.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/files/atomic_file.h"
#include "render_client/volume/picture.h"

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

namespace {

static_assert(std::endian::native == std::endian::little);

std::string header_of(std::string_view type, const std::string& shape) {
    constexpr std::size_t before_text = 10, alignment = 64;
    std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
    text.append(alignment - 1 - (before_text + text.size()) % alignment, ' ');
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(text.size() & 0xff);
    header += static_cast<char>(text.size() >> 8);
    return header + text;
}

void write(const std::string& header, std::span<const std::byte> numbers, const std::filesystem::path& file) {
    AtomicFile whole(file, Link::replace);  // its name is ours
    whole.write(std::as_bytes(std::span(header)));
    whole.write(numbers);
    whole.commit_unsynced();
}

void require_as_many(const glm::ivec2& size_px, std::size_t count) {
    if (static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y) != count)
        throw std::invalid_argument(fmt::format("{} values for {} x {} pixels", count, size_px.x, size_px.y));
}

}  // namespace

void write_npy(const glm::ivec2& size_px, std::span<const float> values, const std::filesystem::path& file) {
    require_as_many(size_px, values.size());
    write(header_of("<f4", fmt::format("{}, {}", size_px.y, size_px.x)), std::as_bytes(values), file);
}

std::vector<std::uint16_t> halves_of(std::span<const glm::vec3> values) {
    std::vector<std::uint16_t> halves;
    halves.reserve(3 * values.size());
    for (const glm::vec3& value : values)
        for (int axis = 0; axis < 3; ++axis) halves.push_back(glm::packHalf1x16(value[axis]));
    return halves;
}

void write_npy(const glm::ivec2& size_px, std::span<const glm::vec3> values,
               const std::filesystem::path& file) {
    require_as_many(size_px, values.size());
    const std::vector<std::uint16_t> halves = halves_of(values);
    write(header_of("<f2", fmt::format("{}, {}, 3", size_px.y, size_px.x)), std::as_bytes(std::span(halves)),
          file);
}

}  // namespace osteomill
