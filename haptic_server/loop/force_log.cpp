#include "haptic_server/loop/force_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace osteomill {

namespace {

constexpr const char* header_line =
    "t_s,hand_x_mm,hand_y_mm,hand_z_mm,burr_x_mm,burr_y_mm,burr_z_mm,force_x_n,force_y_n,force_z_n,depth_mm,"
    "removed_mm3,spindle,fault\n";

}  // namespace

ForceLog::ForceLog(const std::filesystem::path& file)
    : path_(file), file_(std::fopen(file.c_str(), "w")), queue_(capacity) {
    if (!file_) {
        throw std::runtime_error(
            fmt::format("{}: cannot create the log: {}", file.string(), std::strerror(errno)));
    }
    if (std::fputs(header_line, file_.get()) < 0) fail();
}

void ForceLog::push(const ForceSample& sample) noexcept {
    if (!queue_.push(sample)) dropped_.fetch_add(1, std::memory_order_relaxed);
}

void ForceLog::drain() {
    fmt::memory_buffer text;
    queue_.consume_all([&text](const ForceSample& s) {
        fmt::format_to(
            std::back_inserter(text),
            "{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.4f},{:.5f},{:d},"
            "{:d}\n",
            s.time_s, s.hand_mm.x, s.hand_mm.y, s.hand_mm.z, s.burr_mm.x, s.burr_mm.y, s.burr_mm.z,
            s.force_n.x, s.force_n.y, s.force_n.z, s.depth_mm, s.removed_mm3, s.spindle_on ? 1 : 0,
            static_cast<int>(s.fault));
    });
    if (!file_) return;
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
}

void ForceLog::close() {
    drain();
    if (!file_) return;
    if (std::fflush(file_.get()) != 0) return fail();
    if (std::fclose(file_.release()) != 0) fail();
}

void ForceLog::fail() {
    error_ = fmt::format("{}: the log is not complete: {}", path_.string(), std::strerror(errno));
    file_.reset();
}

}  // namespace osteomill
