// Description of a server and its scene, as a joining client gets it. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/session/operator_command.h"

namespace osteomill {

// The version of the protocol in proto/osteomill/v2. Another major version cannot be understood; a higher
// minor one says more than an older reader knows of.

inline constexpr std::uint32_t protocol_major = 2;
inline constexpr std::uint32_t protocol_minor = 3;

struct SessionInfo {
    std::uint32_t protocol_major = osteomill::protocol_major;
    std::uint32_t protocol_minor = osteomill::protocol_minor;
    std::string scene_name{};
    std::string server_version{};
    std::vector<Burr> burrs{};  ///< name, diameter, edges, spindle speed and sense; no cutting coefficients
    std::vector<Tissue> tissues{};
    bool accepts_operator = false;  ///< the server runs with --device client
    double force_limit_n = 0.0;
    double reach_mm = longest_reach_mm;  ///< from the burr to an operator's target, at most
    bool has_ct = false;                 ///< the server has a CT to display
    bool accepts_controls = false;       ///< the server takes a SessionControl
    bool records_view = false;           ///< the server takes a Viewpoint, for its recording
    bool holds_ticks = false;            ///< a recording: its states hold every tick of the haptic loop
    std::optional<Plan> plan{};
    PassMarks pass{};
    Rating rating{};
    std::vector<Fixture> fixtures{};  ///< without their springs and dampers
    std::string trainee{};
    std::string case_name{};
    std::map<std::string, std::string> settings{};  ///< as haptic_server --json names them
    std::string scene_toml{};  ///< the whole scene, which its reader checks; empty: not sent

    /// The burr of that number; null if the server has announced none.
    const Burr* burr_of(std::size_t number) const { return number < burrs.size() ? &burrs[number] : nullptr; }
};

}  // namespace osteomill
