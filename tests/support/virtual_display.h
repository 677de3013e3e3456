// An X server without a monitor (Xvfb), whose screen can be read and whose mouse and keyboard a test moves
// (xdotool).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render_client/volume/picture.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {

class VirtualDisplay {
  public:
    /// The parts that this machine lacks for it; empty if all are there.
    static std::string missing();

    /// Starts one with a screen of that size. Throws std::runtime_error if it does not come up.
    explicit VirtualDisplay(const glm::ivec2& size_px);

    /// `command` with its windows on this display.
    std::vector<std::string> shown_here(std::vector<std::string> command) const;
    /// One run of xdotool; whether it succeeded. "search" and the like wait as long as xdotool does.
    bool xdotool(const std::vector<std::string>& arguments) const;
    /// The picture on the screen now.
    Picture screen() const;
    /// Ends the server under its clients.
    void break_down() { server_.reset(); }

  private:
    TemporaryFolder folder_;
    std::optional<ChildProcess> server_;
    std::string name_;
};

}  // namespace osteomill::testing
