#include "imaging/case/scan_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "common/files/atomic_file.h"
#include "imaging/bone_file/hu_file.h"
#include "imaging/formats/source_image.h"
#include "imaging/picture/bone_picture.h"
#include "imaging/segmentation/segment_structure.h"

namespace osteomill {

namespace {

constexpr double black_hu = -200.0;
constexpr double white_hu = 1800.0;
constexpr int gap_px = 4;
constexpr int most_shown_segments = 255;

/// The patient's axes to the right and down in a picture, and the axis of view.
struct Plane {
    int right, down, through;
    bool is_down_reversed;  ///< the axis runs up
};
constexpr std::array<Plane, 3> planes{{{0, 1, 2, false}, {0, 2, 1, true}, {1, 2, 0, true}}};

struct Canvas {
    glm::ivec2 size_px{0};
    std::vector<std::uint8_t> rgb;

    void set(const glm::ivec2& at, const std::array<std::uint8_t, 3>& colour) {
        if (at.x < 0 || at.y < 0 || at.x >= size_px.x || at.y >= size_px.y) return;
        std::ranges::copy(colour, rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(at.y) * size_px.x + at.x));
    }
};

std::uint8_t grey_of(double hu) {
    const double share = std::clamp((hu - black_hu) / (white_hu - black_hu), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255.0 * share));
}

void draw(const CtVolume& ct, const Plane& plane, const glm::ivec3& middle, int left_px, Canvas& canvas) {
    const glm::ivec3& size = ct.grid.size_voxels;
    for (int down = 0; down < size[plane.down]; ++down)
        for (int right = 0; right < size[plane.right]; ++right) {
            glm::ivec3 voxel = middle;
            voxel[plane.right] = right;
            voxel[plane.down] = plane.is_down_reversed ? size[plane.down] - 1 - down : down;
            const std::uint8_t grey = grey_of(ct.hu[voxel_index(voxel, size)]);
            canvas.set({left_px + right, down}, {grey, grey, grey});
        }
}

void draw_region(const CtVolume& ct, const Plane& plane, const ScanRegion& region, int left_px,
                 Canvas& canvas) {
    constexpr std::array<std::uint8_t, 3> orange{255, 150, 0};
    const glm::ivec3 low = glm::round(to_voxel_coordinates(ct.grid, region.low_mm));
    const glm::ivec3 high = glm::round(to_voxel_coordinates(ct.grid, region.high_mm));
    const int edge = ct.grid.size_voxels[plane.down] - 1;
    const auto row = [&](int along) { return plane.is_down_reversed ? edge - along : along; };
    for (int right = low[plane.right]; right <= high[plane.right]; ++right)
        for (const int along : {low[plane.down], high[plane.down]})
            canvas.set({left_px + right, row(along)}, orange);
    for (int along = low[plane.down]; along <= high[plane.down]; ++along)
        for (const int right : {low[plane.right], high[plane.right]})
            canvas.set({left_px + right, row(along)}, orange);
}

void mark(const StructureMask& structure, std::uint8_t number, std::vector<std::uint8_t>& numbers) {
    const Grid& grid = structure.grid();
    for (const StructureBrick& brick : structure.bricks()) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size_in_bricks(grid), brick.brick);
        brick.voxels.for_each([&](std::size_t offset) {
            numbers[voxel_index(first + voxel_in_brick(offset), grid.size_voxels)] = number;
        });
    }
}

ScanRegion box_of(const CtVolume& ct) {
    return {ct.grid.origin_mm, centre_of_voxel_mm(ct.grid, ct.grid.size_voxels - 1)};
}

}  // namespace

CtVolume whole_ct(const std::filesystem::path& bone_file) {
    const BoneFile file(bone_file);
    HuReader reader(file);
    CtVolume ct{.grid = file.grid(), .hu = std::vector<std::int16_t>(voxel_count(file.grid()))};
    reader.read(ct.hu);
    return ct;
}

std::string summary_of(const CtVolume& ct) {
    const auto [least, most] = std::ranges::minmax(ct.hu);
    return fmt::format(
        "covers {} (mm, patient LPS: x0,y0,z0,x1,y1,z1)\nHU from {} to {}\ngrey from {} to {} HU\n",
        to_text(box_of(ct)), least, most, black_hu, white_hu);
}

void write_preview(const CtVolume& ct, const std::optional<ScanRegion>& region,
                   const std::filesystem::path& png) {
    const glm::ivec3& size = ct.grid.size_voxels;
    const ScanRegion shown = region.value_or(box_of(ct));
    const glm::ivec3 middle = glm::clamp(
        glm::ivec3(glm::round(to_voxel_coordinates(ct.grid, 0.5 * (shown.low_mm + shown.high_mm)))),
        glm::ivec3(0), size - 1);
    Canvas canvas;
    for (const Plane& plane : planes)
        canvas.size_px = {canvas.size_px.x + size[plane.right] + gap_px,
                          std::max(canvas.size_px.y, size[plane.down])};
    canvas.rgb.assign(
        3 * static_cast<std::size_t>(canvas.size_px.x) * static_cast<std::size_t>(canvas.size_px.y), 40);
    int left_px = 0;
    for (const Plane& plane : planes) {
        draw(ct, plane, middle, left_px, canvas);
        if (region) draw_region(ct, plane, *region, left_px, canvas);
        left_px += size[plane.right] + gap_px;
    }
    write_lasting_png(canvas.rgb, canvas.size_px, png);
}

void write_preview_voxels(const CtVolume& ct,
                          std::span<const std::shared_ptr<const Segmentation>> segmentations,
                          const std::filesystem::path& raw) {
    std::vector<std::uint8_t> bytes(ct.hu.size());
    std::ranges::transform(ct.hu, bytes.begin(), grey_of);
    AtomicFile file(raw);
    file.write(std::as_bytes(std::span(bytes)));
    if (!segmentations.empty()) {
        std::ranges::fill(bytes, std::uint8_t{0});
        int number = 0;
        for (const auto& segmentation : segmentations)
            for (const Segment& segment : segmentation->segments)
                if (++number <= most_shown_segments)
                    mark(structure_of(*segmentation, segment, ct.grid), static_cast<std::uint8_t>(number),
                         bytes);
        file.write(std::as_bytes(std::span(bytes)));
    }
    file.commit();
}

}  // namespace osteomill
