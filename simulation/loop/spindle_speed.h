// The spindle's speed, if it is not the burr's own: the chosen speed, approached as a motor does. A speed
// that fell at once would make every chip thicker at once, and the hand would feel a knock.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace osteomill {

class SpindleSpeed {
  public:
    /// A motor that runs changes its speed by a factor of e in so long.
    static constexpr double change_s = 0.1;

    /// `own_rev_per_s`: the speed of each burr of the scene, positive; empty: no speed can be chosen.
    explicit SpindleSpeed(std::vector<double> own_rev_per_s) : own_rev_per_s_(std::move(own_rev_per_s)) {}

    /// Once a tick: how fast `burr` turns, as a share of its own speed. `chosen_rev_per_s`: 0 for its own. A
    /// spindle that stands starts at the chosen speed. Real-time safe.
    double tick(std::size_t burr, double chosen_rev_per_s, bool spindle_on, double tick_s) noexcept {
        if (burr >= own_rev_per_s_.size()) return 1.0;
        const double wanted = chosen_rev_per_s > 0.0 ? chosen_rev_per_s / own_rev_per_s_[burr] : 1.0;
        const double most = std::exp(tick_s / change_s);
        share_ = spindle_on ? std::clamp(wanted, share_ / most, share_ * most) : wanted;
        return share_;
    }

    /// The burr's own speed, rev/s.
    double own_rev_per_s(std::size_t burr) const noexcept { return own_rev_per_s_[burr]; }

  private:
    std::vector<double> own_rev_per_s_;
    double share_ = 1.0;
};

}  // namespace osteomill
