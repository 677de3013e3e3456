#include "imaging/formats/meta_image_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "common/files/input_file.h"
#include "common/text/words.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/formats/voxel_data.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

/// LONG has 32 bits wherever it is written, as MetaIO has it.
struct MetaElement {
    const char* name;
    VoxelType type;
};
constexpr std::array elements{
    MetaElement{"MET_CHAR", VoxelType::int8},       MetaElement{"MET_UCHAR", VoxelType::uint8},
    MetaElement{"MET_SHORT", VoxelType::int16},     MetaElement{"MET_USHORT", VoxelType::uint16},
    MetaElement{"MET_INT", VoxelType::int32},       MetaElement{"MET_UINT", VoxelType::uint32},
    MetaElement{"MET_LONG", VoxelType::int32},      MetaElement{"MET_ULONG", VoxelType::uint32},
    MetaElement{"MET_LONG_LONG", VoxelType::int64}, MetaElement{"MET_ULONG_LONG", VoxelType::uint64},
    MetaElement{"MET_FLOAT", VoxelType::float32},   MetaElement{"MET_DOUBLE", VoxelType::float64}};

/// The fields, in whose terms every complaint is made.
class MetaFields {
  public:
    explicit MetaFields(const std::filesystem::path& path) : path_(path) {}

    void add(const std::string& name, const std::string& value) {
        const auto [field, is_new] = fields_.emplace(name, value);
        if (!is_new && field->second != value && name != "Comment")
            refuse(name, fmt::format("stands there again as '{}'", shortened(value)));
    }
    std::optional<std::string> text(const std::string& name) const {
        const auto found = fields_.find(name);
        if (found == fields_.end()) return std::nullopt;
        return found->second;
    }
    /// The first of several names of a field that is there; "" if none is.
    std::string name_of(std::initializer_list<const char*> names) const {
        std::string found;
        for (const char* name : names) {
            if (!fields_.contains(name)) continue;
            if (!found.empty() && text(name) != text(found)) refuse(name, "says other than " + found);
            found = name;
        }
        return found;
    }
    std::int64_t whole(const std::string& name, std::int64_t otherwise) const {
        const std::optional<std::string> value = text(name);
        if (!value) return otherwise;
        const auto number = parse_number<std::int64_t>(*value);
        if (!number) refuse(name, "must be a whole number");
        return *number;
    }
    bool truth(const std::string& name, bool otherwise) const {
        const std::optional<std::string> value = text(name);
        if (!value) return otherwise;
        if (value->starts_with('T') || value->starts_with('t') || *value == "1") return true;
        if (value->starts_with('F') || value->starts_with('f') || *value == "0") return false;
        refuse(name, "must be True or False");
    }
    std::vector<double> numbers(const std::string& name, std::size_t count) const {
        const std::vector<std::string> words = words_of(text(name).value_or(""));
        if (words.size() != count) refuse(name, fmt::format("must be {} numbers", count));
        std::vector<double> numbers;
        for (const std::string& word : words) {
            const std::optional<double> number = real_number(word);
            if (!number) refuse(name, fmt::format("must be {} numbers", count));
            numbers.push_back(*number);
        }
        return numbers;
    }
    [[noreturn]] void refuse(const std::string& name, const std::string& reason) const {
        const std::string value = text(name).value_or("");
        throw ImagingError(path_, fmt::format("{} '{}' {}", name.substr(0, 80), shortened(value), reason));
    }

  private:
    const std::filesystem::path& path_;
    std::map<std::string, std::string> fields_;
};

/// Millimetres of one of its lengths.
double mm_of_lengths(const MetaFields& fields, const std::filesystem::path& path, SourceImage& image) {
    const std::string units = fields.text("DistanceUnits").value_or("mm");
    if (is_unknown_unit(units)) return 1.0;
    const std::optional<double> mm = mm_of_unit(units);
    if (!mm) fields.refuse("DistanceUnits", std::string("is not read; ") + known_units);
    if (*mm != 1.0)
        image.notes.push_back(
            fmt::format("{}: its DistanceUnits are {}; converted to mm", path.string(), shortened(units)));
    return *mm;
}

/// Axes beyond the third must have one voxel, and go.
void read_geometry(const MetaFields& fields, const std::filesystem::path& path, SourceImage& image) {
    const std::int64_t dimensions = fields.whole("NDims", 0);
    if (dimensions < 3 || dimensions > 10)
        throw ImagingError(path, fmt::format("has {} dimensions (NDims); a volume has 3", dimensions));
    const auto axes = static_cast<std::size_t>(dimensions);
    const std::vector<double> size = fields.numbers("DimSize", axes);
    for (std::size_t axis = 0; axis < axes; ++axis) {
        if (!(size[axis] >= 1.0 && size[axis] <= static_cast<double>(most_voxels_of_an_axis)) ||
            size[axis] != std::floor(size[axis]))
            fields.refuse("DimSize",
                          fmt::format("must be whole numbers from 1 to {}", most_voxels_of_an_axis));
        if (axis < 3)
            image.size_voxels[static_cast<int>(axis)] = static_cast<int>(size[axis]);
        else if (size[axis] != 1.0)
            throw ImagingError(path, fmt::format("has {} dimensions (NDims); a volume has 3", dimensions));
    }
    const double mm = mm_of_lengths(fields, path, image);
    // ElementSize stands in for a spacing that is not there.
    if (const std::string name = fields.text("ElementSpacing") ? "ElementSpacing" : "ElementSize";
        fields.text(name)) {
        const std::vector<double> spacing = fields.numbers(name, axes);
        for (int axis = 0; axis < 3; ++axis) {
            image.spacing_mm[axis] = spacing[static_cast<std::size_t>(axis)] * mm;
            if (!is_plausible_spacing(image.spacing_mm[axis]))
                throw ImagingError(path, implausible_spacing(name, image.spacing_mm[axis]));
        }
    } else {
        image.notes.push_back(path.string() + ": its header has no spacing; taken as 1 mm");
    }
    if (const std::string name = fields.name_of({"Offset", "Position", "Origin", "ImagePosition"});
        !name.empty()) {
        const std::vector<double> origin = fields.numbers(name, axes);
        image.origin_mm = mm * glm::dvec3(origin[0], origin[1], origin[2]);
        if (!is_plausible_position(image.origin_mm)) throw ImagingError(path, implausible_position(name));
    }
    if (const std::string name = fields.name_of({"TransformMatrix", "Orientation", "Rotation"});
        !name.empty()) {
        const std::vector<double> matrix = fields.numbers(name, axes * axes);
        for (int axis = 0; axis < 3; ++axis) {
            for (int row = 0; row < 3; ++row)
                image.direction[axis][row] =
                    matrix[axes * static_cast<std::size_t>(axis) + static_cast<std::size_t>(row)];
            const double length = glm::length(image.direction[axis]);
            if (!(length > 0.0) || !std::isfinite(length))
                fields.refuse(name, "has an axis without direction");
            image.direction[axis] /= length;
        }
    } else {
        note_guessed_orientation(image, path, "its header has no TransformMatrix");
    }
    settle_geometry(image, path);
}

void read_element(const MetaFields& fields, ImageHeader& header) {
    const std::string type = fields.text("ElementType").value_or("");
    const auto known = std::find_if(elements.begin(), elements.end(),
                                    [&](const MetaElement& element) { return type == element.name; });
    if (known == elements.end())
        fields.refuse("ElementType",
                      "is not read; it must be MET_CHAR, UCHAR, SHORT, USHORT, INT, UINT, LONG, ULONG, "
                      "LONG_LONG, ULONG_LONG, FLOAT or DOUBLE");
    header.voxels.type = known->type;
    if (fields.whole("ElementNumberOfChannels", 1) != 1)
        fields.refuse("ElementNumberOfChannels", "means colour or vectors; CT has one value a voxel");
    const std::string order = fields.name_of({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
    header.voxels.big_endian = !order.empty() && fields.truth(order, false);
    header.encoding = fields.truth("CompressedData", false) ? Encoding::zlib_or_gzip : Encoding::raw;
    if (!fields.truth("BinaryData", true)) header.encoding = Encoding::text;
    header.byte_skip = fields.whole("HeaderSize", 0);
    constexpr std::int64_t most_skipped = std::int64_t{1} << 40;
    if (header.byte_skip > most_skipped || header.byte_skip < (header.encoding == Encoding::raw ? -1 : 0))
        fields.refuse("HeaderSize", "must be 0 or more, or -1 for voxels that end a file");
    for (const char* name : {"ElementToIntensityFunctionSlope", "ElementToIntensityFunctionOffset"})
        if (fields.text(name))
            header.image.notes.push_back(
                fmt::format("{} is in the header and not applied; --rescale applies one", name));
}

std::vector<std::string> listed_slices(const std::vector<std::string>& words, std::string_view rest,
                                       const MetaFields& fields) {
    // "LIST 2": files of two dimensions, one a slice.
    if (words.size() > 2 || (words.size() == 2 && words[1] != "2" && words[1] != "2D"))
        fields.refuse("ElementDataFile", "lists files of other than two dimensions");
    std::vector<std::string> names;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string name = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (!name.empty()) names.push_back(name);
        if (names.size() > most_voxels_of_an_axis) break;
    }
    return names;
}

void read_data_files(const MetaFields& fields, std::string_view rest, ImageHeader& header) {
    const std::string text = fields.text("ElementDataFile").value_or("");
    const std::vector<std::string> words = words_of(text);
    const int slices = header.image.size_voxels.z;
    if (text == "LOCAL" || text == "Local" || text == "local") {
        header.byte_skip = 0;  // HeaderSize is of files that know nothing of MetaImage
        return;
    }
    if (words.empty()) fields.refuse("ElementDataFile", "names no file");
    if (words[0] == "LIST") {
        header.data_files = listed_slices(words, rest, fields);
    } else if (text.find('%') != std::string::npos) {
        try {
            header.data_files = numbered_names(words, slices);
        } catch (const std::invalid_argument& error) {
            fields.refuse("ElementDataFile", std::string("is refused: ") + error.what());
        }
    } else {
        header.data_files = {text};
        return;
    }
    if (header.data_files.size() != static_cast<std::size_t>(slices))
        fields.refuse("ElementDataFile", fmt::format("names {} files, where DimSize has {} slices",
                                                     header.data_files.size(), slices));
}

}  // namespace

ImageHeader parse_meta_image_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    MetaFields fields(path);
    ImageHeader header;
    while (!fields.text("ElementDataFile")) {
        const std::size_t end = text.find('\n', header.bytes);
        const bool is_last = end == std::string_view::npos;
        const std::string_view line = text.substr(header.bytes, is_last ? end : end - header.bytes);
        header.bytes = is_last ? text.size() : end + 1;
        const std::size_t equals = line.find('=');
        if (equals != std::string_view::npos && line.find('\0') == std::string_view::npos)
            fields.add(trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1)));
        else if (!trimmed(line).empty())
            break;
        if (is_last) break;
    }
    // A header that ends with its last line has no voxels behind it, but may name their file.
    if (!fields.text("ElementDataFile"))
        throw ImagingError(path, text.size() >= most_meta_image_header_bytes
                                     ? "is no MetaImage: its header has no end"
                                     : "is cut off: its header has no line ElementDataFile");
    read_geometry(fields, path, header.image);
    read_element(fields, header);
    header.voxel_bytes = least_bytes(voxel_count(header.image), header.voxels.type, header.encoding);
    read_data_files(fields, text.substr(header.bytes), header);
    return header;
}

ImageHeader open_meta_image(const std::filesystem::path& path) {
    return parse_meta_image_header(InputFile(path).first_bytes(most_meta_image_header_bytes), path);
}

}  // namespace osteomill
