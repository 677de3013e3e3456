#include "common/files/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

std::runtime_error refusal(const std::filesystem::path& path, const std::string& why) {
    return std::runtime_error(printable(path.string()) + ": " + why);
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path, const InputKind& kind) : path_(path), kind_(kind) {
    const auto cannot = [&] {
        return refusal(path,
                       fmt::format("cannot be read: {}; it should be {}", std::strerror(errno), kind.what));
    };
    const auto no_file = [&] {
        return refusal(
            path,
            fmt::format("cannot be read: it is a folder, a pipe or a device; it should be {}", kind.what));
    };
    struct stat facts {};
    // First by name: to open a device may already do something.
    if (::stat(path.c_str(), &facts) != 0) throw cannot();
    if (!S_ISREG(facts.st_mode)) throw no_file();
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0) throw cannot();
    if (::fstat(descriptor_, &facts) != 0 || !S_ISREG(facts.st_mode)) {
        ::close(descriptor_);
        throw no_file();
    }
    size_ = static_cast<std::uint64_t>(facts.st_size);
    written_ = facts.st_mtim;
}

InputFile::~InputFile() {
    ::close(descriptor_);
}

bool InputFile::has_changed() const {
    struct stat facts {};
    if (::fstat(descriptor_, &facts) != 0) return true;
    return static_cast<std::uint64_t>(facts.st_size) != size_ || facts.st_mtim.tv_sec != written_.tv_sec ||
           facts.st_mtim.tv_nsec != written_.tv_nsec;
}

std::size_t InputFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count =
            ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw refusal(path_, std::string("cannot be read: ") + std::strerror(errno));
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

std::vector<std::uint8_t> InputFile::first_bytes(std::uint64_t most) const {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::min(most, size_)));
    bytes.resize(read_at(0, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

std::string InputFile::text() const {
    if (size_ > kind_.most_bytes)
        throw refusal(path_, fmt::format("has {} bytes, more than the {} that are read; it should be {}",
                                         size_, kind_.most_bytes, kind_.what));
    std::string text(static_cast<std::size_t>(size_), '\0');
    text.resize(read_at(0, std::as_writable_bytes(std::span(text))));
    return text;
}

std::string read_text(const std::filesystem::path& path, const InputKind& kind) {
    return InputFile(path, kind).text();
}

std::string read_secret(const std::filesystem::path& path, const InputKind& kind) {
    const InputFile file(path, kind);
    struct stat facts {};
    if (::fstat(file.descriptor(), &facts) != 0) throw refusal(path, "cannot be looked at");
    const mode_t allowed = facts.st_uid == 0 ? S_IRWXU | S_IRGRP : S_IRWXU;
    const mode_t mode = facts.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO);
    if ((mode & ~allowed) != 0)
        throw refusal(path,
                      fmt::format("is {} that others may read (its mode is {:o}); keep it to its owner: "
                                  "chmod 600 {}",
                                  kind.what, mode, printable(path.string())));
    return file.text();
}

}  // namespace osteomill
