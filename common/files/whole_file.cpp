#include "common/files/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace osteomill {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int reason) {
    throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(reason));
}

/// Closes its descriptor.
class Descriptor {
  public:
    Descriptor(const fs::path& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC)) {}
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
int sync(const fs::path& path, int flags) {
    const Descriptor file(path, flags);
    if (!file.is_open()) return errno;
    while (::fsync(file.number()) != 0) {
        if (errno == EINTR) continue;
        return errno == EINVAL ? 0 : errno;
    }
    return 0;
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

WriteTarget write_target(const fs::path& path, Link link) {
    WriteTarget target{.path = path};
    if (link == Link::replace) return target;
    std::error_code ignored;  // what cannot be looked at cannot be written either, which is told then
    if (fs::is_symlink(path, ignored)) {
        const fs::path resolved = fs::weakly_canonical(path, ignored);
        if (!ignored) target.path = resolved;
    }
    const fs::file_status status = fs::status(target.path, ignored);
    target.is_direct = fs::exists(status) && !fs::is_regular_file(status);
    return target;
}

int open_new(const fs::path& path) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

WholeFile::WholeFile(const fs::path& path, WriteTarget target, const fs::path& part)
    : path_(path), target_(std::move(target)), part_(part), owns_part_(!target_.is_direct) {}

WholeFile::WholeFile(const fs::path& path, Link link)
    : path_(path), target_(write_target(path, link)), part_(target_.path), owns_part_(!target_.is_direct) {
    if (target_.is_direct) return;
    std::random_device random;
    int made = -1;
    do {
        part_.replace_filename(fmt::format("{}.part-{:08x}{}", target_.path.stem().string(), random(),
                                           target_.path.extension().string()));
        made = open_new(part_);
    } while (made < 0 && errno == EEXIST);
    if (made < 0) fail(path_, errno);
    ::close(made);
}

WholeFile::~WholeFile() {
    std::error_code ignored;
    if (owns_part_) fs::remove(part_, ignored);
}

void WholeFile::commit() {
    if (!owns_part_) return;
    if (const int reason = sync(part_, O_RDONLY)) fail(path_, reason);
    commit_unsynced();
    if (const int reason = sync(folder_of(target_.path), O_RDONLY | O_DIRECTORY)) fail(path_, reason);
}

void WholeFile::commit_unsynced() {
    if (!owns_part_) return;
    std::error_code failed;
    fs::rename(part_, target_.path, failed);
    if (failed) fail(path_, failed.value());
    owns_part_ = false;
}

void write_whole_file(const fs::path& path, std::string_view text, Link link) {
    WholeFile file(path, link);
    {
        const Descriptor part(file.part(), O_WRONLY | O_TRUNC);
        if (!part.is_open()) fail(path, errno);
        while (!text.empty()) {
            const ssize_t written = ::write(part.number(), text.data(), text.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail(path, errno);
            text.remove_prefix(static_cast<std::size_t>(written));
        }
    }
    file.commit();
}

}  // namespace osteomill
