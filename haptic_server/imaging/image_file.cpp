#include "haptic_server/imaging/image_file.h"

#include <fmt/format.h>
#include <itkImageFileReader.h>
#include <itkImageIOFactory.h>

#include <cmath>
#include <fstream>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

/// NRRD says its space in its text header; without one its axes mean nothing in the patient.
bool nrrd_without_space(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string line;
    if (!std::getline(file, line) || line.rfind("NRRD", 0) != 0) return false;
    while (std::getline(file, line) && !line.empty() && line != "\r")
        if (line.rfind("space:", 0) == 0 || line.rfind("space dimension:", 0) == 0) return false;
    return true;
}

void require_volume(const std::filesystem::path& path, const itk::ImageIOBase& io) {
    const auto refuse = [&](const std::string& reason) {
        throw ImagingError(fmt::format("{}: {}", path.string(), reason));
    };
    unsigned dimensions = io.GetNumberOfDimensions();
    while (dimensions > 3 && io.GetDimensions(dimensions - 1) == 1) --dimensions;
    if (dimensions != 3) refuse(fmt::format("has {} dimensions; a volume has three", dimensions));
    if (io.GetNumberOfComponents() != 1)
        refuse(fmt::format("has {} values a voxel; a scan has one", io.GetNumberOfComponents()));
    for (unsigned axis = 0; axis < 3; ++axis) {
        if (io.GetDimensions(axis) < 2) refuse("is a single slice; a volume needs at least two");
        if (!(std::isfinite(io.GetSpacing(axis)) && io.GetSpacing(axis) > 0.0))
            refuse(fmt::format("has a voxel spacing of {} mm, not above zero", io.GetSpacing(axis)));
    }
}

}  // namespace

ScanFile read_image_file(const std::filesystem::path& path) {
    itk::Object::GlobalWarningDisplayOff();
    if (!std::filesystem::is_regular_file(path))
        throw ImagingError(fmt::format("{}: no such file", path.string()));
    const auto io = itk::ImageIOFactory::CreateImageIO(path.string().c_str(),
                                                       itk::ImageIOFactory::IOFileModeEnum::ReadMode);
    if (!io)
        throw ImagingError(fmt::format(
            "{}: not a scan that can be read; give NRRD, NIfTI, MHA or a DICOM folder", path.string()));
    if (std::string(io->GetNameOfClass()) == "GDCMImageIO")
        throw ImagingError(
            fmt::format("{}: is one DICOM slice; give the folder of its series", path.string()));
    try {
        io->SetFileName(path.string());
        io->ReadImageInformation();
        require_volume(path, *io);
        const auto reader = itk::ImageFileReader<ScanImage>::New();
        reader->SetImageIO(io);
        reader->SetFileName(path.string());
        reader->Update();
        return {reader->GetOutput(), !nrrd_without_space(path)};
    } catch (const itk::ExceptionObject&) {
        throw ImagingError(fmt::format("{}: cannot be read; it is damaged or cut short", path.string()));
    }
}

}  // namespace osteomill
