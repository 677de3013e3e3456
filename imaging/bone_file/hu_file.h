// A bone file: CT numbers on the bone's own grid, as bone_import writes and haptic_server loads.
//
// Its header holds two digests: one of the CT numbers, and one of itself, which covers sizes, spacing, origin
// and all keys that begin with osteomill_. So one flipped bit is refused, even if gzip's CRC was made after
// it flipped. Files from elsewhere have no digests and are accepted as they are.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "imaging/bone_file/digest.h"
#include "imaging/bone_file/nrrd_writer.h"
#include "imaging/bone_from_hu.h"
#include "imaging/formats/byte_source.h"

namespace osteomill {

/// Key of the HU from which on a voxel of the file is bone.
inline constexpr const char* threshold_key = "osteomill_threshold_hu";
inline constexpr const char* hu_digest_key = "osteomill_hu_digest";
inline constexpr const char* header_digest_key = "osteomill_header_digest";

/// The bytes of a NRRD, decoded, from the first one behind its header; numbers as the machine has them.
class NrrdData {
  public:
    NrrdData(ByteSource source, bool swaps) : source_(std::move(source)), swaps_(swaps) {}

    void read_before_voxels(std::span<std::byte> bytes) { source_.read(bytes); }
    void skip(std::uint64_t bytes) { source_.skip(bytes); }
    void read_voxels(std::span<std::int16_t> voxels);
    /// After the last voxel: throws ImagingError if compressed data do not end there with a CRC that fits.
    void finish() { source_.finish(); }

  private:
    ByteSource source_;
    bool swaps_;
};

/// Opened: the header is read and held against its digest, the voxels are not.
class BoneFile {
  public:
    /// Throws ImagingError in one line for a file that is missing or too short for its header, and for
    /// anything but an int16 NRRD on an isotropic, axis-aligned LPS grid; if the image is merely of another
    /// form the line says to run bone_import.
    explicit BoneFile(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return file_->path(); }
    const Grid& grid() const { return form_.grid; }
    const NrrdForm& form() const { return form_; }
    const std::map<std::string, std::string>& key_values() const { return form_.key_values; }
    /// The value of threshold_key; absent if the file has none.
    const std::optional<double>& threshold_hu() const { return threshold_hu_; }
    /// Throws ImagingError, naming the key, if it is missing.
    const std::string& value(const char* key) const;

    /// Whether it was written to since it was opened.
    bool has_changed() const { return file_->has_changed(); }

    /// From the beginning, each time, of the file that was opened, although another may have its name by now.
    NrrdData data() const;

  private:
    std::shared_ptr<const InputFile> file_;
    NrrdForm form_{};
    std::uint64_t data_offset_ = 0;
    Encoding encoding_ = Encoding::raw;
    bool swaps_ = false;
    std::optional<double> threshold_hu_;
};

/// Throws ImagingError, "its WHAT damaged: digest ..., not the ... that was saved" (WHAT: "CT numbers are"),
/// if the file holds another digest under `key`; a file without that key has nothing to hold it against.
void require_digest(const BoneFile& file, const char* key, const Digest& digest, const std::string& what);

/// The CT numbers of a bone file, from the first slice on.
class HuReader {
  public:
    /// Skips the data before the voxels.
    explicit HuReader(const BoneFile& file);
    /// From `data`, which stands at the first voxel.
    HuReader(const BoneFile& file, NrrdData data);

    /// The next slices, as many as fit. With the last one, the data are checked against gzip's CRC and the
    /// digest. Throws ImagingError.
    void read(std::span<std::int16_t> hu);
    void read_to_end();
    /// The digest of the CT numbers read so far.
    std::string digest() const { return digest_.text(); }

  private:
    const BoneFile& file_;
    NrrdData data_;
    Digest digest_;
    std::uint64_t left_;  // voxels
};

/// The same, to build from. Both must outlive the result.
HuSlices slices_of(HuReader& reader, const BoneFile& file);

/// Writes a bone file as a stream, with its digests; see NrrdWriter for the form and the exceptions.
class BoneFileWriter {
  public:
    BoneFileWriter(const std::filesystem::path& path, const Grid& grid,
                   std::map<std::string, std::string> key_values, std::uint64_t bytes_before_voxels = 0);

    void add_before_voxels(std::span<const std::byte> bytes) { writer_->add(bytes); }
    void add(std::span<const std::int16_t> hu);
    void commit();

  private:
    NrrdForm form_;
    Digest hu_digest_;
    std::optional<NrrdWriter> writer_;
};

/// "300" for 300.0: how a threshold is written under threshold_key.
std::string threshold_text(double threshold_hu);

}  // namespace osteomill
