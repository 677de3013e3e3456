// Implicit coupling, the default: the burr is a proxy (burr_proxy.h) on a spring and damper that the device
// can render (coupling_spring.h), and the hand feels spring and damper. The steady force is the milling
// model's; hard bone becomes a wall, air nothing. The burr lags the hand by F / K_c, as a real handpiece
// yields.
//
// The proxy is solved against the engagement map that the milling loop last sampled, a local linear model of
// the bone, and not by running the milling model within the haptic tick. A milling step with its map takes
// 23, 42 and 68 us at the 99th percentile at 0.5, 1 and 2.5 mm depth (milling_benchmark), the haptic
// tick with the solve 7 us: the model would fit into a tick on this bone and this machine, but then the force
// would miss its deadline whenever a carve does not (a long sweep, a large burr, pages of bone first
// touched), and a milling rate of 100 Hz would be out of the question. On the map a late or heavy carve costs
// no haptic deadline, and the mean force differs from the model's by 0.1 to 0.6 %, since force_correction.h
// feeds back the bone that the carve really removed.
//
// With CouplingOptions::feed_forward the hand also feels what the spring passes too late of a change of the
// bone (feed_forward.h). The burr does not: it is pulled by the spring alone.
#pragma once

#include "simulation/coupling/burr_proxy.h"
#include "simulation/coupling/coupling.h"
#include "simulation/coupling/coupling_spring.h"
#include "simulation/coupling/feed_forward.h"
#include "simulation/coupling/fixture_pull.h"
#include "simulation/coupling/position_observer.h"

namespace osteomill {

class ImplicitCoupling final : public Coupling {
  public:
    explicit ImplicitCoupling(const CouplingOptions& options);

    CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept override;
    void reset() noexcept override {
        placed_ = false;
        fixtures_.reset();
    }
    std::unique_ptr<Coupling> copy() const override { return std::make_unique<ImplicitCoupling>(*this); }
    SolveCounts solve_counts() const noexcept override { return proxy_.counts(); }
    FeltFixtures felt_fixtures() const noexcept override { return fixtures_.felt(); }

    /// Filter on the burr's side of the damping, ten times the hand's: the proxy moves unevenly, as its map
    /// is refreshed and contacts come and go, and the hand should not feel that.
    static constexpr double burr_filter_s = ArmSpring::burr_filter_s;

  private:
    PositionObserver hand_;
    BurrProxy proxy_;
    CouplingSpring spring_;
    FixturePull fixtures_;
    FeedForward feed_forward_;
    bool feeds_forward_;
    bool placed_ = false;
};

}  // namespace osteomill
