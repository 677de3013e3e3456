// Checks by haptic_server --check of the things that a session would use: its port, its certificates, the
// disk for its recording.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "common/net/listen_address.h"
#include "common/net/tls_options.h"
#include "haptic_server/check/machine_check.h"

namespace osteomill {

struct CheckedSession {
    std::optional<ListenAddress> listen{};
    std::optional<TlsFiles> tls{};
    std::filesystem::path records_in = ".";  ///< the folder, which is there
    std::chrono::system_clock::time_point now = std::chrono::system_clock::now();
    /// Throws std::filesystem::filesystem_error if there is no such folder.
    std::function<std::uintmax_t(const std::filesystem::path&)> free_bytes =
        [](const std::filesystem::path& folder) { return std::filesystem::space(folder).available; };
};

/// The port by listening at it for a moment, the certificates as a session would read them, the disk.
std::vector<CheckRow> check_session(const CheckedSession& session);

}  // namespace osteomill
