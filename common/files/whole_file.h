// A file that is either as it was or whole and new, whenever the program or the machine stops.
//
// The content is written to a part beside it (NAME.part.EXT, the extension kept since some libraries choose
// the format by it), synced to the disk, and renamed over the old file once. A full disk, an error or a kill
// leaves the old file untouched.
#pragma once

#include <filesystem>
#include <string_view>

namespace osteomill {

class WholeFile {
  public:
    /// Nothing is written or removed yet. A link is followed, so that what it points to is replaced. What is
    /// there and no regular file (/dev/null, a pipe) has no part: it is written directly.
    explicit WholeFile(const std::filesystem::path& path);
    /// Removes the part unless it was committed or kept.
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// Where to write, by whatever means; to be closed before commit().
    const std::filesystem::path& part() const { return part_; }
    /// As it was asked for.
    const std::filesystem::path& path() const { return path_; }

    /// Syncs the part and makes it the file. Throws std::runtime_error with one line that names the file and
    /// the reason; the old file is then as it was.
    void commit();
    /// The same without a sync, which takes a disk's time: for what may go with the machine but not with the
    /// program, such as a picture that is written between two drawn frames.
    void commit_unsynced();
    /// Leaves the part where it is, under its own name: an incomplete file that is worth something (a torn
    /// recording) although it must not take the old one's place.
    void keep_part() noexcept { owns_part_ = false; }

  private:
    std::filesystem::path path_;
    std::filesystem::path target_;  // links resolved
    std::filesystem::path part_;
    bool owns_part_ = true;
};

/// Where WholeFile writes before it is done: NAME.part.EXT beside `path`.
std::filesystem::path part_of(const std::filesystem::path& path);

/// Replaces the file by `text` as a whole. Throws std::runtime_error as WholeFile::commit does.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

}  // namespace osteomill
