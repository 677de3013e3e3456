#include "imaging/bone_file/nrrd_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <stdexcept>

#include "imaging/formats/nrrd_header.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

/// Spacings and directions that differ by less than this are the same but for how they were printed.
constexpr double printing_tolerance = 1e-6;
constexpr const char* hint = "; run bone_import on it";

/// What a bone may not leave open, although an image may.
void require_form(const NrrdHeader& header, const ImageHeader& image, NrrdVoxel voxel,
                  const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& reason) { throw ImagingError(path, reason + hint); };
    if (!image.is_placed) refuse("does not say how it lies in the patient (space)");
    if (image.layers != 1) refuse("has layers, where a bone has one value a voxel");
    const bool is_int16 = voxel == NrrdVoxel::int16;
    if (image.voxels.type != (is_int16 ? VoxelType::int16 : VoxelType::uint8))
        refuse(fmt::format("its voxels are not plain {}", is_int16 ? "int16" : "uint8"));
    if (image.encoding != Encoding::raw && image.encoding != Encoding::gzip)
        refuse(fmt::format("its encoding '{}' is neither gzip nor raw", header.fields.at("encoding")));
    if (is_int16 && !header.fields.contains("endian")) refuse("does not say its endian, little or big");
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
    try {
        require_valid(grid);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(path, error.what());
    }
    return grid;
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
    file_ = std::make_shared<const InputFile>(path);
    NrrdHeader header = parse_nrrd_header(file_->first_bytes(most_nrrd_header_bytes), path);
    const ImageHeader image = nrrd_image(header, path);
    require_form(header, image, voxel, path);
    form_.voxel = voxel;
    form_.grid = grid_of(image.image, path);
    form_.bytes_before_voxels = static_cast<std::uint64_t>(image.byte_skip);
    form_.key_values = std::move(header.key_values);
    encoding_ = image.encoding;
    swaps_ = bytes_of(voxel) > 1 && image.voxels.big_endian != (std::endian::native == std::endian::big);
    data_offset_ = header.bytes;
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
