#include "analysis/report/start_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace osteomill {

namespace {

/// Settings of the session (session_settings.h) that are felt. The burr at the start is not one of them: a
/// trainee changes it.
constexpr std::array<std::string_view, 8> felt{"coupling", "device",          "force_model", "force_scale",
                                               "grip",     "milling_rate_hz", "rpm",         "vibration"};

/// Sums do not depend on which empty bricks are stored.
std::uint64_t sum_of(const BoneContent& content, const std::vector<ByteBrick>& bricks) {
    std::uint64_t sum = 0;
    for (std::size_t slot = 0; slot < bricks.size(); ++slot)
        sum += checksum_of_brick(content.brick_of_slot[slot], bricks[slot]);
    return sum;
}

}  // namespace

std::map<std::string, std::string> felt_settings(const std::map<std::string, std::string>& settings) {
    std::map<std::string, std::string> some;
    for (const auto& [name, value] : settings) {
        const bool is_off = value.empty() || value == "none" || value == "false" || value == "0";
        if (std::ranges::find(felt, name) != felt.end() && !is_off) some.emplace(name, value);
    }
    return some;
}

StartConditions start_conditions(const SessionTrace& trace) {
    const BoneContent& content = trace.at_start.content();
    return {.bone = fmt::format("{:016x}{:016x}{:016x}", checksum(trace.at_start),
                                sum_of(content, content.tissue), sum_of(content, content.stiffness)),
            .settings = felt_settings(trace.session.settings)};
}

}  // namespace osteomill
