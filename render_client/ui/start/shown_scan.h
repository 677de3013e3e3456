// Preview of a scan before its import: the figures that bone_import --preview printed, its three slices
// through a place, and the patient coordinates in their picture.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render_client/volume/picture.h"

namespace osteomill {

/// A box, patient LPS.
struct ScanBox {
    glm::dvec3 low_mm{0.0};
    glm::dvec3 high_mm{0.0};

    bool operator==(const ScanBox&) const = default;
};

struct ScanPreview {
    ScanBox covers;  ///< centres of the outermost voxels
    double least_hu = 0.0;
    double most_hu = 0.0;
    double black_hu = 0.0;  ///< range of the picture's greys
    double white_hu = 0.0;
    double finest_voxel_mm = 0.0;         ///< the least of the edges of the scan's voxels; 0: not stated
    std::vector<std::string> segments{};  ///< names, as segmentations have them
    double took_s = 0.0;                  ///< to read all of it
};

/// The scan's voxels, x fastest, then y, then z.
struct ScanVoxels {
    glm::ivec3 size{0};
    std::vector<std::uint8_t> greys{};     ///< 0 is black_hu, 255 white_hu
    std::vector<std::uint8_t> segments{};  ///< 1 is the first of ScanPreview::segments; empty: there are none
};

/// A segment's outline in the slices, sRGB; `index` in ScanPreview::segments.
std::array<std::uint8_t, 3> colour_of_segment(std::size_t index);

/// The voxels that bone_import --preview VOXELS.raw wrote. Throws std::runtime_error, in one line, if they do
/// not match the box that the scan covers.
ScanVoxels read_scan_voxels(const std::filesystem::path& raw, const ScanBox& covers, double mm_per_px);

/// Nothing if the text does not give the scan's extent.
std::optional<ScanPreview> read_scan_preview(const std::string& preview_output);

/// One of the picture's slices: axial, coronal, sagittal.
struct PreviewSlice {
    int right_axis, down_axis;
    bool is_down_reversed;
    glm::dvec2 first_px;  ///< upper left corner
    glm::dvec2 size_px;

    int through_axis() const { return 3 - right_axis - down_axis; }
};

/// The slices of a picture with a pixel for each `mm_per_px`.
std::array<PreviewSlice, 3> preview_slices(const ScanBox& covers, double mm_per_px);

/// The one with this pixel; nothing between two of them.
std::optional<PreviewSlice> slice_at(const ScanBox& covers, double mm_per_px, const glm::dvec2& px);

/// The slices through a place, patient LPS, with the segments outlined; the nearest ones if it is outside the
/// scan.
Picture picture_of(const ScanVoxels& voxels, const ScanBox& covers, double mm_per_px,
                   const glm::dvec3& place_mm);

/// The patient's directions at a slice's edges: left, right, above, below.
std::array<const char*, 4> letters_of(const PreviewSlice& slice);

/// The picture with a contour at so many HU drawn into its slices, a pixel thick; nothing is drawn if the
/// picture does not say its HU.
Picture with_contour(const Picture& picture, const ScanPreview& look, double mm_per_px, double threshold_hu);

/// The box with two of its sides as they were dragged in a slice, from one pixel of the picture to another;
/// kept within the scan. Nothing if the first lies in no slice.
std::optional<ScanBox> dragged_box(const ScanBox& covers, const ScanBox& before, double mm_per_px,
                                   const glm::dvec2& from_px, const glm::dvec2& to_px);

/// A box's place in a slice, pixels of the picture: upper left and lower right corner.
std::array<glm::dvec2, 2> box_in_slice(const ScanBox& covers, const ScanBox& box, double mm_per_px,
                                       const PreviewSlice& slice);

}  // namespace osteomill
