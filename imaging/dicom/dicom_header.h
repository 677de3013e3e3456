// Header of one DICOM file, as far as it is about its image. GDCM stays behind this.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "imaging/dicom/dicom_scan.h"
#include "imaging/dicom/dicom_values.h"
#include "imaging/dicom/slice_geometry.h"

namespace osteomill {

struct DicomHeader {
    DicomScan scan{};
    std::string series_uid;
    std::string instance_uid;  ///< SOP Instance UID
    std::string series_description;
    std::string transfer_syntax;  ///< as text if GDCM knows them
    int rows = 0;                 ///< 0: no image (a report, a DICOMDIR)
    int columns = 0;
    int samples_per_pixel = 1;
    bool is_uncompressed = false;  ///< the pixels stand in the file as they are
    std::string no_grey_image;     ///< why it holds no CT numbers whatever its pixels, in words; or empty
    std::string
        not_of_the_scan;  ///< why it is left out where others are ("is a localizer"), in words; or empty
    DicomValues values{};
    /// Whether its JPEG 2000 codestream says that its pixels are signed, if the header says otherwise; GDCM
    /// would take the header's word and clamp.
    std::optional<bool> sign_of_codestream{};
    /// The placement of each frame; std::nullopt for a frame that the header does not place, see `fault`.
    std::vector<std::optional<SlicePlacement>> frames;
    double slice_gap_mm = 0.0;           ///< Spacing Between Slices; 0 if not stated
    double slice_thickness_mm = 0.0;     ///< 0 if not stated
    std::vector<DicomRescale> rescales;  ///< one a frame
    /// The assumptions about it and the doubts about its values, as texts that follow its name.
    std::vector<std::string> notes;
    std::string fault;  ///< why the frames make no volume, as text; empty if they may
};

/// std::nullopt if the file is not DICOM at all. Throws ImagingError if it cannot be opened, begins as
/// DICOM and then cannot be parsed (cut off), nests its sequences beyond reason, or has pixels that are not
/// there or cannot be decoded (dicom_scan.h).
std::optional<DicomHeader> read_dicom_header(const std::filesystem::path& path);

}  // namespace osteomill
