#include "haptic_server/imaging/hu_file.h"

#include <fmt/format.h>
#include <itkImageFileReader.h>
#include <itkImageFileWriter.h>
#include <itkMetaDataObject.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "haptic_server/imaging/image_file.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr const char* key_prefix = "osteomill_";

/// The bone's grid of an image, if it is isotropic and axis-aligned.
Grid grid_of_image(const std::filesystem::path& path, const ScanImage& image) {
    const auto spacing = image.GetSpacing();
    const auto direction = image.GetDirection();
    bool good = true;
    for (unsigned axis = 0; axis < 3; ++axis) {
        good = good && std::abs(spacing[axis] - spacing[0]) <= 1e-5 * spacing[0];
        for (unsigned other = 0; other < 3; ++other)
            good = good && std::abs(direction[axis][other] - (axis == other ? 1.0 : 0.0)) < 1e-5;
    }
    if (!good)
        throw ImagingError(fmt::format(
            "{}: is not isotropic and axis-aligned in LPS; run bone_import on it first", path.string()));
    const auto size = image.GetLargestPossibleRegion().GetSize();
    const auto origin = image.GetOrigin();
    return {.size_voxels = {static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])},
            .spacing_mm = spacing[0],
            .origin_mm = {origin[0], origin[1], origin[2]}};
}

template <typename Pixel>
void write_nrrd(const std::filesystem::path& path, const Grid& grid, std::span<const Pixel> values,
                const HeaderKeys& keys) {
    using Image = itk::Image<Pixel, 3>;
    const auto image = Image::New();
    typename Image::SizeType size;
    for (unsigned axis = 0; axis < 3; ++axis)
        size[axis] = static_cast<itk::SizeValueType>(grid.size_voxels[static_cast<int>(axis)]);
    image->SetRegions(typename Image::RegionType(size));
    const std::array<double, 3> spacing{grid.spacing_mm, grid.spacing_mm, grid.spacing_mm};
    const std::array<double, 3> origin{grid.origin_mm.x, grid.origin_mm.y, grid.origin_mm.z};
    image->SetSpacing(spacing.data());
    image->SetOrigin(origin.data());
    // The writer only reads; ITK's import container wants a pointer that is not const.
    image->GetPixelContainer()->SetImportPointer(const_cast<Pixel*>(values.data()), values.size(), false);
    for (const auto& [key, value] : keys)
        itk::EncapsulateMetaData<std::string>(image->GetMetaDataDictionary(), key, value);

    const auto writer = itk::ImageFileWriter<Image>::New();
    writer->SetImageIO(itk::NrrdImageIO::New());
    writer->SetFileName(path.string());
    writer->SetInput(image);
    writer->UseCompressionOn();
    try {
        writer->Update();
    } catch (const itk::ExceptionObject&) {
        throw ImagingError(fmt::format("{}: cannot be written; is there room, and may this user write there?",
                                       path.string()));
    }
}

}  // namespace

std::optional<double> HuFile::threshold_hu() const {
    const auto found = keys.find(threshold_key);
    if (found == keys.end()) return std::nullopt;
    char* end = nullptr;
    const double value = std::strtod(found->second.c_str(), &end);
    return end != found->second.c_str() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

HuFile read_hu_file(const std::filesystem::path& path) {
    const ScanImage::Pointer image = read_image_file(path).image;
    HuFile file;
    file.volume.grid = grid_of_image(path, *image);
    const std::size_t count = image->GetLargestPossibleRegion().GetNumberOfPixels();
    file.volume.hu.reserve(count);
    for (const float* value = image->GetBufferPointer(); value != image->GetBufferPointer() + count; ++value)
        file.volume.hu.push_back(
            static_cast<std::int16_t>(std::lround(std::clamp(*value, -32768.0F, 32767.0F))));
    const itk::MetaDataDictionary& dictionary = image->GetMetaDataDictionary();
    for (const std::string& key : dictionary.GetKeys()) {
        if (key.rfind(key_prefix, 0) != 0) continue;
        std::string value;
        if (itk::ExposeMetaData<std::string>(dictionary, key, value)) file.keys[key] = value;
    }
    return file;
}

void write_hu_file(const std::filesystem::path& path, const HuVolume& volume, const HeaderKeys& keys) {
    write_nrrd<std::int16_t>(path, volume.grid, volume.hu, keys);
}

void write_byte_file(const std::filesystem::path& path, const Grid& grid,
                     std::span<const std::uint8_t> values, const HeaderKeys& keys) {
    write_nrrd<std::uint8_t>(path, grid, values, keys);
}

std::vector<std::uint8_t> read_byte_file(const std::filesystem::path& path, const Grid& expected_grid) {
    const HuFile file = read_hu_file(path);
    if (file.volume.grid.size_voxels != expected_grid.size_voxels)
        throw ImagingError(
            fmt::format("{}: is not of the size of the bone that it belongs to", path.string()));
    std::vector<std::uint8_t> values;
    values.reserve(file.volume.hu.size());
    for (const std::int16_t value : file.volume.hu) {
        if (value < 0 || value > 255)
            throw ImagingError(fmt::format("{}: holds values beyond 0 to 255", path.string()));
        values.push_back(static_cast<std::uint8_t>(value));
    }
    return values;
}

}  // namespace osteomill
