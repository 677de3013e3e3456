// Names and colours of a label map's labels, from a colour table as 3D Slicer (.ctbl) or ITK-SNAP write it.
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

/// A line a label: "LABEL NAME R G B A" (3D Slicer; blanks of a name are underscores), or
/// "LABEL R G B A VISIBLE MESH "NAME"" (ITK-SNAP); "#" begins a comment. Throws ImagingError in one line that
/// says which line is wrong, for a label that comes twice or is not 0 to 65535, a name that comes twice, and
/// a file without labels or of over a megabyte.
ColourTable read_colour_table(const std::filesystem::path& path);

}  // namespace osteomill
