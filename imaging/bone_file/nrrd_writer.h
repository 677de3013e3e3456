// Writer of a NRRD as a stream, gzip inside: neither the voxels nor their compressed form are ever held as a
// whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "common/bone/grid.h"
#include "common/files/atomic_file.h"
#include "imaging/bone_file/digest.h"
#include "imaging/bone_file/gzip_writer.h"

namespace osteomill {

/// The form of NRRD in which bones are kept: one channel on an isotropic, axis-aligned grid in patient LPS,
/// the voxels behind the header in the same file. 3D Slicer opens it in the right place. NRRD is described at
/// http://teem.sourceforge.net/nrrd/format.html.
enum class NrrdVoxel { int16, uint8 };  ///< HU; fractions, stiffness codes and labels

inline std::uint64_t bytes_of(NrrdVoxel voxel) {
    return voxel == NrrdVoxel::int16 ? 2 : 1;
}

struct NrrdForm {
    NrrdVoxel voxel = NrrdVoxel::int16;
    Grid grid;
    /// NRRD's "byte skip": so many decoded bytes stand before the voxels, and readers pass over them.
    std::uint64_t bytes_before_voxels = 0;
    /// Values of a voxel, one after the other; over 1 as the first axis, as 3D Slicer layers a segmentation.
    int layers = 1;
    std::map<std::string, std::string> key_values{};  ///< "key:=value"
};

inline std::uint64_t voxel_count(const Grid& grid) {
    return static_cast<std::uint64_t>(grid.size_voxels.x) * static_cast<std::uint64_t>(grid.size_voxels.y) *
           static_cast<std::uint64_t>(grid.size_voxels.z);
}

inline std::uint64_t voxels_of_slice(const Grid& grid) {
    return static_cast<std::uint64_t>(grid.size_voxels.x) * static_cast<std::uint64_t>(grid.size_voxels.y);
}

/// A file that is not committed is deleted.
class NrrdWriter {
  public:
    /// Writes the header beside the target, and removes the leftovers of a killed writer. Throws
    /// std::invalid_argument for a bad grid, ImagingError for a name that does not end in .nrrd and if
    /// nothing can be written.
    NrrdWriter(const std::filesystem::path& path, const NrrdForm& form);
    /// The next bytes: first those before the voxels, then the voxels, of each all layers, x fastest, then y,
    /// then z, little endian. Throws std::runtime_error, with the reason, if they cannot be written.
    void add(std::span<const std::byte> bytes);

    /// Ends the file and switches to it at once; until then the old one is as it was. `key_values` take the
    /// place of those given at first (digests are known only now) and must be as long; where file_digest_key
    /// is among them, it gets the file's digest. Throws std::runtime_error; std::logic_error if the bytes
    /// added are not those that the header promises.
    void commit(const std::map<std::string, std::string>& key_values);

  private:
    NrrdForm form_;
    AtomicFile file_;
    std::optional<GzipWriter> gzip_{};
    std::uint64_t header_bytes_ = 0;
    std::uint64_t added_ = 0;
    Digest data_;  // as they stand in the file
};

}  // namespace osteomill
