#include "haptic_server/imaging/nrrd_volume.h"

#include <fmt/format.h>
#include <itkImageFileReader.h>
#include <itkImageFileWriter.h>
#include <itkImportImageContainer.h>
#include <itkMetaDataObject.h>
#include <itkNrrdImageIO.h>

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/nrrd_header.h"
#include "haptic_server/imaging/quiet_libraries.h"

namespace osteomill {

namespace {

/// Spacings and directions that differ by less than this are the same but for how they were printed.
constexpr double printing_tolerance = 1e-6;
/// zlib's fast end: on CT it costs a tenth more space than the default and a third of the time.
constexpr int gzip_level = 2;
constexpr const char* hint = "; run bone_import on it";

template <typename Voxel>
constexpr itk::IOComponentEnum component =
    std::is_same_v<Voxel, std::int16_t> ? itk::IOComponentEnum::SHORT : itk::IOComponentEnum::UCHAR;
template <typename Voxel>
constexpr const char* voxel_name = std::is_same_v<Voxel, std::int16_t> ? "int16" : "uint8";

/// The grid of an image whose information has been read; refuses what a bone cannot be stored on.
template <typename Voxel>
Grid grid_of(const std::filesystem::path& path, const itk::NrrdImageIO& io) {
    if (io.GetNumberOfDimensions() != 3)
        throw ImagingError(
            path, fmt::format("has {} dimensions where a bone has 3", io.GetNumberOfDimensions()) + hint);
    if (io.GetNumberOfComponents() != 1 || io.GetComponentType() != component<Voxel>)
        throw ImagingError(path, fmt::format("its voxels are not plain {}", voxel_name<Voxel>) + hint);
    Grid grid{.size_voxels = {}, .spacing_mm = io.GetSpacing(0), .origin_mm = {}};
    for (unsigned axis = 0; axis < 3; ++axis) {
        const int i = static_cast<int>(axis);
        grid.size_voxels[i] = static_cast<int>(io.GetDimensions(axis));
        grid.origin_mm[i] = io.GetOrigin(axis);
        if (std::abs(io.GetSpacing(axis) - grid.spacing_mm) > printing_tolerance * grid.spacing_mm)
            throw ImagingError(path, fmt::format("its voxels are not cubes ({} x {} x {} mm)",
                                                 io.GetSpacing(0), io.GetSpacing(1), io.GetSpacing(2)) +
                                         hint);
        for (unsigned row = 0; row < 3; ++row)
            if (std::abs(io.GetDirection(axis)[row] - (row == axis ? 1.0 : 0.0)) > printing_tolerance)
                throw ImagingError(path, std::string("its axes do not run left, posterior, superior") + hint);
    }
    try {
        require_valid(grid);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(path, error.what());
    }
    return grid;
}

std::map<std::string, std::string> key_values_of(const itk::MetaDataDictionary& dictionary) {
    std::map<std::string, std::string> key_values;
    for (const std::string& key : dictionary.GetKeys()) {
        std::string value;
        // ITK adds the header's own fields under names that begin so.
        if (key.rfind("NRRD_", 0) == 0 || key.rfind("ITK_", 0) == 0) continue;
        if (itk::ExposeMetaData<std::string>(dictionary, key, value)) key_values[key] = value;
    }
    return key_values;
}

template <typename Voxel>
auto borrowed_image(const Grid& grid, const std::vector<Voxel>& voxels) {
    using Image = itk::Image<Voxel, 3>;
    const auto image = Image::New();
    typename Image::SizeType size;
    typename Image::SpacingType spacing;
    typename Image::PointType origin;
    for (unsigned axis = 0; axis < 3; ++axis) {
        size[axis] = static_cast<itk::SizeValueType>(grid.size_voxels[static_cast<int>(axis)]);
        origin[axis] = grid.origin_mm[static_cast<int>(axis)];
    }
    spacing.Fill(grid.spacing_mm);
    image->SetRegions(size);
    image->SetSpacing(spacing);
    image->SetOrigin(origin);
    const auto container = Image::PixelContainer::New();
    // ITK's writer only reads, but takes no pointer to const.
    container->SetImportPointer(const_cast<Voxel*>(voxels.data()), voxels.size(), false);
    image->SetPixelContainer(container);
    return image;
}

}  // namespace

template <typename Voxel>
NrrdVolume<Voxel> read_nrrd_volume(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) throw ImagingError(path, "does not exist");
    if (!std::filesystem::is_regular_file(path))
        throw ImagingError(path,
                           std::string("is not a file") + (std::filesystem::is_directory(path) ? hint : ""));
    const std::map<std::string, std::string> header = read_nrrd_header(path);
    require_sound_nrrd(path);
    if (!header.contains("space") || !header.contains("space directions"))
        throw ImagingError(path, std::string("does not say how it lies in the patient (space)") + hint);

    using Image = itk::Image<Voxel, 3>;
    const auto io = itk::NrrdImageIO::New();
    try {
        const QuietLibraries quiet;
        io->SetFileName(path.string());
        io->ReadImageInformation();
        const Grid grid = grid_of<Voxel>(path, *io);
        const auto reader = itk::ImageFileReader<Image>::New();
        reader->SetImageIO(io);
        reader->SetFileName(path.string());
        reader->Update();
        const auto* image = reader->GetOutput();
        const Voxel* first = image->GetBufferPointer();
        return {.grid = grid,
                .voxels = std::vector<Voxel>(first, first + image->GetBufferedRegion().GetNumberOfPixels()),
                .key_values = key_values_of(io->GetMetaDataDictionary())};
    } catch (const itk::ExceptionObject&) {
        throw ImagingError(path, "cannot be read as NRRD: cut off or damaged");
    } catch (const std::bad_alloc&) {
        throw ImagingError(path, "does not fit in memory");
    }
}

template <typename Voxel>
void write_nrrd_volume(const std::filesystem::path& path, const Grid& grid, const std::vector<Voxel>& voxels,
                       const std::map<std::string, std::string>& key_values) {
    require_valid(grid);
    const auto count = static_cast<std::size_t>(grid.size_voxels.x) *
                       static_cast<std::size_t>(grid.size_voxels.y) *
                       static_cast<std::size_t>(grid.size_voxels.z);
    if (voxels.size() != count) throw std::invalid_argument("the voxels to write do not fit their grid");
    if (path.extension() != ".nrrd") throw ImagingError(path, "the name of a bone file ends in .nrrd");

    using Image = itk::Image<Voxel, 3>;
    const auto image = borrowed_image(grid, voxels);
    for (const auto& [key, value] : key_values)
        itk::EncapsulateMetaData<std::string>(image->GetMetaDataDictionary(), key, value);
    std::filesystem::path partial = path;
    partial.replace_extension(".partial.nrrd");
    std::error_code failed;
    try {
        const QuietLibraries quiet;
        const auto writer = itk::ImageFileWriter<Image>::New();
        const auto io = itk::NrrdImageIO::New();
        writer->SetImageIO(io);
        writer->SetFileName(partial.string());
        writer->SetInput(image);
        writer->UseCompressionOn();
        writer->SetCompressionLevel(gzip_level);
        writer->Update();
    } catch (const itk::ExceptionObject&) {
        std::filesystem::remove(partial, failed);
        throw ImagingError(path, "cannot be written (is the folder there, writable and not full?)");
    }
    std::filesystem::rename(partial, path, failed);
    if (failed) throw ImagingError(path, "cannot be written: " + failed.message());
}

template NrrdVolume<std::int16_t> read_nrrd_volume(const std::filesystem::path&);
template NrrdVolume<std::uint8_t> read_nrrd_volume(const std::filesystem::path&);
template void write_nrrd_volume(const std::filesystem::path&, const Grid&, const std::vector<std::int16_t>&,
                                const std::map<std::string, std::string>&);
template void write_nrrd_volume(const std::filesystem::path&, const Grid&, const std::vector<std::uint8_t>&,
                                const std::map<std::string, std::string>&);

}  // namespace osteomill
