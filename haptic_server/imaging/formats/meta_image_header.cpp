#include "haptic_server/imaging/formats/meta_image_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "haptic_server/imaging/formats/plausible_geometry.h"
#include "haptic_server/imaging/formats/regular_file.h"
#include "haptic_server/imaging/formats/voxel_data.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

struct MetaElement {
    const char* name;
    VoxelType type;
};
constexpr std::array elements{
    MetaElement{"MET_CHAR", VoxelType::int8},     MetaElement{"MET_UCHAR", VoxelType::uint8},
    MetaElement{"MET_SHORT", VoxelType::int16},   MetaElement{"MET_USHORT", VoxelType::uint16},
    MetaElement{"MET_INT", VoxelType::int32},     MetaElement{"MET_UINT", VoxelType::uint32},
    MetaElement{"MET_FLOAT", VoxelType::float32}, MetaElement{"MET_DOUBLE", VoxelType::float64}};

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

std::vector<std::string> words_in(const std::string& text) {
    std::istringstream line(text);
    return {std::istream_iterator<std::string>(line), {}};
}

/// The fields, in whose terms every complaint is made.
class MetaFields {
  public:
    explicit MetaFields(const std::filesystem::path& path) : path_(path) {}

    void add(const std::string& name, const std::string& value) {
        if (!fields_.emplace(name, value).second) refuse(name, "stands there twice");
    }
    std::optional<std::string> text(const std::string& name) const {
        const auto found = fields_.find(name);
        if (found == fields_.end()) return std::nullopt;
        return found->second;
    }
    /// The first of several names of a field that is there; "" where none is.
    std::string name_of(std::initializer_list<const char*> names) const {
        std::string found;
        for (const char* name : names) {
            if (!fields_.contains(name)) continue;
            if (!found.empty()) refuse(name, "says again what " + found + " says");
            found = name;
        }
        return found;
    }
    std::int64_t whole(const std::string& name, std::int64_t otherwise) const {
        const std::optional<std::string> value = text(name);
        if (!value) return otherwise;
        std::int64_t number = 0;
        const auto [end, error] = std::from_chars(value->data(), value->data() + value->size(), number);
        if (error != std::errc() || end != value->data() + value->size())
            refuse(name, "must be a whole number");
        return number;
    }
    bool truth(const std::string& name, bool otherwise) const {
        const std::optional<std::string> value = text(name);
        if (!value) return otherwise;
        if (value->starts_with('T') || value->starts_with('t') || *value == "1") return true;
        if (value->starts_with('F') || value->starts_with('f') || *value == "0") return false;
        refuse(name, "must be True or False");
    }
    template <std::size_t count>
    std::array<double, count> numbers(const std::string& name) const {
        const std::vector<std::string> words = words_in(text(name).value_or(""));
        std::array<double, count> numbers{};
        if (words.size() != count) refuse(name, fmt::format("must be {} numbers", count));
        for (std::size_t i = 0; i < count; ++i) {
            char* end = nullptr;
            numbers[i] = std::strtod(words[i].c_str(), &end);
            if (*end != '\0') refuse(name, fmt::format("must be {} numbers", count));
        }
        return numbers;
    }
    [[noreturn]] void refuse(const std::string& name, const std::string& reason) const {
        const std::string value = text(name).value_or("");
        throw ImagingError(path_,
                           fmt::format("{} '{}' {}", name.substr(0, 80),
                                       value.size() <= 80 ? value : value.substr(0, 77) + "...", reason));
    }

  private:
    const std::filesystem::path& path_;
    std::map<std::string, std::string> fields_;
};

void read_geometry(const MetaFields& fields, const std::filesystem::path& path, SourceImage& image) {
    if (const std::int64_t dimensions = fields.whole("NDims", 0); dimensions != 3)
        throw ImagingError(path, fmt::format("has {} dimensions (NDims); a volume has 3", dimensions));
    const std::array<double, 3> size = fields.numbers<3>("DimSize");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(size[axis] >= 1.0 && size[axis] <= static_cast<double>(most_voxels_of_an_axis)) ||
            size[axis] != std::floor(size[axis]))
            fields.refuse("DimSize",
                          fmt::format("must be three whole numbers from 1 to {}", most_voxels_of_an_axis));
        image.size_voxels[static_cast<int>(axis)] = static_cast<int>(size[axis]);
    }
    // ElementSize stands in for a spacing that is not there.
    if (const std::string name = fields.text("ElementSpacing") ? "ElementSpacing" : "ElementSize";
        fields.text(name)) {
        const std::array<double, 3> spacing_mm = fields.numbers<3>(name);
        for (const double one : spacing_mm)
            if (!is_plausible_spacing(one)) throw ImagingError(path, implausible_spacing(name, one));
        image.spacing_mm = {spacing_mm[0], spacing_mm[1], spacing_mm[2]};
    } else {
        image.notes.push_back(path.string() + ": its header has no spacing; taken as 1 mm");
    }
    if (const std::string name = fields.name_of({"Offset", "Position", "Origin", "ImagePosition"});
        !name.empty()) {
        const std::array<double, 3> origin_mm = fields.numbers<3>(name);
        image.origin_mm = {origin_mm[0], origin_mm[1], origin_mm[2]};
        if (!is_plausible_position(image.origin_mm)) throw ImagingError(path, implausible_position(name));
    }
    if (const std::string name = fields.name_of({"TransformMatrix", "Orientation", "Rotation"});
        !name.empty()) {
        const std::array<double, 9> matrix = fields.numbers<9>(name);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t row = 0; row < 3; ++row)
                image.direction[static_cast<int>(axis)][static_cast<int>(row)] = matrix[3 * axis + row];
    }
    if (const std::optional<std::string> units = fields.text("DistanceUnits");
        units && *units != "mm" && *units != "?")
        fields.refuse("DistanceUnits", "is not read; it must be mm");
    try {
        require_plausible_geometry(image);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(path, error.what());
    }
}

void read_element(const MetaFields& fields, MetaImageHeader& header) {
    const std::string type = fields.text("ElementType").value_or("");
    const auto known = std::find_if(elements.begin(), elements.end(),
                                    [&](const MetaElement& element) { return type == element.name; });
    if (known == elements.end())
        fields.refuse("ElementType",
                      "is not read; it must be MET_CHAR, UCHAR, SHORT, USHORT, INT, UINT, "
                      "FLOAT or DOUBLE");
    header.voxels.type = known->type;
    if (fields.whole("ElementNumberOfChannels", 1) != 1)
        fields.refuse("ElementNumberOfChannels", "means colour or vectors; CT has one value a voxel");
    if (!fields.truth("BinaryData", false))
        fields.refuse("BinaryData", "means voxels as text, which is not read; it must be True");
    const std::string order = fields.name_of({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
    header.voxels.big_endian = !order.empty() && fields.truth(order, false);
    header.encoding = fields.truth("CompressedData", false) ? Encoding::zlib_or_gzip : Encoding::raw;
    header.header_size = fields.whole("HeaderSize", 0);
    constexpr std::int64_t most_skipped = std::int64_t{1} << 40;
    if (header.header_size > most_skipped || header.header_size < (header.encoding == Encoding::raw ? -1 : 0))
        fields.refuse("HeaderSize", "must be 0 or more, or -1 for voxels that end a file");
    for (const char* name : {"ElementToIntensityFunctionSlope", "ElementToIntensityFunctionOffset"})
        if (fields.text(name))
            header.image.notes.push_back(
                fmt::format("{} is in the header and not applied; --rescale applies one", name));
}

/// "name%03d.raw FIRST [LAST [STEP]]": as many files as slices, none more, none less.
std::vector<std::string> numbered_slices(const std::vector<std::string>& words, int slices,
                                         const MetaFields& fields) {
    std::array<std::int64_t, 3> number{1, 0, 1};
    if (words.size() > 4) fields.refuse("ElementDataFile", "must be 'name%03d.raw FIRST LAST STEP'");
    for (std::size_t i = 1; i < words.size(); ++i) {
        const auto [end, error] =
            std::from_chars(words[i].data(), words[i].data() + words[i].size(), number[i - 1]);
        constexpr std::int64_t most = 1'000'000'000;
        if (error != std::errc() || end != words[i].data() + words[i].size() || number[i - 1] < 0 ||
            number[i - 1] > most)
            fields.refuse("ElementDataFile", "must be 'name%03d.raw FIRST LAST STEP', whole numbers");
    }
    const auto [first, last, step] = number;
    if (words.size() < 3) {
        // Without a last number there are as many as slices.
    } else if (step < 1 || last < first || (last - first) / step + 1 != slices) {
        fields.refuse("ElementDataFile",
                      fmt::format("names {} files, where DimSize has {} slices",
                                  step < 1 || last < first ? 0 : (last - first) / step + 1, slices));
    }
    std::vector<std::string> names;
    try {
        for (int slice = 0; slice < slices; ++slice)
            names.push_back(numbered_name(words[0], first + slice * step));
    } catch (const std::invalid_argument& error) {
        fields.refuse("ElementDataFile", std::string("is refused: ") + error.what());
    }
    return names;
}

std::vector<std::string> listed_slices(const std::vector<std::string>& words, std::string_view rest,
                                       int slices, const MetaFields& fields) {
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
    if (names.size() != static_cast<std::size_t>(slices))
        fields.refuse("ElementDataFile",
                      fmt::format("names {} files, where DimSize has {} slices", names.size(), slices));
    return names;
}

void read_data_files(const MetaFields& fields, std::string_view rest, MetaImageHeader& header) {
    const std::string text = fields.text("ElementDataFile").value_or("");
    const std::vector<std::string> words = words_in(text);
    const int slices = header.image.size_voxels.z;
    if (text == "LOCAL" || text == "Local" || text == "local") return;
    if (words.empty()) fields.refuse("ElementDataFile", "names no file");
    if (words[0] == "LIST") {
        header.data_files = listed_slices(words, rest, slices, fields);
    } else if (text.find('%') != std::string::npos) {
        header.data_files = numbered_slices(words, slices, fields);
    } else {
        header.data_files = {text};
    }
}

}  // namespace

MetaImageHeader parse_meta_image_header(std::span<const std::uint8_t> bytes,
                                        const std::filesystem::path& path) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    MetaFields fields(path);
    MetaImageHeader header;
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
                                     ? "cannot be read as MetaImage: its header has no end"
                                     : "cannot be read as MetaImage: cut off or damaged (no line "
                                       "ElementDataFile)");
    read_geometry(fields, path, header.image);
    read_element(fields, header);
    read_data_files(fields, text.substr(header.bytes), header);
    return header;
}

}  // namespace osteomill
