// The four headers of images, whose readers are pure.
#include "imaging/dicom/dicom_pixels.h"
#include "imaging/formats/meta_image_header.h"
#include "imaging/formats/nifti_header.h"
#include "imaging/formats/nrrd_header.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"
#include "tests/fuzz/targets.h"

namespace osteomill::fuzz {

namespace {

constexpr std::uint64_t most_bytes_of_a_voxel = 8;

void require_one_line(const std::string& line) {
    require(!line.empty() && line.find('\n') == std::string::npos, "a complaint of several lines: " + line);
}

void require_complaint(const ImagingError& error) {
    require_one_line(error.what());
    require(std::string(error.what()).starts_with("fuzz: "), std::string("of no file: ") + error.what());
}

void require_names(const std::vector<std::string>& names) {
    for (const std::string& name : names)
        require(!name.empty() && name.size() <= most_nrrd_header_bytes, "a data file without a name");
}

}  // namespace

void nrrd_header(Bytes input) {
    try {
        const NrrdHeader header = parse_nrrd_header(input, "fuzz");
        require(header.bytes <= input.size(), "a header longer than its file");
        const ImageHeader layout = nrrd_image(header, "fuzz");
        require_plausible_geometry(layout.image);
        require(layout.layers >= 1 && layout.layers <= 255, "no layer, or too many");
        require(layout.voxel_bytes > 0 && layout.voxel_bytes <= 2 * most_bytes_of_a_voxel * most_voxels,
                "voxels without bytes, or too many");
        require(layout.byte_skip >= -1 && layout.line_skip <= most_nrrd_header_bytes, "a skip to nowhere");
        require(layout.data_files.empty() || layout.voxel_bytes % layout.data_files.size() == 0,
                "files that do not share the voxels");
        require_names(layout.data_files);
    } catch (const ImagingError& error) {
        require_complaint(error);
    }
}

void meta_image_header(Bytes input) {
    try {
        const ImageHeader header = parse_meta_image_header(input, "fuzz");
        require(header.bytes <= input.size(), "a header longer than its file");
        require_plausible_geometry(header.image);
        const auto files = header.data_files.size();
        require(files <= 1 || files == static_cast<std::size_t>(header.image.size_voxels.z),
                "files for other slices than there are");
        require(header.byte_skip >= -1 && bytes_of(header.voxels.type) <= most_bytes_of_a_voxel,
                "voxels that cannot be");
        require_names(header.data_files);
    } catch (const ImagingError& error) {
        require_complaint(error);
    }
}

void nifti_header(Bytes input) {
    try {
        const NiftiHeader header = parse_nifti_header(input, "fuzz");
        require_plausible_geometry(header.image);
        require(header.voxel_bytes > 0 && header.voxel_bytes <= most_bytes_of_a_voxel * most_voxels,
                "voxels without bytes, or too many");
        require(!header.voxels_follow || header.byte_skip >= 348, "voxels within the header");
    } catch (const ImagingError& error) {
        require_complaint(error);
    }
}

void dicom_header(Bytes input) {
    constexpr std::string_view deflated = "1.2.840.10008.1.2.1.99";
    try {
        const std::optional<DicomScan> scan = scan_dicom(input, input.size());
        require(may_be_dicom(input) || !scan, "DICOM that does not begin as such");
        if (!scan) return;
        require(scan->transfer_syntax == deflated || scan->pixel_bytes <= input.size(),
                "more pixel data than bytes");
        require_one_line("why: " + why_no_grey_image(*scan));
        require_sound_pixels(*scan);
        if (!scan->has_pixel_data || scan->rows.value_or(0) == 0 || scan->columns.value_or(0) == 0) return;
        require(scan->is_encapsulated ||
                    scan->pixel_bytes >= static_cast<std::uint64_t>(*scan->rows) *
                                             static_cast<std::uint64_t>(*scan->columns) *
                                             static_cast<std::uint64_t>(scan->samples_per_pixel.value_or(1)),
                "an image without its pixels");
    } catch (const std::invalid_argument& error) {
        require_one_line(ImagingError("fuzz", error.what()).what());
    }
}

}  // namespace osteomill::fuzz
