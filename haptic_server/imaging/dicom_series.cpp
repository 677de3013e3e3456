#include "haptic_server/imaging/dicom_series.h"

#include <fmt/format.h>
#include <gdcmReader.h>
#include <gdcmStringFilter.h>
#include <gdcmTrace.h>
#include <itkGDCMImageIO.h>
#include <itkImageFileReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <sstream>

#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/slice_geometry.h"

namespace osteomill {

namespace {

const gdcm::Tag series_uid(0x0020, 0x000e);
const gdcm::Tag series_description(0x0008, 0x103e);
const gdcm::Tag image_position(0x0020, 0x0032);
const gdcm::Tag image_orientation(0x0020, 0x0037);
const gdcm::Tag pixel_spacing(0x0028, 0x0030);
const gdcm::Tag row_count(0x0028, 0x0010);
const gdcm::Tag column_count(0x0028, 0x0011);
const gdcm::Tag frame_count(0x0028, 0x0008);
const gdcm::Tag samples_per_pixel(0x0028, 0x0002);
const gdcm::Tag pixel_data(0x7fe0, 0x0010);

/// Its own reports go to standard error; ours name the file and come once.
void silence_gdcm() {
    gdcm::Trace::DebugOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    itk::Object::GlobalWarningDisplayOff();
}

/// The header of one file; absent where the file is not DICOM.
class DicomHeader {
  public:
    explicit DicomHeader(const std::string& file) {
        reader_.SetFileName(file.c_str());
        readable_ = reader_.Read();
        if (readable_) filter_.SetFile(reader_.GetFile());
    }
    bool readable() const { return readable_; }
    bool has(const gdcm::Tag& tag) const { return reader_.GetFile().GetDataSet().FindDataElement(tag); }
    std::string text(const gdcm::Tag& tag) {
        if (!has(tag)) return {};
        std::string value = filter_.ToString(tag);
        while (!value.empty() && (value.back() == ' ' || value.back() == '\0')) value.pop_back();
        return value;
    }
    /// Backslash-separated numbers; fewer than asked for give nullopt.
    std::optional<std::vector<double>> numbers(const gdcm::Tag& tag, std::size_t count) {
        std::string value = text(tag);
        std::replace(value.begin(), value.end(), '\\', ' ');
        std::istringstream stream(value);
        std::vector<double> result;
        for (double number = 0.0; stream >> number;) result.push_back(number);
        if (result.size() < count ||
            !std::all_of(result.begin(), result.end(), [](double v) { return std::isfinite(v); }))
            return std::nullopt;
        return result;
    }

  private:
    gdcm::Reader reader_;
    gdcm::StringFilter filter_;
    bool readable_ = false;
};

/// A quick look: DICOM files carry "DICM" after a preamble of 128 bytes.
bool looks_like_dicom(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::array<char, 132> start{};
    stream.read(start.data(), start.size());
    return stream.gcount() == 132 && std::memcmp(start.data() + 128, "DICM", 4) == 0;
}

SlicePlacement placement_of(const std::string& file) {
    const auto refuse = [&](const std::string& reason) {
        throw ImagingError(fmt::format("{}: {}", file, reason));
    };
    DicomHeader header(file);
    if (!header.readable()) refuse("cannot be read as DICOM; it may be cut short");
    if (!header.has(pixel_data)) refuse("holds no pixel data");
    if (const auto frames = header.numbers(frame_count, 1); frames && frames->front() > 1.0)
        refuse(fmt::format("holds {:.0f} frames; export the series as one file a slice", frames->front()));
    if (const auto samples = header.numbers(samples_per_pixel, 1); samples && samples->front() != 1.0)
        refuse("is a colour image, not CT");
    const auto position = header.numbers(image_position, 3);
    const auto orientation = header.numbers(image_orientation, 6);
    const auto spacing = header.numbers(pixel_spacing, 2);
    const auto rows = header.numbers(row_count, 1);
    const auto columns = header.numbers(column_count, 1);
    if (!spacing || (*spacing)[0] <= 0.0 || (*spacing)[1] <= 0.0) refuse("says no pixel spacing (0028,0030)");
    if (!position) refuse("says no image position (0020,0032)");
    if (!orientation) refuse("says no image orientation (0020,0037)");
    if (!rows || !columns) refuse("says no image size");

    const std::vector<double>& o = *orientation;
    SlicePlacement slice{
        .file = file,
        .position_mm = {(*position)[0], (*position)[1], (*position)[2]},
        .row_direction = {o[0], o[1], o[2]},
        .column_direction = {o[3], o[4], o[5]},
        .pixel_spacing_mm = {(*spacing)[1], (*spacing)[0]},
        .size_pixels = {static_cast<int>(columns->front()), static_cast<int>(rows->front())}};
    const bool orthonormal = std::abs(glm::length(slice.row_direction) - 1.0) < 1e-3 &&
                             std::abs(glm::length(slice.column_direction) - 1.0) < 1e-3 &&
                             std::abs(glm::dot(slice.row_direction, slice.column_direction)) < 1e-3;
    if (!orthonormal) refuse("has an image orientation that is not orthonormal");
    slice.row_direction = glm::normalize(slice.row_direction);
    slice.column_direction = glm::normalize(slice.column_direction);
    return slice;
}

/// Copies the pixels of one slice, rescaled to HU by its own slope and intercept, into the volume.
void read_slice(const SlicePlacement& slice, float* pixels) {
    const auto io = itk::GDCMImageIO::New();
    const auto reader = itk::ImageFileReader<ScanImage>::New();
    reader->SetImageIO(io);
    reader->SetFileName(slice.file);
    try {
        reader->Update();
    } catch (const itk::ExceptionObject&) {
        throw ImagingError(
            fmt::format("{}: its pixels cannot be decoded: unreadable codec or damaged file", slice.file));
    }
    const ScanImage* image = reader->GetOutput();
    const auto size = image->GetLargestPossibleRegion().GetSize();
    const std::size_t count = static_cast<std::size_t>(slice.size_pixels.x) * slice.size_pixels.y;
    if (size[0] * size[1] * size[2] != count)
        throw ImagingError(fmt::format("{}: its pixels do not fill {} x {}", slice.file, slice.size_pixels.x,
                                       slice.size_pixels.y));
    std::copy_n(image->GetBufferPointer(), count, pixels);
}

}  // namespace

std::vector<DicomSeries> list_series(const std::filesystem::path& folder) {
    silence_gdcm();
    if (!std::filesystem::is_directory(folder))
        throw ImagingError(fmt::format("{}: no such folder", folder.string()));
    std::map<std::string, DicomSeries> by_uid;
    std::string without_pixels;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!entry.is_regular_file() || !looks_like_dicom(entry.path())) continue;
        const std::string file = entry.path().string();
        DicomHeader header(file);
        if (!header.readable())
            throw ImagingError(fmt::format("{}: cannot be read as DICOM; it may be cut short", file));
        if (!header.has(row_count)) {  // an index, a report: no image and not meant to be one
            without_pixels = file;
            continue;
        }
        const std::string uid = header.text(series_uid);
        DicomSeries& series = by_uid[uid];
        series.uid = uid;
        series.description = header.text(series_description);
        series.files.push_back(file);
    }
    if (by_uid.empty())
        throw ImagingError(
            without_pixels.empty()
                ? fmt::format("{}: no DICOM file in this folder", folder.string())
                : fmt::format("{}: holds no pixel data, nor does any file beside it", without_pixels));
    std::vector<DicomSeries> all;
    for (auto& [uid, series] : by_uid) {
        std::sort(series.files.begin(), series.files.end());
        all.push_back(std::move(series));
    }
    std::stable_sort(all.begin(), all.end(), [](const DicomSeries& a, const DicomSeries& b) {
        return a.files.size() > b.files.size();
    });
    return all;
}

ScanImage::Pointer read_series(const DicomSeries& series, const Progress& progress) {
    silence_gdcm();
    std::vector<SlicePlacement> placements;
    for (const std::string& file : series.files) placements.push_back(placement_of(file));
    const SliceStack stack = stack_slices(std::move(placements));
    const SlicePlacement& first = stack.slices.front();

    auto image = ScanImage::New();
    ScanImage::SizeType size;
    size[0] = static_cast<itk::SizeValueType>(first.size_pixels.x);
    size[1] = static_cast<itk::SizeValueType>(first.size_pixels.y);
    size[2] = stack.slices.size();
    image->SetRegions(ScanImage::RegionType(size));
    const glm::dvec3 normal = glm::cross(first.row_direction, first.column_direction);
    ScanImage::DirectionType direction;
    for (int axis = 0; axis < 3; ++axis) {
        const auto row = static_cast<unsigned>(axis);
        direction[row][0] = first.row_direction[axis];
        direction[row][1] = first.column_direction[axis];
        direction[row][2] = normal[axis];
    }
    image->SetDirection(direction);
    const std::array<double, 3> spacing{first.pixel_spacing_mm.x, first.pixel_spacing_mm.y, stack.spacing_mm};
    image->SetSpacing(spacing.data());
    const std::array<double, 3> origin{first.position_mm.x, first.position_mm.y, first.position_mm.z};
    image->SetOrigin(origin.data());
    image->Allocate();

    const std::size_t slice_pixels = size[0] * size[1];
    for (std::size_t i = 0; i < stack.slices.size(); ++i) {
        read_slice(stack.slices[i], image->GetBufferPointer() + i * slice_pixels);
        progress(static_cast<double>(i + 1) / static_cast<double>(stack.slices.size()));
    }
    return image;
}

}  // namespace osteomill
