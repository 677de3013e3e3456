// DICOM series that a folder holds, and the one to take.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "imaging/dicom/dicom_header.h"

namespace osteomill {

/// One slice's place, and where its pixels are.
struct DicomSlice {
    SlicePlacement placement;
    std::filesystem::path file;
    unsigned frame = 0;  ///< within the file
};

struct DicomFile {
    std::filesystem::path path;
    DicomHeader header;
};

struct DicomSeries {
    std::string uid;
    std::string description;
    std::vector<DicomFile> files;  ///< sorted by name
    std::size_t slices = 0;        ///< frames of all files
};

/// The series requested of a folder (not of the folders in it), or else the largest: of more than one slice,
/// of CT, before others. `notes` gets a line about each that is passed over, and about each kind of file that
/// is left out: what is no DICOM, holds no CT numbers (segmentations, reports), is no slice of a scan (a
/// localizer, a secondary capture) beside what may be, or is a second copy of a slice. Throws ImagingError
/// for a folder that is empty, holds no such image or more than 65535 files; where there is no series of that
/// UID, or it is left out, or is a single slice, with all that there is; for a file that cannot be opened,
/// and for a DICOM file that read_dicom_header refuses.
DicomSeries choose_series(const std::filesystem::path& folder, const std::optional<std::string>& uid,
                          std::vector<std::string>& notes);

/// A single DICOM file as a series of its own. Throws ImagingError where it is not DICOM or has no image.
DicomSeries series_of_file(const std::filesystem::path& path);

/// Where every slice of the series lies: of multi-frame files from their functional groups. Throws
/// ImagingError for a file without pixel data, pixel spacing or position, with several samples a pixel
/// (RGB), that holds no CT numbers, or whose frames cannot be placed.
std::vector<DicomSlice> slices_of(const DicomSeries& series);

}  // namespace osteomill
