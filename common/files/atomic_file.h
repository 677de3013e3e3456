// A file that is replaced as a whole: after a stop of the program or the machine it is either old or new.
//
// The content is written to a part beside it with an unpredictable name (NAME.part-1f2e3d4c.EXT; the
// extension is kept since some libraries choose the format by it), synced to the disk, and renamed over the
// old file. A full disk, an error or a kill leaves the old file untouched. The part is created anew and never
// through a link, so no existing file of the folder is written to. While it is written it is locked (flock),
// which distinguishes it from the part of a killed program.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace osteomill {

/// How a link under the file's own name is treated.
enum class Link {
    follow,  ///< for a name that a user gave: the target of the link is replaced, if there is one
    replace  ///< for a name that this program chose, in a folder that may be from elsewhere: the link is
             ///< replaced
};

/// The folder of a file: "." if its path names none.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// The path that a link here finally leads to, even if nothing is there yet.
std::filesystem::path end_of_links(std::filesystem::path path);

/// The place where a file's content shall finally lie.
struct WriteTarget {
    std::filesystem::path path;  ///< links resolved, where they are followed
    bool is_direct = false;      ///< no regular file (/dev/null, a pipe): written itself, without a part
};
/// Throws std::runtime_error, as why_no_target says, for a link to follow that leads to nothing.
WriteTarget write_target(const std::filesystem::path& path, Link link);

/// One line for a link that leads to nothing: it may be old, or somebody else's, and nobody asked for a file
/// at its target. Empty for all other paths.
std::string why_no_target(const std::filesystem::path& path);

class AtomicFile {
  public:
    /// Makes an empty part. Throws std::runtime_error with one line if that cannot be, and for a pipe that no
    /// program reads.
    explicit AtomicFile(const std::filesystem::path& path, Link link = Link::follow);
    /// Takes over a part that is there.
    AtomicFile(const std::filesystem::path& path, WriteTarget target, const std::filesystem::path& part);
    /// Removes the part unless it was committed or kept.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// The path to write to, by whatever means; to be closed before commit().
    const std::filesystem::path& part() const { return part_; }
    /// The path as requested.
    const std::filesystem::path& path() const { return path_; }
    /// Writes behind earlier data written so, or over it from the beginning on. Throw std::runtime_error with
    /// one line that names the file and the reason.
    void write(std::span<const std::byte> bytes);
    void rewind();

    /// Syncs the part and makes it the file, also in a folder that has another name by now. Throws
    /// std::runtime_error with one line that names the file and the reason; the old file is then as it was.
    void commit();
    /// The same without a sync, which waits for the disk: for files that may be lost with the machine but not
    /// with the program, such as a picture written between two frames.
    void commit_unsynced();
    /// Leaves the part where it is, under its own name: an incomplete file that is still useful (a torn
    /// recording) but must not replace the old one.
    void keep_part() noexcept { owns_part_ = false; }

  private:
    std::filesystem::path path_;
    WriteTarget target_;
    std::filesystem::path part_;
    bool owns_part_;
    int folder_ = -1;      // holds the part and the target: it may get another name while the part is written
    int descriptor_ = -1;  // the locked part, if this object made it; else the file that is written directly
};

/// Removes parts of this file that killed programs left behind: parts of the name above that are not locked.
/// Parts that cannot be removed stay.
void remove_abandoned_parts(const std::filesystem::path& path, Link link = Link::follow);

/// Replaces the file by `text` as a whole. Throws std::runtime_error as AtomicFile does.
void write_atomic_file(const std::filesystem::path& path, std::string_view text, Link link = Link::follow);

/// Opens a file to write whose name nothing has yet; -1 and errno if that cannot be, EEXIST for whatever is
/// there, a link, too.
int open_new(const std::filesystem::path& path);

}  // namespace osteomill
