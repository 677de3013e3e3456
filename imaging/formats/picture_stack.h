// A volume as a stack of pictures, PNG or TIFF, a slice each: a folder of them in the order of the numbers in
// their names, or one TIFF of several pages. Micro-CT comes so, and labels as colours.
//
// A picture does not state where it lies in the patient: its columns are assumed to run left, its rows to the
// back, the slices up.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "imaging/formats/source_image.h"

namespace osteomill {

/// "x,y,z" in mm, as --stack-spacing takes it. Throws std::invalid_argument unless it is three numbers above
/// 0.
glm::dvec3 parse_stack_spacing(const std::string& text);

/// Whether a folder is a stack: it holds pictures, and a spacing is given, or most of its files are pictures.
/// A picture beside a scan makes no stack of it.
bool is_picture_folder(const std::filesystem::path& folder, bool has_spacing);

/// A folder, or a TIFF. Reads size and form from the first picture. Values are grey levels (8 or 16 bits, of
/// TIFF floats, too), or colours, 0 where a picture is transparent. Throws ImagingError in one line if no
/// spacing is given, there are fewer than two pictures, one cannot be read, or is of a form that is not read;
/// reading the slices throws if a picture has another size or form than the first. Notes if the files'
/// numbers have a gap.
OpenedImage open_picture_stack(const std::filesystem::path& path, const std::optional<glm::dvec3>& spacing_mm,
                               ImagePurpose purpose = ImagePurpose::scan);

// Order of the pictures of a stack, by the numbers in their names.

/// Numbers within names count by their value: "2" before "10", "z0.25" before "z0.5", and "_-1" before "_0".
/// A hyphen behind a letter or digit is a minus where other names have none there ("s-1", "s0"); points are
/// of decimals unless they count ("1.9", "1.10"). Capitals count as small letters.
void sort_by_numbers(std::vector<std::filesystem::path>& files);

/// One line on the first place where files, in this order, are not numbered in steps as most of them are: a
/// slice may be missing, or one is too many. Empty if there is none, or most are not numbered at all.
std::string doubt_of_order(const std::vector<std::filesystem::path>& files);

}  // namespace osteomill
