#include "common/files/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

namespace osteomill {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int reason) {
    throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(reason));
}

/// Closes its descriptor.
class Descriptor {
  public:
    Descriptor(const fs::path& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
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

fs::path part_of(const fs::path& path) {
    fs::path part = path;
    part.replace_filename(path.stem().string() + ".part" + path.extension().string());
    return part;
}

WholeFile::WholeFile(const fs::path& path) : path_(path), target_(path) {
    std::error_code ignored;  // what cannot be looked at cannot be written either, which is told then
    if (fs::is_symlink(path, ignored)) {
        const fs::path resolved = fs::weakly_canonical(path, ignored);
        if (!ignored) target_ = resolved;
    }
    const fs::file_status status = fs::status(target_, ignored);
    const bool is_other = fs::exists(status) && !fs::is_regular_file(status);
    part_ = is_other ? target_ : part_of(target_);
    owns_part_ = !is_other;
}

WholeFile::~WholeFile() {
    std::error_code ignored;
    if (owns_part_) fs::remove(part_, ignored);
}

void WholeFile::commit() {
    if (!owns_part_) return;
    if (const int reason = sync(part_, O_RDONLY)) fail(path_, reason);
    commit_unsynced();
    if (const int reason = sync(folder_of(target_), O_RDONLY | O_DIRECTORY)) fail(path_, reason);
}

void WholeFile::commit_unsynced() {
    if (!owns_part_) return;
    std::error_code failed;
    fs::rename(part_, target_, failed);
    if (failed) fail(path_, failed.value());
    owns_part_ = false;
}

void write_whole_file(const fs::path& path, std::string_view text) {
    WholeFile file(path);
    {
        const Descriptor part(file.part(), O_WRONLY | O_CREAT | O_TRUNC);
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
