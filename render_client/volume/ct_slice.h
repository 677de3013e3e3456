// Slices through the CT, as a radiologist sees them: where a pixel lies in the patient, and what colour it
// has.
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
    /// Of a pixel's middle; x to the right, y down from the picture's upper left corner.
    glm::dvec3 position_mm(const glm::dvec2& pixel) const;
    /// Where a point, moved across the slice into it, is seen.
    glm::dvec2 pixel(const glm::dvec3& position_mm) const;

    bool operator==(const SliceView&) const = default;
};

/// What is at the left, right, upper and lower edge: R, L, A, P, S, I.
std::array<char, 4> edge_letters(SlicePlane plane);

/// Which HU are black and which white: level -+ window / 2.
struct HuWindow {
    double level_hu = 500.0;
    double window_hu = 2500.0;

    std::uint8_t grey(double hu) const;
    bool operator==(const HuWindow&) const = default;
};

/// A tissue whose border is drawn: where its mask is, or where the bone has its label.
struct SliceTissue {
    std::uint8_t label = 0;
    std::array<std::uint8_t, 3> colour_rgb{};
    std::optional<StructureMask> mask{};
};

/// Pixels of four bytes, row by row from the upper left corner: the CT in grey, and over it, where `bone` is
/// given, the border of what is left of it in orange, and of each tissue in its colour.
std::vector<std::uint8_t> slice_picture(const CtVolume& ct, const Bone* bone,
                                        std::span<const SliceTissue> tissues, const SliceView& view,
                                        const HuWindow& window);

}  // namespace osteomill
