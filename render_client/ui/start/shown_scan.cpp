#include "render_client/ui/start/shown_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <glm/common.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace osteomill {

namespace {

constexpr double gap_px = 4.0;  // between the slices of the picture
constexpr std::array<std::uint8_t, 3> contour_rgb{86, 180, 233};

double row_mm(const ScanBox& covers, double mm_per_px, const PreviewSlice& slice, double row_px) {
    const double down_mm = (row_px - 0.5) * mm_per_px;
    const int axis = slice.down_axis;
    return slice.is_down_reversed ? covers.high_mm[axis] - down_mm : covers.low_mm[axis] + down_mm;
}

double row_px(const ScanBox& covers, double mm_per_px, const PreviewSlice& slice, double at_mm) {
    const int axis = slice.down_axis;
    return (slice.is_down_reversed ? covers.high_mm[axis] - at_mm : at_mm - covers.low_mm[axis]) / mm_per_px +
           0.5;
}

}  // namespace

std::optional<ScanPreview> read_scan_preview(const std::string& preview_output) {
    ScanPreview look;
    bool has_box = false;
    std::istringstream lines(preview_output);
    for (std::string line; std::getline(lines, line);) {
        ScanBox box;
        if (std::sscanf(line.c_str(), "covers %lf,%lf,%lf,%lf,%lf,%lf", &box.low_mm.x, &box.low_mm.y,
                        &box.low_mm.z, &box.high_mm.x, &box.high_mm.y, &box.high_mm.z) == 6) {
            look.covers = box;
            has_box = true;
        }
        std::sscanf(line.c_str(), "HU from %lf to %lf", &look.least_hu, &look.most_hu);
        std::sscanf(line.c_str(), "grey from %lf to %lf", &look.black_hu, &look.white_hu);
        // Parses the line on the bone that an import makes of the scan; it begins with a path.
        const std::size_t edges = line.rfind(" voxels of ");
        glm::dvec3 voxel_mm;
        if (edges != std::string::npos &&
            std::sscanf(line.c_str() + edges, " voxels of %lf x %lf x %lf mm become", &voxel_mm.x,
                        &voxel_mm.y, &voxel_mm.z) == 3)
            look.finest_voxel_mm = std::min({voxel_mm.x, voxel_mm.y, voxel_mm.z});
        constexpr std::string_view segment = "segment ";
        if (line.starts_with(segment)) look.segments.push_back(line.substr(segment.size()));
    }
    if (!has_box) return std::nullopt;
    return look;
}

std::array<PreviewSlice, 3> preview_slices(const ScanBox& covers, double mm_per_px) {
    std::array<PreviewSlice, 3> slices{{{0, 1, false, {}, {}}, {0, 2, true, {}, {}}, {1, 2, true, {}, {}}}};
    const glm::dvec3 size_px = glm::round((covers.high_mm - covers.low_mm) / mm_per_px) + 1.0;
    double left_px = 0.0;
    for (PreviewSlice& slice : slices) {
        slice.first_px = {left_px, 0.0};
        slice.size_px = {size_px[slice.right_axis], size_px[slice.down_axis]};
        left_px += slice.size_px.x + gap_px;
    }
    return slices;
}

std::array<std::uint8_t, 3> colour_of_segment(std::size_t index) {
    // The colours of Okabe and Ito's set, distinct to the colour-blind, that neither region nor contour has.
    constexpr std::array<std::array<std::uint8_t, 3>, 4> colours{
        {{0, 158, 115}, {240, 228, 66}, {204, 121, 167}, {213, 94, 0}}};
    return colours[index % colours.size()];
}

std::optional<PreviewSlice> slice_at(const ScanBox& covers, double mm_per_px, const glm::dvec2& px) {
    for (const PreviewSlice& slice : preview_slices(covers, mm_per_px)) {
        const glm::dvec2 in_slice = px - slice.first_px;
        if (in_slice.x >= 0.0 && in_slice.y >= 0.0 && in_slice.x <= slice.size_px.x &&
            in_slice.y <= slice.size_px.y)
            return slice;
    }
    return std::nullopt;
}

ScanVoxels read_scan_voxels(const std::filesystem::path& raw, const ScanBox& covers, double mm_per_px) {
    ScanVoxels voxels{.size = glm::ivec3(glm::round((covers.high_mm - covers.low_mm) / mm_per_px)) + 1};
    const auto count = static_cast<std::size_t>(voxels.size.x) * static_cast<std::size_t>(voxels.size.y) *
                       static_cast<std::size_t>(voxels.size.z);
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(raw, error);
    if (error || (bytes != count && bytes != 2 * count))
        throw std::runtime_error(raw.string() + ": is not the scan that was looked at");
    voxels.greys.resize(count);
    voxels.segments.resize(bytes - count);
    std::ifstream file(raw, std::ios::binary);
    for (auto* part : {&voxels.greys, &voxels.segments})
        if (!file.read(reinterpret_cast<char*>(part->data()), static_cast<std::streamsize>(part->size())))
            throw std::runtime_error(raw.string() + ": cannot be read");
    return voxels;
}

Picture picture_of(const ScanVoxels& voxels, const ScanBox& covers, double mm_per_px,
                   const glm::dvec3& place_mm) {
    const auto slices = preview_slices(covers, mm_per_px);
    double height_px = 0.0;
    for (const PreviewSlice& slice : slices) height_px = std::max(height_px, slice.size_px.y);
    Picture picture(glm::ivec2(slices.back().first_px.x + slices.back().size_px.x, height_px));
    const glm::ivec3 place = glm::clamp(glm::ivec3(glm::round((place_mm - covers.low_mm) / mm_per_px)),
                                        glm::ivec3(0), voxels.size - 1);
    for (const PreviewSlice& slice : slices) {
        const glm::ivec2 first(slice.first_px), size(slice.size_px);
        const auto voxel_at = [&](int column, int row) {
            glm::ivec3 voxel = place;
            voxel[slice.right_axis] = column;
            voxel[slice.down_axis] = slice.is_down_reversed ? size.y - 1 - row : row;
            return static_cast<std::size_t>(voxel.x) +
                   static_cast<std::size_t>(voxels.size.x) *
                       (static_cast<std::size_t>(voxel.y) +
                        static_cast<std::size_t>(voxels.size.y) * static_cast<std::size_t>(voxel.z));
        };
        const auto segment_at = [&](int column, int row) {
            const bool is_inside = column >= 0 && row >= 0 && column < size.x && row < size.y;
            return is_inside && !voxels.segments.empty() ? voxels.segments[voxel_at(column, row)] : 0;
        };
        for (int row = 0; row < size.y; ++row)
            for (int column = 0; column < size.x; ++column) {
                const std::uint8_t grey = voxels.greys[voxel_at(column, row)];
                const int segment = segment_at(column, row);
                const bool is_outline =
                    segment != 0 &&
                    (segment_at(column - 1, row) != segment || segment_at(column + 1, row) != segment ||
                     segment_at(column, row - 1) != segment || segment_at(column, row + 1) != segment);
                const auto* pixel = picture.at(first.x + column, first.y + row);
                std::ranges::copy(is_outline ? colour_of_segment(static_cast<std::size_t>(segment - 1))
                                             : std::array{grey, grey, grey},
                                  picture.rgb.begin() + (pixel - picture.rgb.data()));
            }
    }
    return picture;
}

std::array<const char*, 4> letters_of(const PreviewSlice& slice) {
    constexpr std::array<const char*, 3> low{"R", "A", "I"};  // in patient LPS
    constexpr std::array<const char*, 3> high{"L", "P", "S"};
    const auto right = static_cast<std::size_t>(slice.right_axis);
    const auto down = static_cast<std::size_t>(slice.down_axis);
    return {low[right], high[right], slice.is_down_reversed ? high[down] : low[down],
            slice.is_down_reversed ? low[down] : high[down]};
}

Picture with_contour(const Picture& picture, const ScanPreview& look, double mm_per_px, double threshold_hu) {
    Picture result = picture;
    if (!(look.white_hu > look.black_hu)) return result;
    const double grey = 255.0 * (threshold_hu - look.black_hu) / (look.white_hu - look.black_hu);
    const auto is_grey = [&](int x, int y) {
        const auto* pixel = picture.at(x, y);
        return pixel[0] == pixel[1] && pixel[1] == pixel[2];
    };
    // Not under a segment's outline, where the value is not known.
    const auto is_bone = [&](int x, int y) { return !is_grey(x, y) || *picture.at(x, y) >= grey; };
    for (const PreviewSlice& slice : preview_slices(look.covers, mm_per_px)) {
        const glm::ivec2 first(slice.first_px);
        const glm::ivec2 last = glm::min(first + glm::ivec2(slice.size_px), picture.size_px) - 1;
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const bool is_edge =
                    is_grey(x, y) && is_bone(x, y) &&
                    ((x > first.x && !is_bone(x - 1, y)) || (x < last.x && !is_bone(x + 1, y)) ||
                     (y > first.y && !is_bone(x, y - 1)) || (y < last.y && !is_bone(x, y + 1)));
                if (is_edge)
                    std::ranges::copy(contour_rgb,
                                      result.rgb.begin() + (picture.at(x, y) - picture.rgb.data()));
            }
    }
    return result;
}

std::optional<ScanBox> dragged_box(const ScanBox& covers, const ScanBox& before, double mm_per_px,
                                   const glm::dvec2& from_px, const glm::dvec2& to_px) {
    const std::optional<PreviewSlice> slice = slice_at(covers, mm_per_px, from_px);
    if (!slice) return std::nullopt;
    ScanBox box = before;
    const auto set = [&](int axis, double a_mm, double b_mm) {
        box.low_mm[axis] = std::clamp(std::min(a_mm, b_mm), covers.low_mm[axis], covers.high_mm[axis]);
        box.high_mm[axis] = std::clamp(std::max(a_mm, b_mm), covers.low_mm[axis], covers.high_mm[axis]);
    };
    const auto right_mm = [&](double px) {
        return covers.low_mm[slice->right_axis] + (px - slice->first_px.x - 0.5) * mm_per_px;
    };
    set(slice->right_axis, right_mm(from_px.x), right_mm(to_px.x));
    set(slice->down_axis, row_mm(covers, mm_per_px, *slice, from_px.y),
        row_mm(covers, mm_per_px, *slice, to_px.y));
    return box;
}

std::array<glm::dvec2, 2> box_in_slice(const ScanBox& covers, const ScanBox& box, double mm_per_px,
                                       const PreviewSlice& slice) {
    const int axis = slice.right_axis;
    const double a = row_px(covers, mm_per_px, slice, box.low_mm[slice.down_axis]);
    const double b = row_px(covers, mm_per_px, slice, box.high_mm[slice.down_axis]);
    const auto column = [&](double mm) {
        return slice.first_px.x + (mm - covers.low_mm[axis]) / mm_per_px + 0.5;
    };
    return {glm::dvec2(column(box.low_mm[axis]), std::min(a, b)),
            glm::dvec2(column(box.high_mm[axis]), std::max(a, b))};
}

}  // namespace osteomill
