#include "haptic_server/imaging/dicom/dicom_header.h"

#include <gdcmDataSet.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "haptic_server/imaging/dicom/dicom_pixels.h"
#include "haptic_server/imaging/dicom/quiet_libraries.h"
#include "haptic_server/imaging/formats/regular_file.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

using gdcm::DataSet;
using gdcm::Tag;

const Tag rows_tag(0x0028, 0x0010);
const Tag columns_tag(0x0028, 0x0011);
const Tag samples_tag(0x0028, 0x0002);
const Tag photometric_tag(0x0028, 0x0004);
const Tag frames_tag(0x0028, 0x0008);
const Tag spacing_tag(0x0028, 0x0030);
const Tag position_tag(0x0020, 0x0032);
const Tag orientation_tag(0x0020, 0x0037);
const Tag series_uid_tag(0x0020, 0x000e);
const Tag series_description_tag(0x0008, 0x103e);
const Tag pixel_data_tag(0x7fe0, 0x0010);
const Tag shared_groups_tag(0x5200, 0x9229);
const Tag per_frame_groups_tag(0x5200, 0x9230);
const Tag plane_position_tag(0x0020, 0x9113);
const Tag plane_orientation_tag(0x0020, 0x9116);
const Tag rescale_group_tag(0x0028, 0x9145);
const Tag intercept_tag(0x0028, 0x1052);
const Tag slope_tag(0x0028, 0x1053);
const Tag pixel_measures_tag(0x0028, 0x9110);

/// Everything before the pixels is in here, but in odd files.
constexpr std::uint64_t first_scanned_bytes = std::uint64_t{64} << 20U;
/// What is held of a file whose pixels are compressed, or stand before other things.
constexpr std::uint64_t most_scanned_bytes = std::uint64_t{1} << 30U;

/// An element's bytes as text, without padding; empty where absent.
std::string text_of(const DataSet& data, const Tag& tag) {
    if (!data.FindDataElement(tag)) return {};
    const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
    if (bytes == nullptr || bytes->GetPointer() == nullptr) return {};
    std::string text(bytes->GetPointer(), bytes->GetLength());
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
    return text;
}

/// An unsigned 16-bit number; GDCM hands its bytes over in the machine's order.
int number_of(const DataSet& data, const Tag& tag, int otherwise) {
    if (!data.FindDataElement(tag)) return otherwise;
    const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
    if (bytes == nullptr || bytes->GetLength() < 2) return otherwise;
    std::uint16_t number = 0;
    std::copy_n(bytes->GetPointer(), 2, reinterpret_cast<char*>(&number));
    return number;
}

/// "a\b\c" as exactly `count` numbers.
template <std::size_t count>
std::optional<std::array<double, count>> numbers_of(const DataSet& data, const Tag& tag) {
    std::istringstream text(text_of(data, tag));
    std::array<double, count> numbers{};
    for (double& number : numbers) {
        std::string part;
        if (!std::getline(text, part, '\\')) return std::nullopt;
        char* end = nullptr;
        number = std::strtod(part.c_str(), &end);
        if (end == part.c_str()) return std::nullopt;
    }
    return numbers;
}

/// The first item of a sequence, such as a functional group; null where there is none.
gdcm::SmartPointer<gdcm::SequenceOfItems> sequence_of(const DataSet& data, const Tag& tag) {
    if (!data.FindDataElement(tag)) return nullptr;
    return data.GetDataElement(tag).GetValueAsSQ();
}

/// Places that a value may stand in: the frame's own group, the one shared by all frames, the file itself.
struct Places {
    std::vector<const DataSet*> in;
    template <std::size_t count>
    std::optional<std::array<double, count>> find(const Tag& group, const Tag& tag) const {
        for (const DataSet* data : in) {
            if (const auto groups = sequence_of(*data, group); groups && groups->GetNumberOfItems() > 0)
                if (const auto found = numbers_of<count>(groups->GetItem(1).GetNestedDataSet(), tag))
                    return found;
            if (const auto found = numbers_of<count>(*data, tag)) return found;
        }
        return std::nullopt;
    }
};

std::optional<SlicePlacement> placement_of(const Places& places, const DicomHeader& header,
                                           std::string& missing) {
    const auto spacing = places.find<2>(pixel_measures_tag, spacing_tag);
    if (!spacing) missing = "Pixel Spacing (0028,0030)";
    const auto orientation = places.find<6>(plane_orientation_tag, orientation_tag);
    if (!orientation && missing.empty()) missing = "Image Orientation (0020,0037)";
    const auto position = places.find<3>(plane_position_tag, position_tag);
    if (!position && missing.empty()) missing = "Image Position (0020,0032)";
    if (!missing.empty()) return std::nullopt;
    return SlicePlacement{.name = {},
                          .position_mm = {(*position)[0], (*position)[1], (*position)[2]},
                          .along_row = {(*orientation)[0], (*orientation)[1], (*orientation)[2]},
                          .along_column = {(*orientation)[3], (*orientation)[4], (*orientation)[5]},
                          .column_pitch_mm = (*spacing)[1],
                          .row_pitch_mm = (*spacing)[0],
                          .columns = header.columns,
                          .rows = header.rows};
}

/// Frames of one file. Without a group per frame, several frames share one position and cannot be placed.
void place_frames(const DataSet& data, std::size_t count, DicomHeader& header) {
    const auto shared = sequence_of(data, shared_groups_tag);
    const auto per_frame = sequence_of(data, per_frame_groups_tag);
    if (count > 1 && (!per_frame || per_frame->GetNumberOfItems() != count)) {
        header.fault = "is multi-frame and does not say where each frame lies (5200,9230)";
        header.frames.assign(count, std::nullopt);
        return;
    }
    std::pair<std::optional<std::array<double, 1>>, std::optional<std::array<double, 1>>> first_rescale;
    for (std::size_t frame = 0; frame < count; ++frame) {
        Places places;
        if (per_frame && per_frame->GetNumberOfItems() == count)
            places.in.push_back(&per_frame->GetItem(frame + 1).GetNestedDataSet());
        if (shared && shared->GetNumberOfItems() > 0)
            places.in.push_back(&shared->GetItem(1).GetNestedDataSet());
        places.in.push_back(&data);
        std::string missing;
        header.frames.push_back(placement_of(places, header, missing));
        if (!missing.empty()) header.fault = "does not say how it lies in the patient: no " + missing;
        const auto slope = places.find<1>(rescale_group_tag, slope_tag);
        const auto intercept = places.find<1>(rescale_group_tag, intercept_tag);
        if (frame == 0) first_rescale = {slope, intercept};
        // GDCM applies one rescale to a whole file.
        if (first_rescale != std::pair(slope, intercept))
            header.fault =
                "is multi-frame with a rescale slope or intercept that changes from frame to frame";
    }
}

std::optional<DicomScan> scan_first(const RegularFile& file, std::uint64_t bytes) {
    std::optional<DicomScan> scan = scan_dicom(file.first_bytes(bytes), file.size());
    if (scan) require_sound_pixels(*scan);
    return scan;
}

/// What GDCM may be given the file for.
std::optional<DicomScan> scan_file(const std::filesystem::path& path) {
    const RegularFile file(path);
    if (!may_be_dicom(file.first_bytes(dicom_mark_bytes))) return std::nullopt;
    try {
        return scan_first(file, first_scanned_bytes);
    } catch (const std::invalid_argument& error) {
        if (file.size() <= first_scanned_bytes) throw ImagingError(path, error.what());
    }
    if (file.size() > most_scanned_bytes)
        throw ImagingError(
            path,
            "is DICOM of more than 1 GiB, and compressed or damaged; save the scan as one file "
            "a slice, or as NRRD");
    try {
        return scan_first(file, most_scanned_bytes);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(path, error.what());
    }
}

}  // namespace

std::optional<DicomHeader> read_dicom_header(const std::filesystem::path& path) {
    const std::optional<DicomScan> scan = scan_file(path);
    if (!scan) return std::nullopt;
    const QuietLibraries quiet;
    gdcm::Reader reader;
    reader.SetFileName(path.c_str());
    bool parsed = false;
    try {
        parsed = reader.CanRead() && reader.ReadUpToTag(pixel_data_tag, {pixel_data_tag});
    } catch (const std::exception&) {
        parsed = false;
    }
    if (!parsed) throw ImagingError(path, "is DICOM but cannot be parsed: cut off or damaged");
    const DataSet& data = reader.GetFile().GetDataSet();
    DicomHeader header;
    header.series_uid = text_of(data, series_uid_tag);
    header.series_description = text_of(data, series_description_tag);
    const gdcm::TransferSyntax syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
    if (const char* words = syntax.GetString()) header.transfer_syntax = words;
    header.rows = number_of(data, rows_tag, 0);
    header.columns = number_of(data, columns_tag, 0);
    header.samples_per_pixel = number_of(data, samples_tag, 1);
    header.has_pixel_data = scan->has_pixel_data;
    header.is_uncompressed = !scan->is_encapsulated && !syntax.IsEncapsulated() &&
                             syntax != gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian &&
                             text_of(data, photometric_tag) == "MONOCHROME2";
    const std::string frames = text_of(data, frames_tag);
    const long count = frames.empty() ? 1 : std::strtol(frames.c_str(), nullptr, 10);
    if (count < 1 || count > 65536)
        throw ImagingError(path, "Number of Frames (0028,0008) is '" + frames + "'");
    header.modality = scan->modality;
    header.no_grey_image = why_no_grey_image(*scan);
    if (scan->codestream && scan->codestream->is_signed && scan->pixel_representation &&
        *scan->codestream->is_signed != (*scan->pixel_representation == 1)) {
        header.wrong_sign_begin = scan->pixel_representation_begin;
        header.codestream_is_signed = *scan->codestream->is_signed;
    }
    place_frames(data, static_cast<std::size_t>(count), header);
    return header;
}

}  // namespace osteomill
