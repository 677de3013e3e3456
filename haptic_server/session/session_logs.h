// The logs of a session's ticks and milling steps, as far as they are requested.
#pragma once

#include <filesystem>
#include <optional>

#include "analysis/logs/csv_log.h"

namespace osteomill {

struct LogFiles {
    std::optional<std::filesystem::path> force{};    ///< a line a tick
    std::optional<std::filesystem::path> milling{};  ///< a line a milling step
};

class SessionLogs {
  public:
    /// Begins the files. Throws std::runtime_error in one line if one cannot be.
    SessionLogs(const LogFiles& files, bool has_shank);

    /// Null if none is requested.
    ForceLog* force() { return force_ ? &*force_ : nullptr; }
    MillingLog* milling() { return milling_ ? &*milling_ : nullptr; }

    /// Once nothing is written any more. Throws std::runtime_error in one line where lines are missing.
    void close_force();
    void close_milling();

  private:
    std::optional<ForceLog> force_;
    std::optional<MillingLog> milling_;
};

}  // namespace osteomill
