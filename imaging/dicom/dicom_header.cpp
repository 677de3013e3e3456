#include "imaging/dicom/dicom_header.h"

#include <fmt/format.h>
#include <gdcmReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "common/files/input_file.h"
#include "imaging/dicom/data_set.h"
#include "imaging/dicom/dicom_pixels.h"
#include "imaging/dicom/quiet_libraries.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

using gdcm::DataSet;
using gdcm::Tag;

const Tag photometric_tag(0x0028, 0x0004);
const Tag spacing_tag(0x0028, 0x0030);
const Tag position_tag(0x0020, 0x0032);
const Tag orientation_tag(0x0020, 0x0037);
const Tag series_uid_tag(0x0020, 0x000e);
const Tag series_description_tag(0x0008, 0x103e);
const Tag pixel_data_tag(0x7fe0, 0x0010);
const Tag plane_position_tag(0x0020, 0x9113);
const Tag plane_orientation_tag(0x0020, 0x9116);
const Tag rescale_group_tag(0x0028, 0x9145);
const Tag intercept_tag(0x0028, 0x1052);
const Tag slope_tag(0x0028, 0x1053);
const Tag pixel_measures_tag(0x0028, 0x9110);
const Tag instance_uid_tag(0x0008, 0x0018);
const Tag image_type_tag(0x0008, 0x0008);
const Tag slice_thickness_tag(0x0018, 0x0050);
const Tag slice_spacing_tag(0x0018, 0x0088);
const Tag detector_spacing_tag(0x0018, 0x1164);
const Tag rescale_type_tag(0x0028, 0x1054);
const Tag padding_tag(0x0028, 0x0120);
const Tag padding_limit_tag(0x0028, 0x0121);
const Tag modality_lut_tag(0x0028, 0x3000);
const Tag lut_descriptor_tag(0x0028, 0x3002);
const Tag lut_data_tag(0x0028, 0x3006);
const Tag lut_type_tag(0x0028, 0x3004);

constexpr const char* deflated_syntax = "1.2.840.10008.1.2.1.99";

/// Everything before the pixels is in here, but in odd files.
constexpr std::uint64_t first_scanned_bytes = std::uint64_t{64} << 20U;
/// The most bytes held of a file whose pixels are compressed, or stand before other elements.
constexpr std::uint64_t most_scanned_bytes = std::uint64_t{1} << 30U;

void note(DicomHeader& header, const std::string& words) {
    if (std::find(header.notes.begin(), header.notes.end(), words) == header.notes.end())
        header.notes.push_back(words);
}

/// `is_alone`: it stands for all frames of the file, which lie one behind the other, and so it may lack a
/// position.
std::optional<SlicePlacement> placement_of(const Places& places, bool is_alone, DicomHeader& header,
                                           std::string& missing) {
    auto spacing = places.find<2>(pixel_measures_tag, spacing_tag);
    if (!spacing && (spacing = places.find<2>(pixel_measures_tag, detector_spacing_tag)))
        note(header, "has no Pixel Spacing (0028,0030); that of the detector (0018,1164) is taken");
    auto orientation = places.find<6>(plane_orientation_tag, orientation_tag);
    auto position = places.find<3>(plane_position_tag, position_tag);
    if (!position && is_alone) position = {0.0, 0.0, 0.0};
    if (!position && !orientation)
        missing = "Image Position and Orientation (0020,0032 and 0037)";
    else if (!spacing)
        missing = "Pixel Spacing (0028,0030)";
    else if (!position)
        missing = "Image Position (0020,0032)";
    if (!missing.empty()) return std::nullopt;
    if (!orientation) {
        note(header,
             "warning: has no Image Orientation (0020,0037); left and right are a guess (taken as of a "
             "patient who lies on the back, head first)");
        orientation = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0};
    }
    return SlicePlacement{.name = {},
                          .position_mm = {(*position)[0], (*position)[1], (*position)[2]},
                          .along_row = {(*orientation)[0], (*orientation)[1], (*orientation)[2]},
                          .along_column = {(*orientation)[3], (*orientation)[4], (*orientation)[5]},
                          .column_pitch_mm = (*spacing)[1],
                          .row_pitch_mm = (*spacing)[0],
                          .columns = header.columns,
                          .rows = header.rows};
}

/// The rescale from a frame's stored values to HU; adds a note if the file does not say that they are HU.
DicomRescale rescale_of(const Places& places, DicomHeader& header) {
    const auto slope = places.find<1>(rescale_group_tag, slope_tag);
    const auto intercept = places.find<1>(rescale_group_tag, intercept_tag);
    DicomRescale rescale{.slope = slope ? (*slope)[0] : 1.0, .intercept = intercept ? (*intercept)[0] : 0.0};
    if (!header.values.table && !slope && !intercept)
        note(header,
             "warning: says nothing of how its values become HU (no Rescale Slope and Intercept, 0028,1053 "
             "and 1052), as cone-beam scans without calibration do; they are taken for HU unless --rescale "
             "or --intensity-window says otherwise");
    if (!header.values.table && slope && !intercept)
        note(header,
             "warning: has a Rescale Slope and no Rescale Intercept (0028,1052); taken as 0, where a CT's is "
             "-1024 or near it");
    if (!std::isfinite(rescale.slope) || !std::isfinite(rescale.intercept))
        header.fault = fmt::format("has a Rescale Slope and Intercept (0028,1053 and 1052) of {} and {}",
                                   rescale.slope, rescale.intercept);
    if (rescale.slope == 0.0) {
        note(header,
             "warning: its Rescale Slope (0028,1053) is 0, which would make all values the same; taken as 1");
        rescale.slope = 1.0;
    }
    for (const DataSet* data : places.in) {
        const auto groups = sequence_of(*data, rescale_group_tag);
        const bool has_group = groups && groups->GetNumberOfItems() > 0;
        std::string type =
            text_of(has_group ? groups->GetItem(1).GetNestedDataSet() : *data, rescale_type_tag);
        if (type.empty() || type == "HU") continue;
        note(header, "warning: its Rescale Type (0028,1054) is '" + type.substr(0, 16) +
                         "', not HU; --rescale or --intensity-window makes HU of its values");
    }
    return rescale;
}

/// Signed or not, as the pixels are.
std::int64_t stored_number(std::uint16_t number, bool is_signed) {
    return is_signed ? std::int64_t{static_cast<std::int16_t>(number)} : std::int64_t{number};
}

DicomValues values_of(const DataSet& data, const DicomScan& scan, DicomHeader& header) {
    DicomValues values;
    const bool is_signed = scan.pixel_representation.value_or(0) == 1;
    if (const auto padding = number_of(data, padding_tag)) {
        const auto [low, high] =
            std::minmax({stored_number(*padding, is_signed),
                         stored_number(number_of(data, padding_limit_tag).value_or(*padding), is_signed)});
        values.padding = {.low = low, .high = high};
    }
    const auto tables = sequence_of(data, modality_lut_tag);
    if (!tables || tables->GetNumberOfItems() == 0) return values;
    const DataSet& lut = tables->GetItem(1).GetNestedDataSet();
    if (!lut.FindDataElement(lut_descriptor_tag) || !lut.FindDataElement(lut_data_tag)) return values;
    const gdcm::ByteValue* descriptor = lut.GetDataElement(lut_descriptor_tag).GetByteValue();
    const gdcm::ByteValue* entries = lut.GetDataElement(lut_data_tag).GetByteValue();
    if (descriptor == nullptr || entries == nullptr || descriptor->GetLength() < 6) return values;
    std::array<std::uint16_t, 3> numbers{};  // entries, the first stored value, bits of an entry
    std::copy_n(descriptor->GetPointer(), sizeof numbers, reinterpret_cast<char*>(numbers.data()));
    ModalityTable table{.first = stored_number(numbers[1], is_signed)};
    const std::size_t count = numbers[0] == 0 ? 65536 : numbers[0];
    const std::size_t bytes = entries->GetLength() >= 2 * count ? 2 : 1;
    if (entries->GetLength() < bytes * count) {
        header.fault = "has a Modality LUT (0028,3000) that is shorter than it says";
        return values;
    }
    for (std::size_t i = 0; i < count; ++i) {
        std::uint16_t entry = static_cast<std::uint8_t>(entries->GetPointer()[i]);
        if (bytes == 2) std::copy_n(entries->GetPointer() + 2 * i, 2, reinterpret_cast<char*>(&entry));
        table.meaning.push_back(static_cast<float>(entry));
    }
    if (const std::string type = text_of(lut, lut_type_tag); type != "HU")
        note(header, "warning: its Modality LUT (0028,3000) is of type '" + type.substr(0, 16) +
                         "', not HU; --rescale or --intensity-window makes HU of its values");
    values.table = std::move(table);
    return values;
}

/// Frames of a file without a group for each: one behind the other, as far apart as the file says.
void stack_frames(const Places& places, std::size_t count, DicomHeader& header) {
    header.frames.assign(count, std::nullopt);
    const bool is_thickness = header.slice_gap_mm == 0.0;
    const double gap_mm = is_thickness ? header.slice_thickness_mm : header.slice_gap_mm;
    std::string missing;
    if (!(gap_mm > 0.0)) missing = "Spacing Between Slices (0018,0088) and no Slice Thickness (0018,0050)";
    std::optional<SlicePlacement> first;
    if (missing.empty()) first = placement_of(places, true, header, missing);
    if (!first) {
        header.fault =
            "is multi-frame, does not say where each frame lies (5200,9230), and has no " + missing;
        return;
    }
    const glm::dvec3 normal = glm::cross(first->along_row, first->along_column);
    for (std::size_t frame = 0; frame < count; ++frame) {
        header.frames[frame] = first;
        header.frames[frame]->position_mm += static_cast<double>(frame) * gap_mm * normal;
    }
    note(header,
         fmt::format(
             "warning: is multi-frame and does not say where each frame lies; stacked {:g} mm apart ({}), "
             "the first lowest: above and below are a guess",
             gap_mm, is_thickness ? "Slice Thickness" : "Spacing Between Slices"));
}

void place_frames(const DataSet& data, std::size_t count, DicomHeader& header) {
    const FrameGroups groups(data);
    if (groups.count() != 0 && groups.count() != count)
        throw std::invalid_argument(fmt::format(
            "says that it has {} frames (0028,0008) and where {} lie (5200,9230)", count, groups.count()));
    const Places of_first = groups.of(0);
    if (const auto gap = of_first.find<1>(pixel_measures_tag, slice_spacing_tag))
        header.slice_gap_mm = std::abs((*gap)[0]);
    if (const auto thickness = of_first.find<1>(pixel_measures_tag, slice_thickness_tag))
        header.slice_thickness_mm = std::abs((*thickness)[0]);
    if (count > 1 && groups.count() == 0) stack_frames(of_first, count, header);
    for (std::size_t frame = 0; frame < count; ++frame) {
        const Places places = groups.of(frame);
        header.rescales.push_back(rescale_of(places, header));
        if (header.frames.size() == count) continue;
        std::string missing;
        header.frames.push_back(placement_of(places, false, header, missing));
        if (missing.empty()) continue;
        header.fault = "does not say how it lies in the patient: no " + missing;
        if (missing.starts_with("Image Position and")) header.not_of_the_scan = "does not lie in the patient";
    }
}

/// Objects whose values are no HU whatever their rescale says, but of the standard's CT (5.1.4.1.1.2).
void note_doubtful_kind(const DicomScan& scan, DicomHeader& header) {
    if (!scan.sop_class.empty() && !scan.sop_class.starts_with("1.2.840.10008."))
        note(header,
             "warning: is of a private kind (SOP Class " + scan.sop_class +
                 "); its values are taken for HU unless --rescale or --intensity-window says otherwise");
    if (scan.sop_class.starts_with("1.2.840.10008.5.1.4.1.1.13.1."))
        note(header,
             "warning: is a three-dimensional X-ray image (cone beam), whose grey values are not calibrated; "
             "they are "
             "taken for HU unless --rescale or --intensity-window says otherwise");
}

/// Why it is no slice of a scan, if there is one beside it.
std::string why_left_out(const DataSet& data, const DicomScan& scan, const DicomHeader& header) {
    const std::string type = text_of(data, image_type_tag);
    if (type.find("LOCALIZER") != std::string::npos) return "is a localizer (Image Type)";
    if (scan.sop_class.starts_with("1.2.840.10008.5.1.4.1.1.7")) return "is a secondary capture";
    if (header.samples_per_pixel != 1) return "is a picture in colour";
    return header.not_of_the_scan;
}

std::optional<DicomScan> scan_first(const InputFile& file, std::uint64_t bytes) {
    std::optional<DicomScan> scan = scan_dicom(file.first_bytes(bytes), file.size());
    // Labels of one bit beside a scan are sound, and read elsewhere.
    if (scan && why_no_grey_image(*scan).empty()) require_sound_pixels(*scan);
    return scan;
}

/// The scan that GDCM may safely be given; nullopt if the file is no DICOM. Throws ImagingError for a damaged
/// file.
std::optional<DicomScan> scan_file(const std::filesystem::path& path) {
    const InputFile file(path);
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
    return said_of(path, [&] { return scan_first(file, most_scanned_bytes); });
}

}  // namespace

std::optional<DicomHeader> read_dicom_header(const std::filesystem::path& path) try {
    const std::optional<DicomScan> scan = scan_file(path);
    if (!scan) return std::nullopt;
    if (const std::string& uid = scan->transfer_syntax;
        !uid.empty() && gdcm::TransferSyntax::GetTSType(uid.c_str()) == gdcm::TransferSyntax::TS_END)
        throw ImagingError(path,
                           fmt::format("is coded in transfer syntax {}, which GDCM does not read; save it "
                                       "uncompressed",
                                       printable(uid.substr(0, 64))));
    gdcm::Reader reader;
    reader.SetFileName(path.c_str());
    // GDCM does not find the tag to stop at in short deflated data, so deflated data are read whole.
    const bool is_deflated = scan->transfer_syntax == deflated_syntax;
    if (!quietly([&] {
            return reader.CanRead() &&
                   (is_deflated ? reader.Read() : reader.ReadUpToTag(pixel_data_tag, {pixel_data_tag}));
        }))
        throw ImagingError(path, "is DICOM but cannot be parsed: cut off or damaged");
    const DataSet& data = reader.GetFile().GetDataSet();
    DicomHeader header;
    header.scan = *scan;
    header.series_uid = text_of(data, series_uid_tag);
    header.series_description = text_of(data, series_description_tag);
    const gdcm::TransferSyntax syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
    if (const char* words = syntax.GetString()) header.transfer_syntax = words;
    header.rows = scan->rows.value_or(0);
    header.columns = scan->columns.value_or(0);
    header.samples_per_pixel = scan->samples_per_pixel.value_or(1);
    header.is_uncompressed = !scan->is_encapsulated && !syntax.IsEncapsulated() &&
                             syntax != gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian;
    const std::size_t count = frame_count(*scan);
    header.no_grey_image = why_no_grey_image(*scan);
    header.instance_uid = text_of(data, instance_uid_tag);
    const std::string photometric = text_of(data, photometric_tag);
    // GDCM ends the program over blanks and lists.
    if (data.FindDataElement(photometric_tag) && data.GetDataElement(photometric_tag).GetVL() > 0 &&
        (photometric.empty() || photometric.find('\\') != std::string::npos))
        throw ImagingError(path,
                           "Photometric Interpretation (0028,0004) is '" + photometric.substr(0, 40) + "'");
    if (is_segmentation(*scan)) place_frames(data, count, header);
    if (!header.no_grey_image.empty()) return header;
    if (header.samples_per_pixel == 1 && !photometric.empty() && !photometric.starts_with("MONOCHROME"))
        header.fault = "has pixels in colour (0028,0004 '" + photometric.substr(0, 16) + "')";
    header.values = values_of(data, *scan, header);
    if (scan->codestream && scan->codestream->is_signed && scan->pixel_representation &&
        *scan->codestream->is_signed != (*scan->pixel_representation == 1))
        header.sign_of_codestream = scan->codestream->is_signed;
    note_doubtful_kind(*scan, header);
    if (scan->has_bits_above)
        note(header,
             fmt::format("warning: some of its pixels have bits set above the {} that hold their values "
                         "(High Bit, 0028,0102); those are left out, so that metal brighter than these "
                         "hold would read as tissue or air",
                         *scan->high_bit + 1));
    place_frames(data, count, header);
    header.not_of_the_scan = why_left_out(data, *scan, header);
    return header;
} catch (const std::invalid_argument& error) {
    throw ImagingError(path, error.what());
}

}  // namespace osteomill
