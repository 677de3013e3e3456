// The scene's fixtures in a coupling's balance, tick by tick: beside the pull of spring and damper they act
// on the burr, not on the hand, and are solved with both at the tick's end. So the hand feels a fixture
// through the coupling's spring, as it feels a wall: never stiffer than the arm can render, whatever the
// fixture's stiffness.
//
// Nothing begins at once. After a start, a fault or a placement a fixture comes in over come_in_s; and where
// another burr, wider or narrower, takes the place of one, from the one's force to the other's.
//
// Nor does a slow zone let go at once: its drag falls by no more than a factor of e in lets_go_s. Otherwise
// the spring, stretched by it, throws a tool with a mass after the hand: 0.17 N a tick at 40 mm/s and 50 N
// s/m, more with more drag, whatever the form of the fade.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "simulation/coupling/contact_solve.h"
#include "simulation/fixtures/fixtures.h"

namespace osteomill {

/// The effect of fixtures on a coupling's burr in the last tick.
struct FeltFixtures {
    glm::dvec3 force_n{0.0};     ///< on the burr, patient axes
    double spindle_share = 1.0;  ///< of the speed that the spindle would have
    FixtureSet acting = 0;
};

class FixturePull {
  public:
    static constexpr double come_in_s = 0.25;
    static constexpr double lets_go_s = 0.03;
    /// Less is none: a hundredth of a newton at 100 mm/s.
    static constexpr double least_drag_n_s_per_mm = 1e-4;

    /// Null: there are none.
    explicit FixturePull(std::shared_ptr<const Fixtures> fixtures) : fixtures_(std::move(fixtures)) {}

    /// From the next tick on they come in anew.
    void reset() noexcept {
        share_ = 0.0;
        has_burr_ = false;
        drag_n_s_per_mm_ = 0.0;
        pulls_ = false;
        felt_ = {};
    }

    /// Adds the pull on the burr, which is at `pose` before the step of a tick of `tick_s`, of those that are
    /// in `on`; returns whether there is any. Real-time safe.
    bool add_to(LinearPull& pull, const ToolPose& pose, std::size_t burr, double tick_s,
                FixtureSet on) noexcept {
        if (!fixtures_) return false;
        take_burr(burr);
        share_ = std::min(1.0, share_ + tick_s / come_in_s);
        changed_ = std::min(1.0, changed_ + tick_s / come_in_s);
        if (on == 0 && drag_n_s_per_mm_ == 0.0) {
            pulls_ = false;
            felt_ = {};
            return false;
        }
        const FixturesHere here = fixtures_->at(pose, burr_, on);
        SpringAndDamper now = scaled(here.pull, share_ * changed_);
        double drag_n_s_per_mm = share_ * changed_ * here.drag_n_s_per_mm;
        if (changed_ < 1.0) {
            const FixturesHere before = fixtures_->at(pose, burr_before_, on);
            now += scaled(before.pull, share_ * (1.0 - changed_));
            drag_n_s_per_mm += share_ * (1.0 - changed_) * before.drag_n_s_per_mm;
        }
        drag_n_s_per_mm_ = std::max(drag_n_s_per_mm, left_of_drag(tick_s));
        now.damping_n_s_per_mm += glm::dmat3(drag_n_s_per_mm_);
        at_rest_n_ = now.force_n;
        felt_ = {.force_n = now.force_n, .spindle_share = here.spindle_share, .acting = here.acting};
        resistance_n_per_mm_ = now.resistance_n_per_mm + now.damping_n_s_per_mm / tick_s;
        pulls_ = !now.is_none();
        if (!pulls_) return false;
        pull.has_fixtures = true;
        pull.of_fixtures_n = at_rest_n_;
        pull.offset_n += at_rest_n_;
        pull.damping_n_per_mm += resistance_n_per_mm_;
        return true;
    }

    /// Takes the burr's step in that tick.
    void settle(const glm::dvec3& step_mm) noexcept {
        if (pulls_) felt_.force_n = at_rest_n_ - resistance_n_per_mm_ * step_mm;
    }

    /// At the end of the last tick.
    const FeltFixtures& felt() const noexcept { return felt_; }

  private:
    void take_burr(std::size_t burr) noexcept {
        if (has_burr_ && burr == burr_) return;
        burr_before_ = has_burr_ ? burr_ : burr;
        burr_ = burr;
        changed_ = has_burr_ ? 0.0 : 1.0;
        has_burr_ = true;
    }
    double left_of_drag(double tick_s) const noexcept {
        const double left_n_s_per_mm = drag_n_s_per_mm_ * std::max(0.0, 1.0 - tick_s / lets_go_s);
        return left_n_s_per_mm < least_drag_n_s_per_mm ? 0.0 : left_n_s_per_mm;
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
    bool pulls_ = false;    // in this tick
    bool has_burr_ = false;
    std::size_t burr_ = 0;
    std::size_t burr_before_ = 0;
    double drag_n_s_per_mm_ = 0.0;
    glm::dvec3 at_rest_n_{0.0};
    glm::dmat3 resistance_n_per_mm_{0.0};
    FeltFixtures felt_{};
};

}  // namespace osteomill
