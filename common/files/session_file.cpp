#include "common/files/session_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

namespace osteomill {

namespace {

namespace fs = std::filesystem;

/// NAME.torn-N.EXT for the part NAME.part.EXT, of the lowest N that is free.
fs::path free_torn_name(const fs::path& part) {
    const fs::path name = part.stem().stem();
    for (int number = 1;; ++number) {
        fs::path torn = part;
        torn.replace_filename(name.string() + ".torn-" + std::to_string(number) + part.extension().string());
        if (!fs::exists(fs::symlink_status(torn))) return torn;
    }
}

[[noreturn]] void cannot_begin(const fs::path& path, int reason) {
    throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(reason));
}

}  // namespace

SessionFile::SessionFile(const fs::path& path) {
    const WriteTarget target = write_target(path, Link::follow);
    const fs::path part = target.is_direct ? target.path : part_of(target.path);
    while (!target.is_direct && lock_ < 0) {
        lock_ = open_new(part);
        if (lock_ >= 0) break;
        if (errno != EEXIST) cannot_begin(path, errno);
        const int left = ::open(part.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        const bool is_locked = left >= 0 && ::flock(left, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (left >= 0) ::close(left);
        if (is_locked)
            throw std::runtime_error(part.string() + ": another session is writing it; choose another name");
        torn_ = free_torn_name(part);
        std::error_code failed;
        fs::rename(part, *torn_, failed);
        if (failed) cannot_begin(part, failed.value());
    }
    if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
    file_.emplace(path, target, part);
}

fs::path part_of(const fs::path& path) {
    fs::path part = path;
    part.replace_filename(path.stem().string() + ".part" + path.extension().string());
    return part;
}

std::string torn_line(const fs::path& path, const fs::path& torn) {
    return path.string() + ": an earlier session of this name was killed; what it left is now " +
           torn.string();
}

SessionFile::~SessionFile() {
    if (lock_ >= 0) ::close(lock_);
}

}  // namespace osteomill
