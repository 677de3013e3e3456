// What the picture and the panels show of a session: plain data, whatever it comes from.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "render_client/volume/bone_colours.h"

namespace osteomill {

struct BurrView {
    std::string name;
    double diameter_mm = 5.0;
    int edges = 6;
    double spindle_rpm = 0.0;
    bool clockwise = true;
};

/// The tool in the newest frame; patient LPS.
struct ToolView {
    double time_s = 0.0;
    glm::dvec3 burr_position_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit, tip to shank
    glm::dvec3 hand_position_mm{0.0};
    std::size_t burr = 0;  ///< within SceneView::burrs
    bool spindle_on = false;
    glm::dvec3 force_n{0.0};  ///< on the hand
    double removed_mm3 = 0.0;
    bool touches_protected = false;
    std::string fault;  ///< empty while all is well
};

/// What the server says once, before the bone.
struct SceneView {
    std::string name;
    std::vector<BurrView> burrs;
    std::vector<TissueColour> tissues;
    bool accepts_operator = false;
    double force_limit_n = 0.0;
};

enum class SessionPhase {
    connecting,  ///< no server yet, or it was lost; another attempt follows by itself
    receiving,   ///< the bone is on its way
    live,
    finished,  ///< the server said goodbye; nothing more comes
    refused    ///< this server cannot be talked to, and trying again would not help
};

/// What changed since the last poll, and how the connection does.
struct SessionUpdate {
    SessionPhase phase = SessionPhase::connecting;
    std::string status_line;
    bool bone_replaced = false;
    std::vector<BrickIndex> dirty_bricks;
    double frames_per_s = 0.0;
    double kilobytes_per_s = 0.0;
    std::uint64_t checksum_mismatches = 0;
};

/// What an operator without an arm asks for.
struct OperatorIntentView {
    glm::dvec3 hand_target_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};
    bool pedal = false;
    std::size_t burr = 0;
};

/// Where sessions come from: a server, a recording, a test's script.
class SessionSource {
  public:
    virtual ~SessionSource() = default;
    /// Takes in what has arrived; never waits.
    virtual SessionUpdate poll() = 0;
    virtual const Bone* bone() const = 0;                ///< null until one has arrived
    virtual std::optional<SceneView> scene() const = 0;  ///< none until it has arrived
    virtual std::optional<ToolView> tool() const = 0;    ///< none until the first frame
    /// Without effect where the scene does not accept an operator.
    virtual void send(const OperatorIntentView& intent) = 0;
};

}  // namespace osteomill
