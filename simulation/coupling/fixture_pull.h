// The scene's fixtures in a coupling's balance, tick by tick: beside the pull of spring and damper they act
// on the burr, not on the hand, and are solved with both at the tick's end. So the hand feels a fixture
// through the coupling's spring, as it feels a wall: never stiffer than the arm can render, whatever the
// fixture's stiffness.
//
// Nothing begins at once. After a start, a fault or a placement a fixture comes in over come_in_s; and where
// another burr, wider or narrower, takes the place of one, from the one's force to the other's.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "simulation/coupling/contact_solve.h"
#include "simulation/fixtures/fixtures.h"

namespace osteomill {

class FixturePull {
  public:
    static constexpr double come_in_s = 0.25;

    /// Null: there are none.
    explicit FixturePull(std::shared_ptr<const Fixtures> fixtures) : fixtures_(std::move(fixtures)) {}

    /// From the next tick on they come in anew.
    void reset() noexcept {
        share_ = 0.0;
        has_burr_ = false;
        force_n_ = glm::dvec3(0.0);
    }

    /// Adds their pull on the burr, which is at `pose` before the step of a tick of `tick_s`; returns whether
    /// there is any. Real-time safe.
    bool add_to(LinearPull& pull, const ToolPose& pose, std::size_t burr, double tick_s) noexcept {
        if (!fixtures_) return false;
        take_burr(burr);
        share_ = std::min(1.0, share_ + tick_s / come_in_s);
        changed_ = std::min(1.0, changed_ + tick_s / come_in_s);
        SpringAndDamper now = scaled(fixtures_->pull_on(pose, burr_), share_ * changed_);
        if (changed_ < 1.0) now += scaled(fixtures_->pull_on(pose, burr_before_), share_ * (1.0 - changed_));
        at_rest_n_ = force_n_ = now.force_n;
        resistance_n_per_mm_ = now.resistance_n_per_mm + now.damping_n_s_per_mm / tick_s;
        if (now.is_none()) return false;
        pull.has_fixtures = true;
        pull.of_fixtures_n = at_rest_n_;
        pull.offset_n += at_rest_n_;
        pull.damping_n_per_mm += resistance_n_per_mm_;
        return true;
    }

    /// Takes the burr's step in that tick.
    void settle(const glm::dvec3& step_mm) noexcept {
        if (fixtures_) force_n_ = at_rest_n_ - resistance_n_per_mm_ * step_mm;
    }

    /// On the burr at the end of the last tick, patient axes.
    const glm::dvec3& force_n() const noexcept { return force_n_; }

  private:
    void take_burr(std::size_t burr) noexcept {
        if (has_burr_ && burr == burr_) return;
        burr_before_ = has_burr_ ? burr_ : burr;
        burr_ = burr;
        changed_ = has_burr_ ? 0.0 : 1.0;
        has_burr_ = true;
    }
    static SpringAndDamper scaled(SpringAndDamper all, double share) noexcept {
        all.force_n *= share;
        all.resistance_n_per_mm *= share;
        all.damping_n_s_per_mm *= share;
        return all;
    }

    std::shared_ptr<const Fixtures> fixtures_;
    double share_ = 0.0;    // that has come in
    double changed_ = 1.0;  // of the change to this burr
    bool has_burr_ = false;
    std::size_t burr_ = 0;
    std::size_t burr_before_ = 0;
    glm::dvec3 at_rest_n_{0.0};
    glm::dmat3 resistance_n_per_mm_{0.0};
    glm::dvec3 force_n_{0.0};
};

}  // namespace osteomill
