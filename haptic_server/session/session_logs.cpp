#include "haptic_server/session/session_logs.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <stdexcept>

#include "common/files/session_file.h"

namespace osteomill {

namespace {

template <typename Log>
void begin_log(std::optional<Log>& log, const std::optional<std::filesystem::path>& file,
               const std::string& header_line) {
    if (!file) return;
    log.emplace(*file, header_line);
    if (log->torn()) spdlog::warn("{}", torn_line(*file, *log->torn()));
}

template <typename Log>
void close_log(std::optional<Log>& log) {
    if (!log) return;
    log->close();
    if (!log->error().empty()) throw std::runtime_error(log->error());
    if (log->dropped() > 0)
        throw std::runtime_error(fmt::format("{}: {} lines are missing: the disk could not keep up",
                                             log->path().string(), log->dropped()));
}

}  // namespace

SessionLogs::SessionLogs(const LogFiles& files, bool has_shank) {
    begin_log(force_, files.force, TickSample::header_line(has_shank));
    begin_log(milling_, files.milling, MillingSample::header_line());
}

void SessionLogs::close_force() {
    close_log(force_);
}

void SessionLogs::close_milling() {
    close_log(milling_);
}

}  // namespace osteomill
