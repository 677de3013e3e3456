#include "imaging/bone_file/hu_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/files/needed_version.h"
#include "imaging/formats/nrrd_header.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr const char* own_keys = "osteomill_";
/// Spacings and directions that differ by less than this are the same but for how they were printed.
constexpr double printing_tolerance = 1e-6;
constexpr const char* hint = "; run bone_import on it";

/// Checks the entries that a bone must have, although an image need not.
void require_form(const NrrdHeader& header, const ImageHeader& image, const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& reason) { throw ImagingError(path, reason + hint); };
    if (!image.is_placed) refuse("does not say how it lies in the patient (space)");
    if (image.layers != 1) refuse("has layers, where a bone has one value a voxel");
    if (image.voxels.type != VoxelType::int16) refuse("its voxels are not plain int16");
    if (image.encoding != Encoding::raw && image.encoding != Encoding::gzip)
        refuse(fmt::format("its encoding '{}' is neither gzip nor raw", header.fields.at("encoding")));
    if (!header.fields.contains("endian")) refuse("does not say its endian, little or big");
    if (!image.data_files.empty()) refuse("its voxels lie in another file");
    if (image.line_skip != 0) refuse("lines stand between its header and its voxels");
    if (image.byte_skip < 0) refuse("its byte skip is no number of bytes");
}

Grid grid_of(const SourceImage& image, const std::filesystem::path& path) {
    const glm::dvec3& spacing = image.spacing_mm;
    Grid grid{.size_voxels = image.size_voxels, .spacing_mm = spacing.x, .origin_mm = image.origin_mm};
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(spacing[axis] - spacing.x) <= printing_tolerance * spacing.x))
            throw ImagingError(path, fmt::format("its voxels are not cubes ({} x {} x {} mm)", spacing.x,
                                                 spacing.y, spacing.z) +
                                         hint);
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(image.direction[axis][row] - (row == axis ? 1.0 : 0.0)) <= printing_tolerance))
                throw ImagingError(path, std::string("its axes do not run left, posterior, superior") + hint);
    }
    said_of(path, [&] { require_valid(grid); });
    return grid;
}

std::optional<double> threshold_of(const std::filesystem::path& path,
                                   const std::map<std::string, std::string>& key_values) {
    const auto found = key_values.find(threshold_key);
    if (found == key_values.end()) return std::nullopt;
    char* end = nullptr;
    const double threshold_hu = std::strtod(found->second.c_str(), &end);
    if (found->second.empty() || *end != '\0' || !std::isfinite(threshold_hu))
        throw ImagingError(path, fmt::format("{}:={} is not a number of HU", threshold_key, found->second));
    return threshold_hu;
}

/// The digest of the header's meaning, however it is written.
Digest digest_of(const NrrdForm& form) {
    const Grid& grid = form.grid;
    std::string text = fmt::format("{} {} {}, {}, {} {} {}, {}\n", grid.size_voxels.x, grid.size_voxels.y,
                                   grid.size_voxels.z, grid.spacing_mm, grid.origin_mm.x, grid.origin_mm.y,
                                   grid.origin_mm.z, form.bytes_before_voxels);
    for (const auto& [key, value] : form.key_values)
        if (key.starts_with(own_keys) && key != header_digest_key)
            text += fmt::format("{}:={}\n", key, value);
    Digest digest;
    digest.add(std::as_bytes(std::span(text)));
    return digest;
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

BoneFile::BoneFile(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) throw ImagingError(path, "does not exist");
    if (!std::filesystem::is_regular_file(path))
        throw ImagingError(path,
                           std::string("is not a file") + (std::filesystem::is_directory(path) ? hint : ""));
    file_ = std::make_shared<const InputFile>(path);
    NrrdHeader header = parse_nrrd_header(file_->first_bytes(most_nrrd_header_bytes), path);
    if (const auto needed = header.key_values.find(std::string(own_keys) + needed_version_key);
        needed != header.key_values.end())
        if (const auto why_not = why_not_for_this_version(needed->second)) throw ImagingError(path, *why_not);
    const ImageHeader image = nrrd_image(header, path);
    require_form(header, image, path);
    form_.grid = grid_of(image.image, path);
    form_.bytes_before_voxels = static_cast<std::uint64_t>(image.byte_skip);
    form_.key_values = std::move(header.key_values);
    encoding_ = image.encoding;
    swaps_ = image.voxels.big_endian != (std::endian::native == std::endian::big);
    data_offset_ = header.bytes;
    const std::uint64_t promised = form_.bytes_before_voxels + voxel_count(form_.grid) * sizeof(std::int16_t);
    if (!can_hold(file_->size() - data_offset_, promised, encoding_))
        throw ImagingError(path, fmt::format("is cut off: {} bytes cannot hold the voxels that its header "
                                             "promises",
                                             file_->size()));
    require_digest(*this, header_digest_key, digest_of(form()), "header (sizes, spacing, origin, keys) is");
    threshold_hu_ = threshold_of(path, key_values());
}

NrrdData BoneFile::data() const {
    return {ByteSource(file_, data_offset_, encoding_), swaps_};
}

const std::string& BoneFile::value(const char* key) const {
    const auto found = key_values().find(key);
    if (found == key_values().end())
        throw ImagingError(path(), fmt::format("key {} is missing, which a carved bone must have", key));
    return found->second;
}

void require_digest(const BoneFile& file, const char* key, const Digest& digest, const std::string& what) {
    const auto saved = file.key_values().find(key);
    if (saved == file.key_values().end() || saved->second == digest.text()) return;
    throw ImagingError(file.path(), fmt::format("its {} damaged: digest {}, not the {} that was saved (if "
                                                "changed on purpose, run bone_import on it)",
                                                what, digest.text(), saved->second));
}

HuReader::HuReader(const BoneFile& file) : HuReader(file, file.data()) {
    data_.skip(file.form().bytes_before_voxels);
}

HuReader::HuReader(const BoneFile& file, NrrdData data)
    : file_(file), data_(std::move(data)), left_(voxel_count(file.grid())) {}

void HuReader::read(std::span<std::int16_t> hu) {
    data_.read_voxels(hu);
    digest_.add(std::as_bytes(hu));
    left_ -= hu.size();
    if (left_ > 0) return;
    data_.finish();
    require_digest(file_, hu_digest_key, digest_, "CT numbers are");
}

void HuReader::read_to_end() {
    constexpr std::uint64_t voxels_at_once = 1u << 20;
    std::vector<std::int16_t> hu(static_cast<std::size_t>(std::min(left_, voxels_at_once)));
    while (left_ > 0) read(std::span(hu).first(static_cast<std::size_t>(std::min(left_, voxels_at_once))));
}

HuSlices slices_of(HuReader& reader, const BoneFile& file) {
    return {.grid = file.grid(),
            .labelled = false,
            .read = [&reader](std::span<std::int16_t> hu, std::span<std::uint8_t>) { reader.read(hu); }};
}

BoneFileWriter::BoneFileWriter(const std::filesystem::path& path, const Grid& grid,
                               std::map<std::string, std::string> key_values,
                               std::uint64_t bytes_before_voxels)
    : form_{.voxel = NrrdVoxel::int16,
            .grid = grid,
            .bytes_before_voxels = bytes_before_voxels,
            .key_values = std::move(key_values)} {
    // Known only at the end; until then they have as much space.
    form_.key_values[hu_digest_key] = std::string(Digest::text_length, '0');
    form_.key_values[header_digest_key] = std::string(Digest::text_length, '0');
    writer_.emplace(path, form_);
}

void BoneFileWriter::add(std::span<const std::int16_t> hu) {
    hu_digest_.add(std::as_bytes(hu));
    writer_->add(std::as_bytes(hu));
}

void BoneFileWriter::commit() {
    form_.key_values[hu_digest_key] = hu_digest_.text();
    form_.key_values[header_digest_key] = digest_of(form_).text();
    writer_->commit(form_.key_values);
}

std::string threshold_text(double threshold_hu) {
    return fmt::format("{}", threshold_hu);
}

}  // namespace osteomill
