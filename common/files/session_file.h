// A file that is written during a whole session. Until the session ends the content is in a part beside it,
// NAME.part.EXT, which then becomes the file (atomic_file.h).
//
// The part's name is fixed, since the part of a killed session is worth keeping, above all a torn recording:
// the next session of that name moves it to NAME.torn-N.EXT. Two sessions cannot write the same file at once.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/files/atomic_file.h"

namespace osteomill {

class SessionFile {
  public:
    /// Makes an empty part. Throws std::runtime_error with one line if that cannot be, or another session is
    /// writing it.
    explicit SessionFile(const std::filesystem::path& path);
    /// Removes the part unless it was committed or kept.
    ~SessionFile();
    SessionFile(const SessionFile&) = delete;
    SessionFile& operator=(const SessionFile&) = delete;

    /// The path as requested.
    const std::filesystem::path& path() const { return file_->path(); }
    /// The path to write to, by whatever means; to be closed before commit(). A path that is no regular file
    /// (/dev/null, a pipe) is written directly.
    const std::filesystem::path& part() const { return file_->part(); }
    /// The present path of the part that a killed session left, if there was one.
    const std::optional<std::filesystem::path>& torn() const { return torn_; }

    /// These do the same as AtomicFile's.
    void commit() { file_->commit(); }
    void keep_part() noexcept { file_->keep_part(); }

  private:
    std::optional<AtomicFile> file_;  // from the moment that the part is this session's
    std::optional<std::filesystem::path> torn_;
    int lock_ = -1;  // a descriptor of the part, for as long as it is this session's; -1 where there is none
};

/// The path of a session's file before it is done: NAME.part.EXT beside `path`.
std::filesystem::path part_of(const std::filesystem::path& path);

/// One line for people about a part of `path` that was moved to `torn`.
std::string torn_line(const std::filesystem::path& path, const std::filesystem::path& torn);

}  // namespace osteomill
