// The borders of regions that virtual fixtures begin with, as translucent surfaces in the picture: bone hides
// them, and milling lays them open. They are computed beside the drawing thread.
#pragma once

#include <future>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/structure_mask.h"
#include "common/wire/session_info.h"
#include "render_client/volume/passes/stereo_picture.h"

namespace osteomill {

class FixtureBorders {
  public:
    /// Begins with those about a structure of the session.
    void take_in(const SessionInfo& session, const Structure& structure);
    /// Begins with those about tissues of which no structure was sent, which are where the bone bears their
    /// label; once, when all structures are there.
    void take_in_labels(const SessionInfo& session, const Bone& bone);
    /// Adds to the picture those that are ready, or waits for all of them; shows those that are in `on`.
    /// Returns whether the picture is another one now.
    bool show(StereoPicture& picture, FixtureSet on, bool waits);
    /// The picture has forgotten its structures.
    void forget();

  private:
    struct Border {
        std::size_t fixture;
        std::future<StructureSurface> surface;
        std::optional<std::size_t> shown_as{};  // number in the picture; none before it is ready
        bool is_shown = true;
    };
    void begin(const SessionInfo& session, std::size_t fixture, const StructureMask& structure);
    bool is_begun(std::size_t fixture) const;

    std::vector<Border> borders_;
    bool has_labels_ = false;
};

}  // namespace osteomill
