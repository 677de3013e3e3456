// Messages between a session and 3D Slicer. Out: the bone as an image, burr and patient as transforms,
// figures as text. In: marks, pauses and positions of the tool as text.
//
// Out, by name: IMAGE "Bone"; TRANSFORM "Burr" (origin: its centre; z: along the spindle, tip to shank) and
// "Patient" (the identity: all is in the patient's space); STRING "Session", a JSON object; STATUS
// "BurrStatus", the fault that keeps the force off. Transforms, text and status 10 times a second, also at
// rest. In: STRING "Mark" (a note), "Pause" ("1" or "0"), "Place" ("x y z" or "x y z ax ay az" in RAS, mm).
// The log says what the server refuses from this client.
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/log/rate_limit.h"
#include "common/session/structure_distance.h"
#include "common/session/tool_state.h"
#include "render_client/link/bone_link.h"
#include "slicer/reduced_bone.h"
#include "slicer/slicer_port.h"

namespace osteomill {

/// Schedule of an image's parts, for a receiver that drops messages silently.
///
/// OpenIGTLinkIF of 3D Slicer keeps only the newest message of a type and name between two imports, and
/// imports when its window has time. So a part covers all changes of the last 5 s, and is sent 5 times a
/// second at most. The whole is sent in the first 5 s, at rest, and every 10 s while something changes. A
/// receiver that imports every 3 s ends with the same image as one that imports each message.
class ImageSchedule {
  public:
    static constexpr double covered_s = 5.0;        ///< how far back a part reaches
    static constexpr double between_parts_s = 0.2;  ///< at least
    static constexpr double rests_after_s = 1.0;    ///< without a change
    static constexpr double between_wholes_s = 10.0;

    /// Somebody else receives, or the image is another one: the record of sent parts is cleared.
    void restart(const ReducedBox& whole);
    void changed(const ReducedBox& box, double now_s);

    /// The part to send now; nothing if none is due. It counts as sent. Times ascend.
    std::optional<ReducedBox> next(double now_s);

  private:
    struct Change {
        ReducedBox box;
        std::optional<double> first_sent_s{};
    };
    ReducedBox send_whole(double now_s);

    std::optional<ReducedBox> whole_{};  // nothing: there is no image yet
    std::optional<double> whole_sent_s_{};
    double begun_s_ = 0.0;  // the first whole was sent
    double last_sent_s_ = 0.0;
    double last_change_s_ = 0.0;
    bool has_changed_since_whole_ = false;
    std::deque<Change> changes_{};
};

/// The text "Session" as JSON; positions and force in RAS.
std::string session_text(const SessionInfo& session, const ToolState& tool, const SessionStatus& status,
                         const std::vector<StructureDistance>& distances);

/// The control that a STRING asks for; a place without an axis keeps `axis` (patient LPS). Throws
/// std::invalid_argument with one line that says what would be right.
SessionControl control_of(const std::string& name, const std::string& text, const glm::dvec3& axis);

class SlicerSession {
  public:
    static constexpr double between_transforms_s = 0.1;

    /// `link` outlives it. Throws as SlicerPort.
    SlicerSession(BoneLink& link, std::uint16_t port);

    std::uint16_t port() const { return port_.port(); }
    /// Reads the server's messages, then sends and receives for `time`.
    void run_for(std::chrono::milliseconds time);

  private:
    void take_in(double now_s);
    void send_what_is_due(double now_s);
    void obey(const std::string& name, const std::string& text);
    void begin_image();

    BoneLink& link_;
    std::string status_line_{};
    std::optional<ReducedBone> bone_{};
    std::optional<ToolState> tool_{};
    SessionStatus controls_{};
    std::vector<StructureDistance> distances_{};
    ImageSchedule schedule_{};
    double transforms_sent_s_ = -between_transforms_s;
    LimitedLog log_{};
    TokenBucket controls_taken_{5.0, 20.0};  // a second, and at once
    SlicerPort port_;
};

}  // namespace osteomill
