// Place of a file that a session writes at its end: reserved for it from the start, and found again if its
// folder was moved or removed meanwhile.
//
// A file beside it, .NAME.lock, is locked (flock) and goes with this; the file that a killed program leaves
// blocks nobody.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

namespace osteomill {

class OutputPlace {
  public:
    /// Links are followed. Throws std::runtime_error in one line if another session has reserved it, and if
    /// nothing can be written there. A path that is no regular file (/dev/null, a pipe) is not reserved.
    explicit OutputPlace(std::filesystem::path file);
    ~OutputPlace();
    OutputPlace(const OutputPlace&) = delete;
    OutputPlace& operator=(const OutputPlace&) = delete;

    /// The path as requested.
    const std::filesystem::path& file() const { return file_; }
    /// The path to write to now: the requested one while its folder is there. If the folder was moved, the
    /// file goes to its new place; if it was removed, to FOLDER.rescued beside it or, failing that, to the
    /// user's data folder, which is made. Any thread.
    std::filesystem::path now() const;
    /// One line for people, once each time that the folder has gone. Any thread.
    std::string news();

  private:
    std::filesystem::path found() const;

    std::filesystem::path file_;
    std::filesystem::path target_;  ///< links followed
    std::filesystem::path lock_file_;
    int folder_ = -1;  ///< a descriptor of the target's folder, by which it is found again
    int lock_ = -1;
    mutable std::mutex mutex_;
    mutable std::optional<std::filesystem::path> rescue_;  ///< where it goes since its folder was removed
    bool was_there_ = true;                                ///< its folder, at the last check
};

/// Whether a program that runs now has reserved the file.
bool is_reserved(const std::filesystem::path& file);

}  // namespace osteomill
