// The change from one burr to another, made in the air and at rest, as a surgeon would: a larger burr inside
// bone would throw the hand out of it or, turning, remove all of that bone at once. A change that has to wait
// is made as soon as possible, unless it is cancelled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "simulation/exchange/milling_step.h"

namespace osteomill {

/// The condition that a wanted change waits for; none if no change is wanted.
enum class BurrChange : std::uint8_t { none, spindle, bone };

/// One line for people; empty for BurrChange::none.
constexpr const char* describe(BurrChange waits_for) noexcept {
    switch (waits_for) {
        case BurrChange::none:
            break;
        case BurrChange::spindle:
            return "the burr is changed once the spindle stands: let go of the pedal";
        case BurrChange::bone:
            return "the burr is changed in the air: lift it clear of the bone";
    }
    return "";
}

class BurrChanger {
  public:
    BurrChanger(std::size_t burr, std::size_t count) : burr_(burr), wanted_(burr), count_(count) {}

    /// To be called once a tick, with the burr that the device requests. Without a request, or for a number
    /// outside the set, nothing changes. The tool is at `position_mm` (patient LPS); `latest` says whether
    /// the wanted burr would be clear of bone there. Real-time safe.
    void tick(const std::optional<std::size_t>& request, bool spindle_on, const glm::dvec3& position_mm,
              const MillingResult& latest) noexcept;

    /// The one in the tool.
    std::size_t burr() const { return burr_; }
    /// The wanted change, for the milling loop to examine; nothing while none is wanted.
    std::optional<std::size_t> wanted() const {
        return wanted_ == burr_ ? std::nullopt : std::optional(wanted_);
    }
    BurrChange waits_for() const { return waits_for_; }

  private:
    std::size_t burr_;
    std::size_t wanted_;
    std::size_t count_;
    BurrChange waits_for_ = BurrChange::none;
};

}  // namespace osteomill
