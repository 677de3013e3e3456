// DICOM series that a folder holds, and the one to take; slice_stack.h puts its slices in order.
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

/// The series requested of a folder (not of its subfolders), or else the largest; series of more than one
/// slice come before others, and CT before other modalities. `notes` gets a line about each series that is
/// passed over, and about each kind of file that is left out: one that is no DICOM, that holds no CT numbers
/// (segmentations, reports), that is no slice of a scan (a localizer, a secondary capture) while other files
/// may be, or that is a second copy of a slice. Throws ImagingError for a folder that is empty, holds no such
/// image or more than 65535 files; if there is no series of that UID, or it is left out, or is a single
/// slice, naming all series that there are; for a file that cannot be opened, and for a DICOM file that
/// read_dicom_header refuses.
DicomSeries choose_series(const std::filesystem::path& folder, const std::optional<std::string>& uid,
                          std::vector<std::string>& notes);

/// A single DICOM file as a series of its own. Throws ImagingError if it is not DICOM or has no image.
DicomSeries series_of_file(const std::filesystem::path& path);

/// The placement of every slice of the series; a multi-frame file states it in its functional groups. Throws
/// ImagingError for a file without pixel data, pixel spacing or position, with several samples a pixel (RGB),
/// without CT numbers, or with frames that cannot be placed.
std::vector<DicomSlice> slices_of(const DicomSeries& series);

}  // namespace osteomill
