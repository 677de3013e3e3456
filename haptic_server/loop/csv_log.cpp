#include "haptic_server/loop/csv_log.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace osteomill {

CsvFile::CsvFile(const std::filesystem::path& file, const std::string& header_line)
    : path_(file), file_(std::fopen(file.c_str(), "w")) {
    if (!file_) {
        throw std::runtime_error(
            fmt::format("{}: cannot create the log: {}", file.string(), std::strerror(errno)));
    }
    if (std::fputs(header_line.c_str(), file_.get()) < 0) fail();
}

void CsvFile::write(const fmt::memory_buffer& text) {
    if (!file_) return;
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
}

void CsvFile::close() {
    if (!file_) return;
    if (std::fflush(file_.get()) != 0) return fail();
    if (std::fclose(file_.release()) != 0) fail();
}

void CsvFile::fail() {
    error_ = fmt::format("{}: the log is not complete: {}", path_.string(), std::strerror(errno));
    file_.reset();
}

}  // namespace osteomill
