// Shanks of a session's burrs, as its scene gives them: the hello's descriptions of burrs have none, but the
// text of the whole scene that comes with them does.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/scene/burr.h"
#include "common/wire/session_info.h"

namespace osteomill {

class KnownShanks {
  public:
    /// Reads the scene's text, once; null: no session.
    void take_in(const SessionInfo* session);
    /// The shank of the burr of that index; empty if the burr has none, or the server sent no scene or one
    /// that cannot be read.
    const ShankProfile& of(std::size_t burr) const;

  private:
    std::string scene_toml_;
    std::vector<ShankProfile> shanks_;
};

}  // namespace osteomill
