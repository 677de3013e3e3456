#include "haptic_server/imaging/meta_image_header.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

struct MetaImageHeader {
    std::map<std::string, std::string> fields;
    std::uint64_t bytes = 0;  ///< where LOCAL voxels begin
};

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The header ends with the line that names the data.
MetaImageHeader read_meta_image_header(const std::filesystem::path& path) {
    constexpr int most_lines = 4096;
    std::ifstream file(path, std::ios::binary);
    MetaImageHeader header;
    std::string line;
    for (int i = 0; i < most_lines && std::getline(file, line); ++i) {
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos) continue;
        const std::string name = trimmed(line.substr(0, equals));
        header.fields[name] = trimmed(line.substr(equals + 1));
        if (name != "ElementDataFile") continue;
        header.bytes = file ? static_cast<std::uint64_t>(file.tellg()) : 0;
        return header;
    }
    throw ImagingError(path, "cannot be read as MetaImage: cut off or damaged (no line ElementDataFile)");
}

std::string field(const MetaImageHeader& header, const char* name) {
    const auto found = header.fields.find(name);
    return found == header.fields.end() ? "" : found->second;
}

}  // namespace

void require_meta_image_spacing(const std::filesystem::path& path) {
    const MetaImageHeader header = read_meta_image_header(path);
    for (const char* name : {"ElementSpacing", "ElementSize"}) {
        std::istringstream words(field(header, name));
        for (std::string word; words >> word;) {
            const double spacing_mm = std::strtod(word.c_str(), nullptr);
            if (!(spacing_mm > 0.0) || !std::isfinite(spacing_mm))
                throw ImagingError(path, std::string(name) + " '" + field(header, name) +
                                             "': every axis needs a spacing in mm that is a number above 0");
        }
    }
}

void require_whole_meta_image(const std::filesystem::path& path, std::uint64_t voxel_bytes) {
    const MetaImageHeader header = read_meta_image_header(path);
    const std::string data = field(header, "ElementDataFile");
    const bool local = data == "LOCAL" || data == "Local" || data == "local";
    // A list or a pattern of files, one a slice: ITK misses a file that is not there.
    if (data.starts_with("LIST") || data.find('%') != std::string::npos) return;
    const std::filesystem::path holder = local ? path : path.parent_path() / data;
    std::error_code missing;
    const std::uint64_t size = std::filesystem::file_size(holder, missing);
    if (missing) throw ImagingError(path, "its voxels are in " + data + ", which is not there");
    std::uint64_t expected = voxel_bytes;
    if (const std::string text = field(header, "CompressedData"); text == "True" || text == "true")
        expected = std::strtoull(field(header, "CompressedDataSize").c_str(), nullptr, 10);
    const std::uint64_t found = local ? size - std::min(size, header.bytes) : size;
    if (found < expected)
        throw ImagingError(path, "is cut off: " + std::to_string(found) + " of " + std::to_string(expected) +
                                     " bytes of voxels are there");
}

}  // namespace osteomill
