#include "haptic_server/imaging/dicom_image.h"

#include <fmt/format.h>
#include <itkGDCMImageIO.h>
#include <itkImageFileReader.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/quiet_libraries.h"

namespace osteomill {

namespace {

using FloatImage = itk::Image<float, 3>;

/// All frames of a file. GDCM applies the file's own rescale slope and intercept.
FloatImage::Pointer read_frames(const std::filesystem::path& file, const std::string& transfer_syntax) {
    try {
        const QuietLibraries quiet;
        const auto reader = itk::ImageFileReader<FloatImage>::New();
        reader->SetImageIO(itk::GDCMImageIO::New());
        reader->SetFileName(file.string());
        reader->Update();
        return reader->GetOutput();
    } catch (const std::exception&) {
        throw ImagingError(
            file, fmt::format("its pixel data cannot be decoded ({}): cut off, damaged, or a codec "
                              "that GDCM does not read",
                              transfer_syntax.empty() ? "unknown transfer syntax" : transfer_syntax));
    }
}

std::vector<float> read_stack(const std::vector<DicomSlice>& slices, const std::vector<std::size_t>& order,
                              const std::map<std::filesystem::path, std::string>& syntax_of_file,
                              const ReportProgress& report) {
    const auto per_slice = static_cast<std::size_t>(slices.front().placement.columns) *
                           static_cast<std::size_t>(slices.front().placement.rows);
    std::vector<float> values(per_slice * slices.size());
    FloatImage::Pointer frames;
    std::filesystem::path held;
    for (std::size_t place = 0; place < order.size(); ++place) {
        const DicomSlice& slice = slices[order[place]];
        if (slice.file != held) frames = read_frames(slice.file, syntax_of_file.at(slice.file));
        held = slice.file;
        const auto size = frames->GetBufferedRegion().GetSize();
        if (size[0] * size[1] != per_slice || slice.frame >= size[2])
            throw ImagingError(slice.file, "its pixel data has not the size that its header says");
        std::copy_n(frames->GetBufferPointer() + slice.frame * per_slice, per_slice,
                    values.begin() + static_cast<std::ptrdiff_t>(place * per_slice));
        report(static_cast<double>(place + 1) / static_cast<double>(order.size()));
    }
    return values;
}

}  // namespace

OpenedImage open_series(const std::filesystem::path& folder, const DicomSeries& series) {
    const std::vector<DicomSlice> slices = slices_of(series);
    std::vector<SlicePlacement> placements;
    for (const DicomSlice& slice : slices) placements.push_back(slice.placement);
    SliceStack stack;
    try {
        stack = stack_slices(placements);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(folder, error.what());
    }
    std::map<std::filesystem::path, std::string> syntax_of_file;
    for (const DicomFile& file : series.files) syntax_of_file[file.path] = file.header.transfer_syntax;

    OpenedImage opened;
    opened.image.size_voxels = {placements.front().columns, placements.front().rows,
                                static_cast<int>(placements.size())};
    opened.image.spacing_mm = stack.spacing_mm;
    opened.image.origin_mm = stack.origin_mm;
    opened.image.direction = stack.direction;
    opened.read_values = [slices, order = stack.order, syntax_of_file](const ReportProgress& report) {
        return read_stack(slices, order, syntax_of_file, report);
    };
    return opened;
}

}  // namespace osteomill
