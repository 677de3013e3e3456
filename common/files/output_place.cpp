#include "common/files/output_place.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "common/files/atomic_file.h"

namespace osteomill {

namespace {

namespace fs = std::filesystem;

/// Opens and locks; -1 and errno EWOULDBLOCK if another has it, -1 and another one if no lock can be made.
/// A process that ends removes the file that is locked: a lock of a file without a name is none.
int locked(const fs::path& file) {
    for (;;) {
        const int lock = ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
        if (lock < 0) return -1;
        const bool is_ours = ::flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        struct stat facts {};
        if (is_ours && ::fstat(lock, &facts) == 0 && facts.st_nlink > 0) return lock;
        ::close(lock);
        errno = EWOULDBLOCK;
        if (!is_ours) return -1;
    }
}

fs::path lock_file_of(const fs::path& target) {
    return folder_of(target) / ("." + target.filename().string() + ".lock");
}

/// The present path of a folder that was renamed, as the kernel knows it; nothing if it was removed.
std::optional<fs::path> moved_to(int folder) {
    struct stat facts {};
    if (folder < 0 || ::fstat(folder, &facts) != 0 || facts.st_nlink == 0) return std::nullopt;
    std::error_code failed;
    const fs::path path = fs::read_symlink(fmt::format("/proc/self/fd/{}", folder), failed);
    if (failed || !fs::is_directory(path, failed)) return std::nullopt;
    return path;
}

std::vector<fs::path> rescue_folders(const fs::path& gone) {
    std::vector<fs::path> folders{gone.parent_path() / (gone.filename().string() + ".rescued")};
    if (const char* const data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/')
        folders.push_back(fs::path(data) / "osteomill" / "rescued");
    if (const char* const home = std::getenv("HOME"); home != nullptr && *home == '/')
        folders.push_back(fs::path(home) / ".local" / "share" / "osteomill" / "rescued");
    return folders;
}

/// A path that nothing has yet, in the first of the folders that can be made and written.
std::optional<fs::path> rescue_place(const fs::path& target) {
    std::error_code failed;
    for (const fs::path& folder : rescue_folders(folder_of(target))) {
        fs::create_directories(folder, failed);
        if (failed || ::access(folder.c_str(), W_OK | X_OK) != 0) continue;
        fs::path place = folder / target.filename();
        for (int number = 2; fs::exists(fs::symlink_status(place, failed)); ++number)
            place.replace_filename(
                fmt::format("{}-{}{}", target.stem().string(), number, target.extension().string()));
        return place;
    }
    return std::nullopt;
}

}  // namespace

OutputPlace::OutputPlace(fs::path file) : file_(std::move(file)), target_(file_) {
    const WriteTarget target = write_target(file_, Link::follow);
    if (target.is_direct) return;
    std::error_code failed;
    target_ = fs::absolute(target.path, failed);
    lock_file_ = lock_file_of(target_);
    lock_ = locked(lock_file_);
    if (lock_ < 0)
        throw std::runtime_error(
            errno == EWOULDBLOCK
                ? fmt::format("{}: another session will write it; choose another name", file_.string())
                : fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(errno)));
    folder_ = ::open(folder_of(target_).c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
}

bool is_reserved(const fs::path& file) {
    const int lock = ::open(lock_file_of(file).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (lock < 0) return false;
    const bool is_held = ::flock(lock, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(lock);
    return is_held;
}

OutputPlace::~OutputPlace() {
    // Before it is unlocked: afterwards it may be another's.
    if (lock_ >= 0) ::unlinkat(folder_, lock_file_.filename().c_str(), 0);
    if (lock_ >= 0) ::close(lock_);
    if (folder_ >= 0) ::close(folder_);
}

fs::path OutputPlace::found() const {
    std::error_code failed;
    if (folder_ < 0) return file_;
    if (fs::is_directory(folder_of(target_), failed)) return file_;
    if (const auto folder = moved_to(folder_)) return *folder / target_.filename();
    if (!rescue_) rescue_ = rescue_place(target_);
    return rescue_.value_or(file_);
}

fs::path OutputPlace::now() const {
    const std::lock_guard lock(mutex_);
    return found();
}

std::string OutputPlace::news() {
    const std::lock_guard lock(mutex_);
    std::error_code failed;
    const bool is_there = folder_ < 0 || fs::is_directory(folder_of(target_), failed);
    if (std::exchange(was_there_, is_there) == is_there || is_there) return {};
    const fs::path place = found();
    if (place == file_)
        return fmt::format("{}: its folder is gone, and no other can be made: make {} again", file_.string(),
                           folder_of(target_).string());
    return fmt::format("{}: its folder is gone; it will be {}", file_.string(), place.string());
}

}  // namespace osteomill
