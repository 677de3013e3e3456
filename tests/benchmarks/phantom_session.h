// A session without a server: the tooth phantom, 512 x 512 x 128 voxels, and the 5 mm burr, which goes round
// within the crown as deep as it is told to, at 6 mm/s in steps of a thirtieth of a second.
#pragma once

#include <vector>

#include "common/bone/brick_change.h"
#include "render_client/ui/session_source.h"

namespace osteomill {

/// The phantom as a server with its default scene has it.
Bone tooth_phantom_bone();

class PhantomSession final : public SessionSource {
  public:
    PhantomSession();

    /// From the next poll on the burr moves and cuts; before, and after it was stopped, it rests.
    void mill(bool on) { mills_ = on; }
    /// Carves and tells of it, all in one: not part of what a client does in a frame.
    void step();

    LinkUpdate poll() override;
    const Bone* bone() const override { return &bone_; }
    const SessionInfo* session() const override { return &info_; }
    void send_operator(const OperatorCommand&) override {}

  private:
    Bone bone_;
    SessionInfo info_;
    ToolState tool_;
    bool mills_ = false;
    bool first_ = true;
    double way_mm_ = 0.0;
    std::vector<BrickChange> changes_;
};

}  // namespace osteomill
