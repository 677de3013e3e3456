// The burrs of a scene, each turning at its own speed or at the one that was chosen.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "common/scene/burr.h"

namespace osteomill {

class TurningBurrs {
  public:
    explicit TurningBurrs(std::vector<Burr> burrs) : burrs_(std::move(burrs)) {
        for (const Burr& burr : burrs_) own_rev_per_s_.push_back(burr.spindle_rev_per_s);
    }

    std::size_t size() const { return burrs_.size(); }
    const std::vector<Burr>& all() const { return burrs_; }
    const Burr& operator[](std::size_t burr) const { return burrs_[burr]; }

    /// Lets a burr turn at a share of its own speed from now on. Real-time safe.
    const Burr& turn(std::size_t burr, double speed_share) noexcept {
        burrs_[burr].spindle_rev_per_s = speed_share * own_rev_per_s_[burr];
        return burrs_[burr];
    }

  private:
    std::vector<Burr> burrs_;
    std::vector<double> own_rev_per_s_;
};

}  // namespace osteomill
