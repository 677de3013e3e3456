// Slices of a DICOM series put in order by their positions, if together they make a volume. Pure functions of
// the headers' values: no files.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace osteomill {

/// One slice as its header places it. Patient LPS, mm.
struct SlicePlacement {
    std::string name;                        ///< file, and frame where there are several; for messages
    glm::dvec3 position_mm{0.0};             ///< centre of the first pixel (Image Position)
    glm::dvec3 along_row{1.0, 0.0, 0.0};     ///< unit vector in which the column number grows
    glm::dvec3 along_column{0.0, 1.0, 0.0};  ///< unit vector in which the row number grows
    double column_pitch_mm = 0.0;            ///< between neighbours in a row
    double row_pitch_mm = 0.0;               ///< between rows
    int columns = 0;
    int rows = 0;
};

/// Slices in their order along the normal, evenly spaced.
struct SliceStack {
    std::vector<std::size_t> order;  ///< indices into the placements
    glm::dvec3 origin_mm{0.0};       ///< centre of the first voxel
    glm::dvec3 spacing_mm{1.0};      ///< along columns' count, rows' count, slices
    glm::dmat3 direction{1.0};       ///< columns: unit vectors of those three axes
};

/// Stacks the slices along their common normal (row x column). Throws std::invalid_argument, naming the
/// slices, for: fewer than two slices; sizes, orientations or pixel spacings that differ; a spacing,
/// a position or a direction that is not a number or that no scan has (plausible_geometry.h); row and column
/// further than most_shear_degrees from perpendicular; two slices at one position; slices that lean by more
/// than that and shift sideways by more than half a pixel over the stack (gantry tilt, its angle in the
/// message); missing slices; uneven spacing (a gap further from the median gap than 2 % and 0.02 mm, which is
/// the rounding that scanners print).
SliceStack stack_slices(const std::vector<SlicePlacement>& slices);

/// The distance of its slices that a file states; 0 if it does not.
struct StatedGap {
    double spacing_mm = 0.0;  ///< Spacing Between Slices
    double thickness_mm = 0.0;
};

/// Slices among which others may be empty, and of which several may lie at one place.
struct SliceLattice {
    std::vector<std::size_t> slice_of;  ///< for each placement, counted from the lowest
    std::size_t slices = 0;             ///< with the empty ones; 2 if all lie at one place
    glm::dvec3 origin_mm{0.0};
    glm::dvec3 spacing_mm{1.0};
    glm::dmat3 direction{1.0};
    std::string note;  ///< how positions and stated values differ; else empty
};

/// The lattice of a segmentation's frames. Its gap follows the positions; if those leave it open (slices may
/// be empty), the stated spacing. Throws as stack_slices does, but for the number of slices and those at one
/// position, and if the slices lie at no common spacing.
SliceLattice lattice_of(const std::vector<SlicePlacement>& slices, const StatedGap& stated);

}  // namespace osteomill
