#include "analysis/logs/csv_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace osteomill {

namespace {

/// A log hands on a queue of some thousand lines at a time; the buffer holds two of them.
constexpr std::size_t capacity_bytes = 8 * 1024 * 1024;

/// Closes it once it has a duplicate.
TextWriter writer_to(const SessionFile& file) {
    const int opened = ::open(file.part().c_str(), O_WRONLY | O_CLOEXEC);
    if (opened < 0)
        throw std::runtime_error(
            fmt::format("{}: cannot create the log: {}", file.path().string(), std::strerror(errno)));
    struct Close {
        int descriptor;
        ~Close() { ::close(descriptor); }
    } const close{opened};
    return TextWriter(opened, capacity_bytes);
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file, const std::string& header_line)
    : file_(file), writer_(writer_to(file_)) {
    writer_.push(header_line);
}

CsvFile::~CsvFile() {
    if (has_samples_ && !is_closed_) file_.keep_part();
}

void CsvFile::write(const fmt::memory_buffer& text) {
    if (is_closed_ || text.size() == 0) return;
    has_samples_ = true;
    if (!writer_.push({text.data(), text.size()})) fail("the disk could not keep up");
}

void CsvFile::close() {
    if (is_closed_) return;
    writer_.finish();
    if (writer_.has_failed()) fail(writer_.error());
    if (error_.empty()) {
        try {
            file_.commit();
        } catch (const std::runtime_error& error) {
            error_ = error.what() + where_it_lies();
        }
    }
    if (!error_.empty()) file_.keep_part();
    is_closed_ = true;
}

void CsvFile::fail(const std::string& why) {
    if (!error_.empty()) return;
    error_ = fmt::format("{}: the log is not complete: {}{}", file_.path().string(), why, where_it_lies());
}

std::string CsvFile::where_it_lies() const {
    if (file_.part() == file_.path()) return {};
    return fmt::format("; what there is lies in {}", file_.part().string());
}

}  // namespace osteomill
