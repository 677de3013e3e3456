#include "render_client/dataset/surface_labels.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

constexpr std::size_t most_tissues = 252;
constexpr std::uint8_t half_full = 128;
// In the order of SurfaceImage's numbers. Tool and unknown bone look as the field's public sets have them.
const std::array<SurfaceLabel, 4> things{
    {{"nothing", {0, 0, 0}}, {"burr", {34, 32, 33}}, {"shank", {90, 88, 89}}, {"bone", {255, 249, 219}}}};

}  // namespace

std::vector<SurfaceLabel> label_table(std::span<const Tissue> tissues) {
    std::vector<SurfaceLabel> table(things.begin(), things.end());
    for (const Tissue& tissue : tissues.first(std::min(tissues.size(), most_tissues)))
        table.push_back({tissue.name, identifier_of(tissue)});
    return table;
}

std::uint8_t label_of_tissue(std::size_t tissue) {
    return tissue < most_tissues ? static_cast<std::uint8_t>(things.size() + tissue) : SurfaceImage::bone;
}

std::uint8_t tissue_of_surface(const Bone& bone, const glm::dvec3& position_mm,
                               const std::array<bool, 256>& is_hidden) {
    const glm::dvec3 place = to_voxel_coordinates(bone.grid(), position_mm);
    const glm::dvec3 low = glm::floor(place), part = place - low;
    std::array<std::uint8_t, 8> tissue{};
    std::array<double, 8> weight{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::ivec3 voxel = glm::ivec3(low) + step;
        const glm::dvec3 shares = glm::mix(1.0 - part, part, glm::dvec3(step));
        const auto i = static_cast<std::size_t>(corner);
        tissue[i] = bone.tissue_at(voxel);
        if (is_hidden[tissue[i]]) continue;
        const std::uint8_t fraction = bone.fraction_at(voxel);
        weight[i] = shares.x * shares.y * shares.z * (fraction >= half_full ? 1.0 : 1e-6 * fraction);
    }
    std::uint8_t of_most = 0;
    double most = 0.0;
    for (const std::uint8_t candidate : tissue) {
        double sum = 0.0;
        for (std::size_t i = 0; i < tissue.size(); ++i)
            if (tissue[i] == candidate) sum += weight[i];
        if (sum > most || (sum == most && candidate < of_most)) {
            most = sum;
            of_most = candidate;
        }
    }
    return of_most;
}

std::vector<std::uint8_t> surface_labels(const SurfaceImage& image, const Camera& camera, const Bone& bone,
                                         std::span<const Tissue> tissues) {
    std::array<std::uint8_t, 256> label_by_tissue;
    label_by_tissue.fill(SurfaceImage::bone);
    std::array<bool, 256> is_hidden{};
    for (std::size_t i = 0; i < tissues.size(); ++i) {
        label_by_tissue[tissues[i].label] = label_of_tissue(i);
        is_hidden[tissues[i].label] = tissues[i].opacity <= 0.0;
    }
    std::vector<std::uint8_t> labels = image.thing;
    if (bone.content().tissue.empty()) return labels;
    for (int y = 0; y < image.size_px.y; ++y)
        for (int x = 0; x < image.size_px.x; ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size_px.x) +
                           static_cast<std::size_t>(x);
            if (labels[i] != SurfaceImage::bone) continue;
            const glm::dvec3 direction = direction_through(camera, {x + 0.5, y + 0.5}, image.size_px);
            const double along_mm = image.depth_mm[i] / glm::dot(direction, camera.forward());
            labels[i] =
                label_by_tissue[tissue_of_surface(bone, camera.eye_mm() + along_mm * direction, is_hidden)];
        }
    return labels;
}

}  // namespace osteomill
