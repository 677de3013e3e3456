// A NRRD of the form in which bones are kept, opened to be read as a stream.
#pragma once

#include <memory>

#include "imaging/bone_file/nrrd_form.h"
#include "imaging/formats/byte_source.h"

namespace osteomill {

/// The bytes of a NRRD, decoded, from the first one behind its header; numbers as the machine has them.
class NrrdData {
  public:
    NrrdData(ByteSource source, bool swaps) : source_(std::move(source)), swaps_(swaps) {}

    void read_before_voxels(std::span<std::byte> bytes) { source_.read(bytes); }
    void skip(std::uint64_t bytes) { source_.skip(bytes); }
    void read_voxels(std::span<std::int16_t> voxels);
    void read_voxels(std::span<std::uint8_t> voxels) { source_.read(std::as_writable_bytes(voxels)); }
    /// After the last voxel: throws ImagingError where compressed data do not end there with a CRC that fits.
    void finish() { source_.finish(); }

  private:
    ByteSource source_;
    bool swaps_;
};

class NrrdFile {
  public:
    /// Reads the header; no voxel. Throws ImagingError, in one line, for a file that is missing, of another
    /// voxel type, without orientation, anisotropic, not aligned with patient LPS, or too short for what its
    /// header says; where it is an image of another kind the line says to run bone_import.
    NrrdFile(const std::filesystem::path& path, NrrdVoxel voxel);

    const std::filesystem::path& path() const { return file_->path(); }
    const NrrdForm& form() const { return form_; }
    /// From the beginning, each time, of the file that was opened, although another may have its name by now.
    NrrdData data() const;

  private:
    std::shared_ptr<const InputFile> file_;
    NrrdForm form_{};
    std::uint64_t data_offset_ = 0;
    Encoding encoding_ = Encoding::raw;
    bool swaps_ = false;
};

}  // namespace osteomill
