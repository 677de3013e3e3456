// The limits that hold for the geometry of every image, of whatever format: an image outside them was no scan
// of a patient, and would spoil later arithmetic.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "common/bone/patient_space.h"
#include "imaging/formats/source_image.h"

namespace osteomill {

/// From the voxels of a micro CT to the coarsest survey.
inline constexpr double least_spacing_mm = 1e-3;
inline constexpr double greatest_spacing_mm = 100.0;
inline constexpr double farthest_position_mm = farthest_place_mm;
inline constexpr std::uint64_t most_voxels_of_an_axis = 65535;
inline constexpr std::uint64_t most_voxels = std::uint64_t{1} << 36U;

/// Also false if it is not a number.
bool is_plausible_spacing(double spacing_mm);
bool is_plausible_position(const glm::dvec3& position_mm);

/// "spacing 1e-09 mm: it must be above 0, from 0.001 to 100 mm"; `what` is the field's name.
std::string implausible_spacing(const std::string& what, double spacing_mm);
std::string implausible_position(const std::string& what);

/// The number of voxels, of any number of axes. Throws std::invalid_argument if an axis has none, or it or
/// the product is above the limits.
std::uint64_t plausible_voxel_count(std::span<const std::uint64_t> sizes);

/// Axes further from perpendicular than this are no image's but a sheared one's.
inline constexpr double most_shear_degrees = 0.5;

/// Cosine of the two axes that are furthest from perpendicular, as its amount.
double shear_of(const SourceImage& image);
/// "its axes i and j are 88.2 degrees apart": those two.
std::string sheared_axes(const SourceImage& image);

/// Throws std::invalid_argument for sizes, spacings or an origin outside the limits, and for axes that are
/// not perpendicular unit vectors.
void require_plausible_geometry(const SourceImage& image);

/// Makes axes that are perpendicular but for how they were rounded, or up to most_shear_degrees off, truly
/// perpendicular: the nearest such, about the image's middle, which stays. Notes it if it can be seen. Then
/// as require_plausible_geometry, but throws ImagingError, naming `path`.
void settle_geometry(SourceImage& image, const std::filesystem::path& path);

/// Notes that nothing says how the image lies in the patient, so that left and right are a guess: `taken_as`.
void note_guessed_orientation(SourceImage& image, const std::filesystem::path& path,
                              const std::string& why = "its header says nothing of orientation",
                              const char* taken_as = "left-posterior-superior (LPS)");

// The units in which image files state lengths, by the names that programs write.

/// Millimetres of one "mm", "um", "µm", "microns", "Centimeters", "m" and so on; nothing for a name that is
/// none of a length.
std::optional<double> mm_of_unit(const std::string& name);

/// Whether a file says of its unit that it is not known: "", "?", "none", "unknown".
bool is_unknown_unit(const std::string& name);

/// The units that are right, for messages.
inline constexpr const char* known_units = "mm, cm, m, um (microns) and nm are read";

}  // namespace osteomill
