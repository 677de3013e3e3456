#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "devices/haply/haply_messages.h"
#include "tests/fuzz/targets.h"

namespace osteomill::fuzz {

void haply_state(Bytes input) {
    const std::string_view text{reinterpret_cast<const char*>(input.data()), input.size()};
    for (const std::string_view wanted : {"", "049D"}) {
        const std::optional<HaplyState> state = parse_haply_state(text, wanted);
        if (!state) continue;
        if (state->grip) {
            const double size = glm::length(state->grip->turn);
            require(std::abs(size - 1.0) < 1e-9, "a grip that is turned by no rotation");
        }
        if (!state->arm) continue;
        const HaplyInverse3& arm = *state->arm;
        require(wanted.empty() || arm.device_id == wanted, "an arm of another name");
        require(glm::length(arm.position_m) < 2.0 * farthest_m, "an arm that is nowhere");
        if (arm.velocity_m_per_s)
            require(std::isfinite(glm::length(*arm.velocity_m_per_s)), "an arm of no velocity");
        std::string force;
        write_haply_force(force, arm.device_id, {1.0, -2.0, 0.5}, HaplyForceField::vector);
        const auto read = nlohmann::json::parse(force, nullptr, false);
        require(read.is_object() && read["inverse3"][0]["device_id"] == arm.device_id,
                "a force that is no JSON");
    }
}

}  // namespace osteomill::fuzz
