// The lines of a window on the outcome of requests to the session, in its language.
#pragma once

#include <string>

#include "common/session/session_control.h"

namespace osteomill {

class ControlNotices {
  public:
    /// The line for an event that the window hears of at `now_s`; empty for a pause, which is said for as
    /// long as it lasts. A burr that stood in the bone that undo
    /// gave back is lifted out of it, which is an event, too: its line begins with how much came back.
    std::string notice_of(const ControlEvent& event, double now_s);

  private:
    std::string came_back_;
    double came_back_s_ = 0.0;
};

}  // namespace osteomill
