// The pixels of one DICOM file, frame by frame, rescaled to HU. GDCM stays behind this.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "imaging/dicom/dicom_series.h"

namespace osteomill {

class DicomFrames {
  public:
    /// Nothing is decoded yet. Throws ImagingError for a file that cannot be opened.
    explicit DicomFrames(const DicomFile& file);
    ~DicomFrames();
    DicomFrames(DicomFrames&&) noexcept;
    DicomFrames& operator=(DicomFrames&&) noexcept;

    /// Columns x rows values, column fastest, in HU as the file itself says (DicomValues::hu); padding is not
    /// a number. They may be changed, and are there until the next call. Any order of frames. Throws
    /// ImagingError if the pixels cannot be decoded or are not of the size that the header says.
    std::span<float> frame(unsigned index);

    /// The most memory that reading takes: a frame, or the whole file if it is compressed as a whole.
    static std::uint64_t bytes_to_read(const DicomFile& file);

  private:
    class Source;
    class AtomicFile;
    class FrameByFrame;
    DicomFile file_;
    std::unique_ptr<Source> source_;
    std::vector<float> values_;
};

}  // namespace osteomill
