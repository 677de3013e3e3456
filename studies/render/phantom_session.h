// A session without a server: a phantom and the 5 mm burr, which goes round where the phantom's own
// trajectory starts (in the tooth's crown, on the head's vault), ever deeper, at 6 mm/s in steps of a
// thirtieth of a second.
#pragma once

#include <string>
#include <vector>

#include "common/bone/brick_change.h"
#include "render_client/link/session_source.h"

namespace osteomill {

/// The phantom as a server with its scene has it. Throws std::invalid_argument for an unknown name.
Bone phantom_bone(const std::string& phantom);

class PhantomSession final : public SessionSource {
  public:
    explicit PhantomSession(const std::string& phantom = "tooth");

    /// From the next poll on the burr moves and cuts; before, and after it was stopped, it rests.
    void mill(bool on) { mills_ = on; }
    /// The next poll brings the bone as it is now, as after a reconnection: for another picture of it.
    void begin_anew() { first_ = true; }
    /// Carves and reports it, all in one: not part of a client's work in a frame.
    void step();

    LinkUpdate poll() override;
    const Bone* bone() const override { return &bone_; }
    const SessionInfo* session() const override { return &info_; }

  private:
    Bone bone_;
    glm::dvec3 middle_mm_;  ///< round which the burr goes
    SessionInfo info_;
    ToolState tool_;
    bool mills_ = false;
    bool first_ = true;
    double way_mm_ = 0.0;
    std::vector<BrickChange> changes_;
};

}  // namespace osteomill
