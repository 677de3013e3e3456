// Slices through the CT, as a radiologist sees them: a pixel's place in the patient, and its colour.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/ct_volume.h"
#include "common/bone/structure_mask.h"

namespace osteomill {

/// Across the patient's x, y, z.
enum class SlicePlane { sagittal, coronal, axial };

/// A square picture of a slice: axial as seen from the feet (patient left to the right, back down), coronal
/// from the front (left to the right, head up), sagittal from the left (back to the right, head up).
struct SliceView {
    SlicePlane plane = SlicePlane::axial;
    glm::dvec3 centre_mm{0.0};  ///< in the middle of the picture, patient LPS
    double mm_per_px = 0.2;
    int edge_px = 200;

    glm::dvec3 right() const;  ///< unit, patient LPS
    glm::dvec3 down() const;
    glm::dvec3 across() const;
    /// Place of a pixel's middle; x to the right, y down from the picture's upper left corner.
    glm::dvec3 position_mm(const glm::dvec2& pixel) const;
    /// Pixel of a point that is moved across the slice into it.
    glm::dvec2 pixel(const glm::dvec3& position_mm) const;

    bool operator==(const SliceView&) const = default;
};

/// Directions at the left, right, upper and lower edge: R, L, A, P, S, I.
std::array<char, 4> edge_letters(SlicePlane plane);

/// Window of greys: HU from level - window / 2, black, to level + window / 2, white.
struct HuWindow {
    double level_hu = 500.0;
    double window_hu = 2500.0;

    std::uint8_t grey(double hu) const;
    bool operator==(const HuWindow&) const = default;
};

/// A tissue whose border is drawn: of its mask, or of the bone with its label.
struct SliceTissue {
    std::uint8_t label = 0;
    std::array<std::uint8_t, 3> colour_rgb{};
    std::optional<StructureMask> mask{};
};

/// Pixels of four bytes, row by row from the upper left corner: the CT in grey, and over it, if `bone` is
/// given, the border of the bone that is left in orange, and of each tissue in its colour.
std::vector<std::uint8_t> slice_picture(const CtVolume& ct, const Bone* bone,
                                        std::span<const SliceTissue> tissues, const SliceView& view,
                                        const HuWindow& window);

}  // namespace osteomill
