#include "haptic_server/imaging/bone_file/nrrd_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "haptic_server/imaging/formats/nrrd_header.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

using Fields = std::map<std::string, std::string>;

/// Spacings and directions that differ by less than this are the same but for how they were printed.
constexpr double printing_tolerance = 1e-6;
constexpr const char* hint = "; run bone_import on it";
constexpr std::size_t most_header_bytes = 1u << 20;

const std::string& field(const std::filesystem::path& path, const Fields& fields, const char* name) {
    const auto found = fields.find(name);
    if (found == fields.end()) throw ImagingError(path, fmt::format("its header lacks the field '{}'", name));
    return found->second;
}

template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

void require_type(const std::filesystem::path& path, const Fields& fields, NrrdVoxel voxel) {
    static const std::vector<std::string> int16{"int16",     "int16_t",      "short",
                                                "short int", "signed short", "signed short int"};
    static const std::vector<std::string> uint8{"uint8", "uint8_t", "uchar", "unsigned char"};
    const std::vector<std::string>& names = voxel == NrrdVoxel::int16 ? int16 : uint8;
    if (std::find(names.begin(), names.end(), field(path, fields, "type")) == names.end())
        throw ImagingError(path, fmt::format("its voxels are not plain {}", names.front()) + hint);
}

glm::ivec3 sizes_of(const std::filesystem::path& path, const Fields& fields) {
    const std::string& dimension = field(path, fields, "dimension");
    if (dimension != "3")
        throw ImagingError(path, fmt::format("has {} dimensions where a bone has 3", dimension) + hint);
    std::istringstream words(field(path, fields, "sizes"));
    glm::ivec3 sizes{0};
    std::string word;
    for (int axis = 0; axis < 3; ++axis) {
        const std::optional<int> size = words >> word ? whole_number<int>(word) : std::nullopt;
        if (!size) throw ImagingError(path, "its sizes are not three whole numbers");
        sizes[axis] = *size;
    }
    if (words >> word) throw ImagingError(path, "its sizes are not three whole numbers");
    return sizes;
}

/// The three numbers of the next "(x,y,z)".
std::optional<glm::dvec3> next_vector(std::string_view& text) {
    const std::size_t open = text.find('(');
    const std::size_t close = text.find(')');
    if (open == text.npos || close == text.npos || close < open) return std::nullopt;
    std::string inner(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
    const char* at = inner.c_str();
    glm::dvec3 vector(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        char* end = nullptr;
        vector[axis] = std::strtod(at, &end);
        while (*end == ' ') ++end;
        if (end == at || *end != (axis < 2 ? ',' : '\0')) return std::nullopt;
        at = end + 1;
    }
    return vector;
}

/// What turns the file's space into left, posterior, superior: signs, or nothing for a space that does not
/// say how the patient lies in it.
std::optional<glm::dvec3> signs_to_lps(std::string space) {
    std::transform(space.begin(), space.end(), space.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (space == "left-posterior-superior" || space == "lps") return glm::dvec3(1.0);
    if (space == "right-anterior-superior" || space == "ras") return glm::dvec3(-1.0, -1.0, 1.0);
    if (space == "left-anterior-superior" || space == "las") return glm::dvec3(1.0, -1.0, 1.0);
    return std::nullopt;
}

Grid grid_of(const std::filesystem::path& path, const Fields& fields) {
    if (!fields.contains("space") || !fields.contains("space directions"))
        throw ImagingError(path, std::string("does not say how it lies in the patient (space)") + hint);
    const std::optional<glm::dvec3> signs = signs_to_lps(fields.at("space"));
    if (!signs)
        throw ImagingError(
            path, fmt::format("its space '{}' is not left-posterior-superior", fields.at("space")) + hint);
    Grid grid{.size_voxels = sizes_of(path, fields), .spacing_mm = 0.0, .origin_mm = glm::dvec3(0.0)};
    std::string_view directions = fields.at("space directions");
    glm::dmat3 direction;
    for (int axis = 0; axis < 3; ++axis) {
        const std::optional<glm::dvec3> vector = next_vector(directions);
        if (!vector) throw ImagingError(path, "its space directions are not three vectors (x,y,z)");
        direction[axis] = *signs * *vector;
    }
    glm::dvec3 spacing(glm::length(direction[0]), glm::length(direction[1]), glm::length(direction[2]));
    grid.spacing_mm = spacing.x;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(spacing[axis] - spacing.x) <= printing_tolerance * spacing.x))
            throw ImagingError(path, fmt::format("its voxels are not cubes ({} x {} x {} mm)", spacing.x,
                                                 spacing.y, spacing.z) +
                                         hint);
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(direction[axis][row] / spacing[axis] - (row == axis ? 1.0 : 0.0)) <=
                  printing_tolerance))
                throw ImagingError(path, std::string("its axes do not run left, posterior, superior") + hint);
    }
    if (const auto found = fields.find("space origin"); found != fields.end()) {
        std::string_view text = found->second;
        const std::optional<glm::dvec3> origin = next_vector(text);
        if (!origin) throw ImagingError(path, "its space origin is not a vector (x,y,z)");
        grid.origin_mm = *signs * *origin;
    }
    try {
        require_valid(grid);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(path, error.what());
    }
    return grid;
}

Encoding encoding_of(const std::filesystem::path& path, const Fields& fields) {
    const std::string& name = field(path, fields, "encoding");
    if (name == "raw") return Encoding::raw;
    if (name == "gzip" || name == "gz") return Encoding::gzip;
    throw ImagingError(path, fmt::format("its encoding '{}' is neither gzip nor raw", name) + hint);
}

bool swaps_bytes(const std::filesystem::path& path, const Fields& fields, NrrdVoxel voxel) {
    if (bytes_of(voxel) == 1) return false;
    const std::string& endian = field(path, fields, "endian");
    if (endian != "little" && endian != "big")
        throw ImagingError(path, fmt::format("its endian '{}' is neither little nor big", endian));
    return (endian == "big") != (std::endian::native == std::endian::big);
}

std::string unescaped(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == 'n' || text[i + 1] == '\\')) {
            result += text[++i] == 'n' ? '\n' : '\\';
        } else {
            result += text[i];
        }
    }
    return result;
}

/// Key-values, and where the data begin. The fields are nrrd_header's.
std::uint64_t read_key_values(const RegularFile& file, std::map<std::string, std::string>& key_values) {
    std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), most_header_bytes)), '\0');
    text.resize(file.read_at(0, std::as_writable_bytes(std::span(text))));
    std::size_t begin = 0;
    while (true) {
        const std::size_t end = text.find('\n', begin);
        if (end == text.npos) throw ImagingError(file.path(), "is cut off: its header has no end");
        std::string_view line = std::string_view(text).substr(begin, end - begin);
        if (line.ends_with('\r')) line.remove_suffix(1);
        begin = end + 1;
        if (line.empty()) return begin;
        // A field's name ends at the first colon, whatever follows; only then may a key begin.
        const std::size_t colon = line.find(':');
        if (line.starts_with('#') || colon == line.npos || !line.substr(colon).starts_with(":=")) continue;
        key_values[unescaped(line.substr(0, colon))] = unescaped(line.substr(colon + 2));
    }
}

void require_data_in_this_file(const std::filesystem::path& path, const Fields& fields) {
    for (const char* name : {"data file", "datafile"})
        if (fields.contains(name))
            throw ImagingError(path, std::string("its voxels lie in another file") + hint);
    for (const char* name : {"line skip", "lineskip"})
        if (const auto found = fields.find(name); found != fields.end() && found->second != "0")
            throw ImagingError(path, std::string("lines stand between its header and its voxels") + hint);
}

std::uint64_t byte_skip(const std::filesystem::path& path, const Fields& fields) {
    for (const char* name : {"byte skip", "byteskip"}) {
        const auto found = fields.find(name);
        if (found == fields.end()) continue;
        const auto skipped = whole_number<std::uint64_t>(found->second);
        if (!skipped || *skipped > (std::uint64_t{1} << 62))
            throw ImagingError(path,
                               fmt::format("its byte skip '{}' is no number of bytes", found->second) + hint);
        return *skipped;
    }
    return 0;
}

}  // namespace

void NrrdData::read_voxels(std::span<std::int16_t> voxels) {
    source_.read(std::as_writable_bytes(voxels));
    if (!swaps_) return;
    for (std::int16_t& voxel : voxels) {
        const auto bits = static_cast<std::uint16_t>(voxel);
        voxel = static_cast<std::int16_t>(static_cast<std::uint16_t>(bits << 8 | bits >> 8));
    }
}

NrrdFile::NrrdFile(const std::filesystem::path& path, NrrdVoxel voxel) {
    if (!std::filesystem::exists(path)) throw ImagingError(path, "does not exist");
    if (!std::filesystem::is_regular_file(path))
        throw ImagingError(path,
                           std::string("is not a file") + (std::filesystem::is_directory(path) ? hint : ""));
    file_ = std::make_shared<const RegularFile>(path);
    const Fields fields = read_nrrd_header(path);
    require_spacing(path, fields);
    require_data_in_this_file(path, fields);
    form_.voxel = voxel;
    form_.grid = grid_of(path, fields);
    require_type(path, fields, voxel);
    encoding_ = encoding_of(path, fields);
    swaps_ = swaps_bytes(path, fields, voxel);
    form_.bytes_before_voxels = byte_skip(path, fields);
    data_offset_ = read_key_values(*file_, form_.key_values);
    const std::uint64_t promised = form_.bytes_before_voxels + voxel_count(form_.grid) * bytes_of(voxel);
    if (!can_hold(file_->size() - data_offset_, promised, encoding_))
        throw ImagingError(path, fmt::format("is cut off: {} bytes cannot hold the voxels that its header "
                                             "promises",
                                             file_->size()));
}

NrrdData NrrdFile::data() const {
    return {ByteSource(file_, data_offset_, encoding_), swaps_};
}

}  // namespace osteomill
