#include "haptic_server/imaging/formats/image_reader.h"

#include <fmt/format.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>

#include "haptic_server/imaging/dicom/dicom_image.h"
#include "haptic_server/imaging/dicom/quiet_libraries.h"
#include "haptic_server/imaging/formats/meta_image.h"
#include "haptic_server/imaging/formats/nifti_header.h"
#include "haptic_server/imaging/formats/nrrd_header.h"
#include "haptic_server/imaging/formats/plausible_geometry.h"
#include "haptic_server/imaging/formats/regular_file.h"
#include "haptic_server/imaging/formats/value_slices.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr int most_layers = 255;

bool ends_with_any(const std::string& name, std::initializer_list<const char*> endings) {
    return std::any_of(endings.begin(), endings.end(),
                       [&](const char* ending) { return name.ends_with(ending); });
}

enum class FileKind { nrrd, nifti, meta_image, other };

/// By the file's name.
FileKind kind_of(const std::filesystem::path& path) {
    std::string name = path.filename().string();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ends_with_any(name, {".nrrd", ".nhdr"})) return FileKind::nrrd;
    if (ends_with_any(name, {".nii", ".nii.gz", ".hdr", ".img", ".img.gz"})) return FileKind::nifti;
    if (ends_with_any(name, {".mha", ".mhd"})) return FileKind::meta_image;
    return FileKind::other;
}

itk::ImageIOBase::Pointer io_for(const std::filesystem::path& path) {
    if (kind_of(path) == FileKind::nrrd) return itk::NrrdImageIO::New().GetPointer();
    return itk::NiftiImageIO::New().GetPointer();
}

void require_thickness(const std::filesystem::path& path, const glm::ivec3& size_voxels) {
    if (std::min({size_voxels.x, size_voxels.y, size_voxels.z}) < 2)
        throw ImagingError(path, fmt::format("is a single slice ({} x {} x {} voxels), which is no volume",
                                             size_voxels.x, size_voxels.y, size_voxels.z));
}

void require_volume(const std::filesystem::path& path, const itk::ImageIOBase& io, bool may_have_layers) {
    if (io.GetNumberOfComponents() != 1 && !may_have_layers)
        throw ImagingError(path, fmt::format("has {} values a voxel (colour or vectors); CT has one",
                                             io.GetNumberOfComponents()));
    unsigned dimensions = io.GetNumberOfDimensions();
    while (dimensions > 3 && io.GetDimensions(dimensions - 1) == 1) --dimensions;
    if (dimensions != 3)
        throw ImagingError(path, fmt::format("has {} dimensions; a volume has 3", dimensions));
}

SourceImage geometry_of(const std::filesystem::path& path, const itk::ImageIOBase& io) {
    SourceImage image;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const int i = static_cast<int>(axis);
        image.size_voxels[i] = static_cast<int>(io.GetDimensions(axis));
        image.spacing_mm[i] = io.GetSpacing(axis);
        image.origin_mm[i] = io.GetOrigin(axis);
        for (int row = 0; row < 3; ++row)
            image.direction[i][row] = io.GetDirection(axis)[static_cast<std::size_t>(row)];
    }
    try {
        require_plausible_geometry(image);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(path, error.what());
    }
    return image;
}

/// What a NRRD leaves open is taken as LPS, and said.
void note_nrrd_orientation(const std::filesystem::path& path, SourceImage& image) {
    const std::map<std::string, std::string> header = read_nrrd_header(path);
    const auto space = header.find("space");
    const std::string name = space == header.end() ? "" : space->second;
    constexpr std::array anatomical{"left-posterior-superior", "lps", "right-anterior-superior", "ras",
                                    "left-anterior-superior",  "las"};
    if (std::find(anatomical.begin(), anatomical.end(), name) != anatomical.end()) return;
    image.notes.push_back(
        fmt::format("{}: its header {}; taken as left-posterior-superior (LPS)", path.string(),
                    name.empty() ? "says nothing of orientation" : "says only 'space: " + name + "'"));
    if (!header.contains("spacings") && !header.contains("space directions"))
        image.notes.push_back(path.string() + ": its header has no spacing; taken as 1 mm");
}

/// Where and how the voxels of a file lie.
struct FileVoxels {
    VoxelData data;
    VoxelLayout layout;
};

FileVoxels voxels_of(const std::filesystem::path& path) {
    if (kind_of(path) == FileKind::nifti) {
        NiftiImage image = open_nifti(path);
        return {.data = std::move(image.data), .layout = image.header.voxels};
    }
    const NrrdHeader header = parse_nrrd_header(RegularFile(path).first_bytes(most_nrrd_header_bytes), path);
    const NrrdLayout layout = nrrd_layout(header, path);
    return {.data = nrrd_voxel_data(header, layout, path), .layout = layout.voxels};
}

/// What reading slice by slice holds.
std::uint64_t bytes_of_slice(const SourceImage& image) {
    return sizeof(float) * static_cast<std::uint64_t>(image.size_voxels.x) *
           static_cast<std::uint64_t>(image.size_voxels.y);
}

void read_by_slice(FileVoxels voxels, int layers, OpenedImage& opened) {
    opened.reading_bytes = static_cast<std::uint64_t>(layers) * bytes_of_slice(opened.image);
    opened.read_slices = [voxels = std::move(voxels),
                          size = opened.image.size_voxels * glm::ivec3(layers, 1, 1)](
                             const TakeSlice& take, const ReportProgress& report) {
        read_value_slices(voxels.data, voxels.layout, size, take, report);
    };
}

/// ITK says how the image lies in the patient; header and files are held against each other before.
OpenedLabels open_nrrd_or_nifti(const std::filesystem::path& path, bool may_have_layers) {
    const bool is_nrrd = kind_of(path) == FileKind::nrrd;
    FileVoxels voxels = voxels_of(path);
    const std::uint64_t more = require_room(voxels.data);
    OpenedLabels found;
    OpenedImage& opened = found.opened;
    const itk::ImageIOBase::Pointer io = io_for(path);
    try {
        const QuietLibraries quiet;
        io->SetFileName(path.string());
        io->ReadImageInformation();
    } catch (const itk::ExceptionObject&) {
        throw ImagingError(
            path, fmt::format("cannot be read as {}: cut off or damaged", is_nrrd ? "NRRD" : "NIfTI"));
    }
    require_volume(path, *io, may_have_layers);
    found.layers = static_cast<int>(io->GetNumberOfComponents());
    if (found.layers > most_layers) throw ImagingError(path, "has more than 255 layers");
    opened.image = geometry_of(path, *io);
    require_thickness(path, opened.image.size_voxels);
    if (is_nrrd) note_nrrd_orientation(path, opened.image);
    if (more > 0)
        opened.image.notes.push_back(
            fmt::format("{}: {} bytes follow its voxels; they are not read", path.string(), more));
    read_by_slice(std::move(voxels), found.layers, opened);
    return found;
}

OpenedImage open_meta_image_file(const std::filesystem::path& path) {
    MetaImage image = open_meta_image(path);
    OpenedImage opened;
    opened.image = image.header.image;
    require_thickness(path, opened.image.size_voxels);
    read_by_slice({.data = std::move(image.data), .layout = image.header.voxels}, 1, opened);
    return opened;
}

OpenedImage open_folder(const std::filesystem::path& folder, const std::optional<std::string>& series_uid) {
    const std::vector<DicomSeries> series = find_series(folder);
    std::vector<std::string> others;
    OpenedImage opened = open_series(folder, choose_series(folder, series, series_uid, others));
    for (const std::string& other : others)
        opened.image.notes.push_back(
            fmt::format("{}: passed over series {}; --series picks one", folder.string(), other));
    return opened;
}

}  // namespace

std::vector<float> OpenedImage::read_values(const ReportProgress& report) const {
    std::vector<float> values;
    values.reserve(voxel_count(image));
    read_slices([&](int, std::span<float> slice) { values.insert(values.end(), slice.begin(), slice.end()); },
                report);
    return values;
}

OpenedLabels open_labels(const std::filesystem::path& path) {
    const FileKind kind = kind_of(path);
    if (kind != FileKind::nrrd && kind != FileKind::nifti)
        throw ImagingError(path, "is no label map: NRRD (.seg.nrrd, .nrrd, .nhdr) or NIfTI (.nii, .nii.gz)");
    RegularFile(path).first_bytes(1);  // one line for what does not exist or is no file
    return open_nrrd_or_nifti(path, kind == FileKind::nrrd);
}

OpenedImage open_image(const std::filesystem::path& path, const std::optional<std::string>& series_uid) {
    std::error_code failed;
    const std::filesystem::file_status status = std::filesystem::status(path, failed);
    if (!std::filesystem::exists(status)) throw ImagingError(path, "does not exist");
    if (std::filesystem::is_directory(status)) return open_folder(path, series_uid);
    if (!std::filesystem::is_regular_file(status)) throw ImagingError(path, "is neither a file nor a folder");
    if (std::filesystem::file_size(path, failed) == 0) throw ImagingError(path, "is empty");
    const FileKind kind = kind_of(path);
    if (kind == FileKind::meta_image) return open_meta_image_file(path);
    if (kind != FileKind::other) return open_nrrd_or_nifti(path, false).opened;
    if (read_dicom_header(path)) return open_series(path, series_of_file(path));
    throw ImagingError(path,
                       "is no DICOM folder or file, NRRD (.nrrd, .nhdr), NIfTI (.nii, .nii.gz) or MetaImage "
                       "(.mha, .mhd)");
}

}  // namespace osteomill
