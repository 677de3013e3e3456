// A file named by a user, opened for reading: a regular file and nothing else.
//
// A pipe, a device or a folder is refused before it is opened, so that opening never waits and reading always
// ends. Reading a whole file has a size limit by its kind, which bounds the memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace osteomill {

/// The kind that a file should be, for messages ("a trajectory in CSV"), and its most bytes.
struct InputKind {
    const char* what = "a file";
    std::uint64_t most_bytes = UINT64_MAX;
};

// Files that are read whole. A trajectory of an hour at 1 kHz has 250 MB.
inline constexpr InputKind trajectory_kind{"a trajectory in CSV", 256U << 20U};
inline constexpr InputKind controls_kind{"a script of controls in CSV", 16U << 20U};
inline constexpr InputKind table_kind{"a table in CSV", 64U << 20U};
inline constexpr InputKind json_kind{"a JSON file", 256U << 20U};
inline constexpr InputKind operators_kind{"a list of the subjects of certificates", 1U << 20U};
inline constexpr InputKind private_key_kind{"a private key", 1U << 20U};
inline constexpr InputKind pem_kind{"a PEM file", 1U << 20U};
/// Enough for a hundred thousand certificates.
inline constexpr InputKind revoked_kind{"a list of revoked certificates", 16U << 20U};
inline constexpr InputKind bridge_key_kind{"a key of the bridge", 4095};

class InputFile {
  public:
    /// Follows links. It stays the one that was opened, although another takes its name. Throws
    /// std::runtime_error, "PATH: cannot be read: ...", for a path that does not exist, cannot be opened, or
    /// is no regular file.
    explicit InputFile(const std::filesystem::path& path, const InputKind& kind = {});
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    int descriptor() const { return descriptor_; }
    /// Bytes, when it was opened.
    std::uint64_t size() const { return size_; }

    /// Whether its size or its time of writing is another than when it was opened.
    bool has_changed() const;

    /// Reads into `bytes` from an offset; how many there were, fewer only at the file's end. Throws
    /// std::runtime_error if the disk fails.
    std::size_t read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
    /// Its first bytes, at most so many.
    std::vector<std::uint8_t> first_bytes(std::uint64_t most) const;
    /// All of it. Throws std::runtime_error if there are more bytes than its kind may have.
    std::string text() const;

  private:
    std::filesystem::path path_;
    InputKind kind_;
    int descriptor_ = -1;
    timespec written_{};
    std::uint64_t size_ = 0;
};

/// Throws as InputFile does.
std::string read_text(const std::filesystem::path& path, const InputKind& kind);

/// The same of a secret, which is its owner's alone; a key of root's may also be read by its group, as
/// distributions keep those of services (root:ssl-cert, 0640). Throws also if others may read or write it.
std::string read_secret(const std::filesystem::path& path, const InputKind& kind);

}  // namespace osteomill
