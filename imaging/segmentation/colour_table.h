// Names and colours of a label map's labels, from a colour table as 3D Slicer (.csv, .ctbl) or ITK-SNAP write
// it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace osteomill {

struct ColourOfLabel {
    std::string name{};
    std::array<std::uint8_t, 3> colour_rgb{};

    bool operator==(const ColourOfLabel&) const = default;
};

using ColourTable = std::map<std::uint16_t, ColourOfLabel>;

/// A line a label: "LABEL NAME R G B A" (3D Slicer's .ctbl; blanks of a name are underscores), a row of 3D
/// Slicer's .csv, by the names of its columns, or "LABEL R G B A VISIBLE MESH "NAME"" (ITK-SNAP); "#" begins
/// a comment, "(none)" is no name. Two labels may have one name. Throws ImagingError in one line that says
/// which line is wrong, for a label that comes twice or is not 0 to 65535, and a file without labels or of
/// over a megabyte.
ColourTable read_colour_table(const std::filesystem::path& path);

}  // namespace osteomill
