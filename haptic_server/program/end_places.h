// Places of the files that a session writes when it has ended: each reserved for it, and watched meanwhile.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "common/files/output_place.h"
#include "haptic_server/program/session_outputs.h"

namespace osteomill {

class EndPlaces {
  public:
    /// Throws as OutputPlace does.
    explicit EndPlaces(const OutputFiles& files);

    /// Null: no bone is saved.
    const OutputPlace* save_bone() const { return save_bone_ ? &*save_bone_ : nullptr; }
    /// The paths to write them to now.
    OutputFiles now() const;

    /// Twice a second.
    bool look_is_due() const { return std::chrono::steady_clock::now() >= next_look_; }
    /// A line for each thing that has gone wrong since the last call: a folder is gone, or the bone's file
    /// has changed since it was loaded.
    std::vector<std::string> look(const BoneSource& source);

  private:
    OutputFiles files_;
    std::optional<OutputPlace> save_bone_{};
    std::optional<OutputPlace> json_{};
    std::optional<OutputPlace> histograms_{};
    std::chrono::steady_clock::time_point next_look_{};
    bool source_is_lost_ = false;
};

}  // namespace osteomill
