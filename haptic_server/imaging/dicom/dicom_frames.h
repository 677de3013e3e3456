// The pixels of one DICOM file, frame by frame, rescaled to HU. ITK and GDCM stay behind this.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "haptic_server/imaging/dicom/dicom_series.h"

namespace osteomill {

class DicomFrames {
  public:
    /// Nothing is decoded yet. Throws ImagingError for a file that cannot be opened.
    explicit DicomFrames(const DicomFile& file);
    ~DicomFrames();
    DicomFrames(DicomFrames&&) noexcept;
    DicomFrames& operator=(DicomFrames&&) noexcept;

    /// Columns x rows values, column fastest, with the file's own rescale slope and intercept applied. They
    /// may be changed, and are there until the next call. Any order of frames. Throws ImagingError where the
    /// pixels cannot be decoded or are not of the size that the header says.
    std::span<float> frame(unsigned index);

    /// What reading takes of memory at most: a frame, or the whole file where it is compressed as a whole.
    static std::uint64_t bytes_to_read(const DicomFile& file);

  private:
    class Source;
    class WholeFile;
    class FrameByFrame;
    std::unique_ptr<Source> source_;
};

}  // namespace osteomill
