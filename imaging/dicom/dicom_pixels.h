// Check that the image that a DICOM file describes is one that can be decoded, and is of CT numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "imaging/dicom/dicom_precheck.h"

namespace osteomill {

/// Throws std::invalid_argument, with the reason, if the file has an image that cannot be decoded or that
/// does not hold its pixels: bits, frames or sizes that cannot be; fewer bytes of pixel data than the
/// header's size takes; a codestream of another size; compressed pixels that no codec shrinks so. Nothing for
/// a file without an image.
void require_sound_pixels(const DicomScan& scan);

/// Number of Frames (0028,0008), 1 if there is none. Throws std::invalid_argument unless it is
/// up to 65536.
std::size_t frame_count(const DicomScan& scan);

/// The fragments that hold each frame of compressed pixels, frame by frame; no list is empty. Throws
/// std::invalid_argument if neither their number, nor their table, nor the marks of their ends make that
/// clear.
std::vector<std::vector<std::size_t>> fragments_of_frames(const DicomScan& scan);

/// Whether an object is labels that are read: a segmentation (SEG), or one as a label map.
bool is_segmentation(const DicomScan& scan);
/// Whether its pixels are the numbers of segments.
bool is_label_map(const DicomScan& scan);

/// Why an object holds no CT numbers though it may have pixels ("is a segmentation (SEG)"); empty if it
/// may hold some.
std::string why_no_grey_image(const DicomScan& scan);

}  // namespace osteomill
