// What one DICOM file's header says about its image. GDCM stays behind this.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "haptic_server/imaging/slice_geometry.h"

namespace osteomill {

struct DicomHeader {
    std::string series_uid;
    std::string series_description;
    std::string transfer_syntax;  ///< in words where GDCM knows them
    int rows = 0;                 ///< 0: no image (a report, a DICOMDIR)
    int columns = 0;
    int samples_per_pixel = 1;
    bool has_pixel_data = false;
    /// Where each frame lies; std::nullopt of a frame that the header does not place, see `fault`.
    std::vector<std::optional<SlicePlacement>> frames;
    std::string fault;  ///< why the frames make no volume, in words; empty where they may
};

/// std::nullopt where the file is not DICOM at all. Throws ImagingError where it begins as DICOM and then
/// cannot be parsed (cut off).
std::optional<DicomHeader> read_dicom_header(const std::filesystem::path& path);

}  // namespace osteomill
