#include "common/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace osteomill {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view before_random = ".part-";
constexpr std::size_t random_digits = 8;
/// A script may start the one that reads a pipe a moment later.
constexpr std::chrono::seconds longest_wait_for_reader{2};

[[noreturn]] void fail(const fs::path& path, int reason) {
    throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(reason));
}

/// A path that is no regular file is held open to the end, so that no later opening of it waits. A pipe that
/// nobody reads would block for ever, and with it the signals that end a program.
int open_direct(const fs::path& path, const fs::path& named) {
    const auto until = std::chrono::steady_clock::now() + longest_wait_for_reader;
    int descriptor = -1;
    while ((descriptor = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)) < 0 && errno == ENXIO &&
           fs::is_fifo(path)) {
        if (std::chrono::steady_clock::now() > until)
            throw std::runtime_error(named.string() + ": is a pipe that no program reads");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (descriptor < 0) fail(named, errno);
    ::fcntl(descriptor, F_SETFL, 0);  // writing may wait
    return descriptor;
}

/// Closes its descriptor.
class Descriptor {
  public:
    Descriptor(const fs::path& path, int flags) : Descriptor(AT_FDCWD, path, flags) {}
    /// `path` within an opened folder.
    Descriptor(int folder, const fs::path& path, int flags)
        : number_(::openat(folder, path.c_str(), flags | O_CLOEXEC)) {}
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }

  private:
    int number_;
};

/// 0, or why not. Not every file system can sync a folder, and none that cannot would lose the rename.
int sync(int folder, const fs::path& path, int flags) {
    const Descriptor file(folder, path, flags);
    if (!file.is_open()) return errno;
    while (::fsync(file.number()) != 0) {
        if (errno == EINTR) continue;
        return errno == EINVAL ? 0 : errno;
    }
    return 0;
}

int opened_folder_of(const fs::path& path) {
    return ::open(folder_of(path).c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
}

}  // namespace

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path end_of_links(fs::path path) {
    constexpr int most_links = 40;  // as the system follows
    std::error_code failed;
    for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(path, failed)); ++i)
        path = path.parent_path() / fs::read_symlink(path, failed);
    return path;
}

std::string why_no_target(const fs::path& path) {
    std::error_code failed;
    if (!fs::is_symlink(fs::symlink_status(path, failed)) || fs::exists(fs::status(path, failed))) return {};
    return fmt::format("{}: is a link to {}, where nothing is; take the link away or give another name",
                       path.string(), end_of_links(path).string());
}

WriteTarget write_target(const fs::path& path, Link link) {
    WriteTarget target{.path = path};
    if (link == Link::replace) return target;
    if (const std::string why = why_no_target(path); !why.empty()) throw std::runtime_error(why);
    std::error_code ignored;  // a path that cannot be examined cannot be written either, and that is reported
    const fs::file_status status = fs::status(path, ignored);
    target.is_direct = fs::exists(status) && !fs::is_regular_file(status);
    if (!target.is_direct) target.path = end_of_links(path);
    return target;
}

int open_new(const fs::path& path) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

AtomicFile::AtomicFile(const fs::path& path, WriteTarget target, const fs::path& part)
    : path_(path), target_(std::move(target)), part_(part), owns_part_(!target_.is_direct) {
    if (target_.is_direct)
        descriptor_ = open_direct(target_.path, path_);
    else
        folder_ = opened_folder_of(target_.path);
}

AtomicFile::AtomicFile(const fs::path& path, Link link)
    : path_(path), target_(write_target(path, link)), part_(target_.path), owns_part_(!target_.is_direct) {
    if (target_.is_direct) {
        descriptor_ = open_direct(target_.path, path_);
        return;
    }
    folder_ = opened_folder_of(target_.path);
    std::random_device random;
    for (bool is_made = false; !is_made;) {
        part_.replace_filename(fmt::format("{}{}{:08x}{}", target_.path.stem().string(), before_random,
                                           random(), target_.path.extension().string()));
        descriptor_ = open_new(part_);
        if (descriptor_ < 0 && errno == EEXIST) continue;
        if (descriptor_ < 0) fail(path_, errno);
        // One that looks for abandoned parts may have come by before it was locked.
        struct stat facts {};
        is_made = (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
                  ::fstat(descriptor_, &facts) == 0 && facts.st_nlink > 0;
        if (!is_made) ::close(descriptor_);
    }
}

AtomicFile::~AtomicFile() {
    if (owns_part_) ::unlinkat(folder_, part_.filename().c_str(), 0);
    if (descriptor_ >= 0) ::close(descriptor_);
    if (folder_ >= 0) ::close(folder_);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    if (descriptor_ < 0) descriptor_ = ::openat(folder_, part_.filename().c_str(), O_WRONLY | O_CLOEXEC);
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(path_, errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AtomicFile::rewind() {
    if (::lseek(descriptor_, 0, SEEK_SET) != 0) fail(path_, errno);
}

void AtomicFile::commit() {
    if (!owns_part_) return;
    if (const int reason = sync(folder_, part_.filename(), O_RDONLY)) fail(path_, reason);
    commit_unsynced();
    if (const int reason = sync(folder_, ".", O_RDONLY | O_DIRECTORY)) fail(path_, reason);
}

void AtomicFile::commit_unsynced() {
    if (!owns_part_) return;
    if (::renameat(folder_, part_.filename().c_str(), folder_, target_.path.filename().c_str()) != 0)
        fail(path_, errno);
    owns_part_ = false;
}

void remove_abandoned_parts(const fs::path& path, Link link) {
    const fs::path target = write_target(path, link).path;
    const std::string begin = target.stem().string().append(before_random);
    const std::string end = target.extension().string();
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder_of(target), ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() != begin.size() + random_digits + end.size() || !name.starts_with(begin) ||
            !name.ends_with(end) ||
            name.find_first_not_of("0123456789abcdef", begin.size()) < begin.size() + random_digits)
            continue;
        const Descriptor part(entry.path(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
        if (part.is_open() && ::flock(part.number(), LOCK_EX | LOCK_NB) == 0)
            fs::remove(entry.path(), ignored);
    }
}

void write_atomic_file(const fs::path& path, std::string_view text, Link link) {
    AtomicFile file(path, link);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
}

}  // namespace osteomill
