#include "haptic_server/imaging/dicom_image.h"

#include <fmt/format.h>
#include <itkGDCMImageIO.h>
#include <itkImageFileReader.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/plausible_geometry.h"
#include "haptic_server/imaging/quiet_libraries.h"
#include "haptic_server/imaging/regular_file.h"

namespace osteomill {

namespace {

using FloatImage = itk::Image<float, 3>;

/// A copy in memory of a file whose header states the wrong sign of its pixels, with the right one.
class MendedFile {
  public:
    MendedFile(const std::filesystem::path& path, std::uint64_t sign_begin, bool is_signed)
        : descriptor_(::memfd_create("osteomill", MFD_CLOEXEC)) {
        const RegularFile file(path);
        std::vector<std::uint8_t> bytes = file.first_bytes(file.size());
        if (sign_begin + 2 > bytes.size()) throw ImagingError(path, "was cut off while it was read");
        // JPEG 2000 is little-endian.
        bytes[sign_begin] = is_signed ? 1 : 0;
        bytes[sign_begin + 1] = 0;
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
            if (count < 0) throw std::bad_alloc();
            done += static_cast<std::size_t>(count);
        }
    }
    ~MendedFile() { ::close(descriptor_); }
    MendedFile(const MendedFile&) = delete;
    MendedFile& operator=(const MendedFile&) = delete;

    std::string name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

  private:
    int descriptor_;
};

/// All frames of a file. GDCM applies the file's own rescale slope and intercept.
FloatImage::Pointer read_frames(const std::filesystem::path& file, const DicomHeader& header) {
    std::optional<MendedFile> mended;
    if (header.wrong_sign_begin) mended.emplace(file, *header.wrong_sign_begin, header.codestream_is_signed);
    try {
        const QuietLibraries quiet;
        const auto reader = itk::ImageFileReader<FloatImage>::New();
        reader->SetImageIO(itk::GDCMImageIO::New());
        reader->SetFileName(mended ? mended->name() : file.string());
        reader->Update();
        return reader->GetOutput();
    } catch (const std::exception&) {
        const std::string& syntax = header.transfer_syntax;
        throw ImagingError(file,
                           fmt::format("its pixel data cannot be decoded ({}): cut off, damaged, or a codec "
                                       "that GDCM does not read",
                                       syntax.empty() ? "unknown transfer syntax" : syntax));
    }
}

/// What a user should know of files that are read nevertheless.
void note_doubts(const std::filesystem::path& folder, const DicomSeries& series, SourceImage& image) {
    const auto wrong = std::count_if(series.files.begin(), series.files.end(), [](const DicomFile& file) {
        return file.header.wrong_sign_begin.has_value();
    });
    if (wrong > 0) {
        const bool is_signed =
            std::find_if(series.files.begin(), series.files.end(), [](const DicomFile& file) {
                return file.header.wrong_sign_begin.has_value();
            })->header.codestream_is_signed;
        image.notes.push_back(fmt::format(
            "{}: warning: {} file(s) say {} pixels (0028,0103) where their JPEG 2000 codestream says {}; the "
            "codestream is followed",
            folder.string(), wrong, is_signed ? "unsigned" : "signed", is_signed ? "signed" : "unsigned"));
    }
    const std::string& modality = series.files.front().header.modality;
    if (!modality.empty() && modality != "CT")
        image.notes.push_back(
            fmt::format("{}: warning: its modality is {}, not CT; its values are taken for "
                        "HU unless --rescale or --intensity-window makes HU of them",
                        folder.string(), modality));
}

void read_stack(const std::vector<DicomSlice>& slices, const std::vector<std::size_t>& order,
                const std::map<std::filesystem::path, DicomHeader>& header_of_file, const TakeSlice& take,
                const ReportProgress& report) {
    const auto per_slice = static_cast<std::size_t>(slices.front().placement.columns) *
                           static_cast<std::size_t>(slices.front().placement.rows);
    FloatImage::Pointer frames;
    std::filesystem::path held;
    for (std::size_t place = 0; place < order.size(); ++place) {
        const DicomSlice& slice = slices[order[place]];
        if (slice.file != held) frames = read_frames(slice.file, header_of_file.at(slice.file));
        held = slice.file;
        const auto size = frames->GetBufferedRegion().GetSize();
        if (size[0] * size[1] != per_slice || slice.frame >= size[2])
            throw ImagingError(slice.file, "its pixel data has not the size that its header says");
        take(static_cast<int>(place),
             std::span(frames->GetBufferPointer() + slice.frame * per_slice, per_slice));
        report(static_cast<double>(place + 1) / static_cast<double>(order.size()));
    }
}

/// What GDCM and ITK hold at once of a file: its bytes, and its frames as stored, rescaled and as float.
std::uint64_t bytes_to_read(const DicomFile& file) {
    constexpr std::uint64_t bytes_of_a_pixel = 10;
    return RegularFile(file.path).size() + file.header.frames.size() * bytes_of_a_pixel *
                                               static_cast<std::uint64_t>(file.header.rows) *
                                               static_cast<std::uint64_t>(file.header.columns);
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
    std::map<std::filesystem::path, DicomHeader> header_of_file;
    for (const DicomFile& file : series.files) header_of_file[file.path] = file.header;

    OpenedImage opened;
    opened.image.size_voxels = {placements.front().columns, placements.front().rows,
                                static_cast<int>(placements.size())};
    opened.image.spacing_mm = stack.spacing_mm;
    opened.image.origin_mm = stack.origin_mm;
    opened.image.direction = stack.direction;
    try {
        require_plausible_geometry(opened.image);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(folder, error.what());
    }
    note_doubts(folder, series, opened.image);
    opened.read_slices = [slices, order = stack.order, header_of_file](const TakeSlice& take,
                                                                       const ReportProgress& report) {
        read_stack(slices, order, header_of_file, take, report);
    };
    for (const DicomFile& file : series.files)
        opened.reading_bytes = std::max(opened.reading_bytes, bytes_to_read(file));
    return opened;
}

}  // namespace osteomill
