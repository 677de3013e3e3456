#include "imaging/formats/nrrd_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "common/files/input_file.h"
#include "common/text/words.h"
#include "imaging/formats/nrrd_geometry.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::size_t most_axes = 16;

/// "datafile" is "data file"; names differ by nothing but blanks and case.
std::string field_name(std::string name) {
    name = lower_case(trimmed(name));
    constexpr std::array aliases{
        std::pair{"datafile", "data file"},       std::pair{"lineskip", "line skip"},
        std::pair{"byteskip", "byte skip"},       std::pair{"axismins", "axis mins"},
        std::pair{"axismaxs", "axis maxs"},       std::pair{"blocksize", "block size"},
        std::pair{"sampleunits", "sample units"}, std::pair{"centerings", "centers"},
        std::pair{"oldmin", "old min"},           std::pair{"oldmax", "old max"}};
    for (const auto& [alias, usual] : aliases)
        if (name == alias) return usual;
    return name;
}

std::optional<VoxelType> type_of(std::string name) {
    name = lower_case(name);
    struct Type {
        VoxelType type;
        std::vector<std::string_view> names;
    };
    static const std::vector<Type> types{
        {VoxelType::int8, {"signed char", "int8", "int8_t"}},
        {VoxelType::uint8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
        {VoxelType::int16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
        {VoxelType::uint16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
        {VoxelType::int32, {"int", "signed int", "int32", "int32_t"}},
        {VoxelType::uint32, {"uint", "unsigned int", "uint32", "uint32_t"}},
        {VoxelType::int64,
         {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64",
          "int64_t"}},
        {VoxelType::uint64,
         {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
        {VoxelType::float32, {"float"}},
        {VoxelType::float64, {"double"}}};
    for (const Type& known : types)
        if (std::find(known.names.begin(), known.names.end(), name) != known.names.end()) return known.type;
    return std::nullopt;
}

std::vector<std::uint64_t> sizes_of(const NrrdHeader& header, const std::filesystem::path& path) {
    const std::string text = header.field("sizes").value_or("");
    const auto dimension = parse_number<std::size_t>(header.field("dimension").value_or(""));
    for (const char* name : {"dimension", "sizes"})
        if (!header.fields.contains(name))
            throw ImagingError(path, fmt::format("its header has no field '{}' (cut off?)", name));
    std::vector<std::uint64_t> sizes;
    for (const std::string& word : words_of(text))
        sizes.push_back(parse_number<std::uint64_t>(word).value_or(0));
    if (!dimension || *dimension < 1 || *dimension > most_axes || sizes.size() != *dimension)
        throw ImagingError(
            path, fmt::format("dimension '{}' and sizes '{}' do not fit: as many sizes as "
                              "dimensions, 1 to {}",
                              shortened(header.field("dimension").value_or("")), shortened(text), most_axes));
    return sizes;
}

Encoding encoding_of(const NrrdHeader& header, const std::filesystem::path& path) {
    const std::string name = lower_case(header.field("encoding").value_or(""));
    if (name == "raw") return Encoding::raw;
    if (name == "gzip" || name == "gz") return Encoding::gzip;
    if (name == "txt" || name == "text" || name == "ascii") return Encoding::text;
    throw ImagingError(
        path, fmt::format("encoding '{}' is not read; save it as raw, gzip or text", shortened(name)));
}

std::vector<std::string> data_files_of(const NrrdHeader& header) {
    const std::optional<std::string> text = header.field("data file");
    if (!text) return {};
    const std::vector<std::string> words = words_of(*text);
    if (words.empty()) throw std::invalid_argument("'data file' names none");
    if (words[0] == "LIST") {
        if (words.size() > 2 || header.listed_files.empty())
            throw std::invalid_argument("'data file: LIST' names none");
        return header.listed_files;
    }
    if (text->find('%') != std::string::npos) return numbered_names(words);
    return {*text};
}

/// "\\n" is a line break, two backslashes are one.
std::string unescaped(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == 'n' || text[i + 1] == '\\'))
            result += text[++i] == 'n' ? '\n' : '\\';
        else
            result += text[i];
    }
    return result;
}

}  // namespace

NrrdHeader parse_nrrd_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.substr(0, 4) != "NRRD")
        throw ImagingError(path, "is not a NRRD file (its first line must begin with NRRD)");
    NrrdHeader header;
    bool listing = false;
    std::size_t at = 0;
    for (bool first = true; at < text.size(); first = false) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string line(text.substr(at, end - at));
        if (end == text.size() && text.size() >= most_nrrd_header_bytes)
            throw ImagingError(path, "has a header without end: no blank line within a mebibyte");
        at = std::min(end + 1, text.size());
        if (line.empty() || line == "\r") break;
        if (line.find('\0') != std::string::npos)
            throw ImagingError(path, "is damaged: a zero byte in its header");
        if (line.ends_with('\r')) line.pop_back();
        // "field: text" or "key:=value", whichever comes first.
        const std::size_t assigned = line.find(":=");
        if (!first && !listing && !line.starts_with('#') && assigned < line.find(": ")) {
            header.key_values[unescaped(line.substr(0, assigned))] = unescaped(line.substr(assigned + 2));
            continue;
        }
        line = trimmed(line);
        if (first || line.empty()) continue;
        if (listing) {
            if (header.listed_files.size() == most_data_files)
                throw ImagingError(path, "names more than 65535 data files");
            header.listed_files.push_back(line);
            continue;
        }
        const std::size_t colon = line.find(':');
        if (line[0] == '#' || colon == std::string::npos) continue;
        const std::string name = field_name(line.substr(0, colon));
        const std::string value = trimmed(line.substr(colon + 1));
        const auto [field, is_new] = header.fields.emplace(name, value);
        if (!is_new && field->second != value)
            throw ImagingError(path,
                               fmt::format("has the field '{}' twice, as '{}' and as '{}'", shortened(name),
                                           shortened(field->second), shortened(value)));
        listing = name == "data file" && value.substr(0, 4) == "LIST" &&
                  (value.size() == 4 || std::isspace(static_cast<unsigned char>(value[4])) != 0);
    }
    header.bytes = at;
    return header;
}

ImageHeader nrrd_image(const NrrdHeader& header, const std::filesystem::path& path) {
    const std::vector<std::uint64_t> sizes = sizes_of(header, path);
    const std::string type = header.field("type").value_or("");
    const std::optional<VoxelType> voxel_type = type_of(type);
    if (!voxel_type)
        throw ImagingError(
            path, fmt::format("type '{}' is none of a grey image, such as int16 or float", shortened(type)));
    ImageHeader layout{.bytes = header.bytes, .key_values = header.key_values};
    layout.voxels.type = *voxel_type;
    layout.encoding = encoding_of(header, path);
    const bool has_order = bytes_of(*voxel_type) > 1 && layout.encoding != Encoding::text;
    if (has_order && !header.fields.contains("endian"))
        throw ImagingError(path, fmt::format("does not say in which order the bytes of its {} stand; add a "
                                             "line 'endian: little' (or big)",
                                             shortened(type)));
    const std::string endian = lower_case(header.field("endian").value_or("little"));
    if (endian != "little" && endian != "big")
        throw ImagingError(path, fmt::format("endian '{}' is neither little nor big", shortened(endian)));
    layout.voxels.big_endian = endian == "big";
    const std::string lines = header.field("line skip").value_or("0");
    const std::string skip = header.field("byte skip").value_or("0");
    const auto line_skip = parse_number<std::uint64_t>(lines);
    const auto byte_skip = parse_number<std::int64_t>(skip);
    const bool at_end_allowed = layout.encoding == Encoding::raw;
    constexpr std::int64_t most_skipped = std::int64_t{1} << 40;
    if (!line_skip || *line_skip > most_nrrd_header_bytes || !byte_skip || *byte_skip > most_skipped ||
        *byte_skip < (at_end_allowed ? -1 : 0))
        throw ImagingError(path, fmt::format("line skip '{}' and byte skip '{}' lead nowhere",
                                             shortened(lines), shortened(skip)));
    layout.line_skip = *line_skip;
    layout.byte_skip = *byte_skip;
    said_of(path, [&] {
        layout.voxel_bytes = least_bytes(plausible_voxel_count(sizes), *voxel_type, layout.encoding);
        layout.data_files = data_files_of(header);
    });
    if (!layout.data_files.empty() && layout.voxel_bytes % layout.data_files.size() != 0)
        throw ImagingError(path, fmt::format("{} data files cannot share {} bytes of voxels evenly",
                                             layout.data_files.size(), layout.voxel_bytes));
    read_nrrd_geometry(header, sizes, layout, path);
    return layout;
}

ImageHeader open_nrrd(const std::filesystem::path& path) {
    return nrrd_image(parse_nrrd_header(InputFile(path).first_bytes(most_nrrd_header_bytes), path), path);
}

}  // namespace osteomill
