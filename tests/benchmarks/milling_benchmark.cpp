// The cost of a milling step, beside the published full scan on the same bone in the same run.
//
// Scene: 512 x 512 x 128 voxels of 0.1 mm, 5 mm burr, upright, feed 6 mm/s. Each iteration times one step of
// the crescent, one with the engagement map that the default coupling needs, and one of the scan, which sums
// over bins as published, in turn; the bones must come out equal. Counters: medians and 99th percentiles in
// microseconds; times_faster and map_times_faster are ratios of the medians.
//
// How many times faster the crescent can be is a matter of counts. The scan visits some 70 000 voxels a step,
// at 5 to 8 ns each. The voxels that lose bone, in a step at 100 Hz and at 1 kHz, are 690 and 540 (0.5 mm
// deep), 1430 and 1140 (1 mm), 3790 and 3020 (half immersed). At 1 kHz, half immersed, that is one in 23, in
// 1170 rows of bricks that must be reported.
//
// There a step takes 30 us, 10 ns for such a voxel. 21 % of it are the force (two roots and a division for
// eight voxels, which wait for each other), 20 % writing rows back and reporting them (55 instructions a
// row), 19 % coverage and another 4 % its double precision if single precision is not sure (24 voxels a
// step), 12 % listing rows and voxels, 8 % finding rows, the rest moving voxels from one to the next (perf,
// cpu-clock).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/statistics/percentile.h"
#include "simulation/coupling/couplings.h"
#include "simulation/engagement/engagement_probe.h"
#include "simulation/loop/milling_loop.h"
#include "studies/force/bone_block.h"
#include "studies/force/studied_model.h"
#include "tests/support/ball_structure.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

constexpr double feed_mm_per_s = 6.0;
constexpr double top_mm = 12.8;
const glm::dvec3 up(0.0, 0.0, 1.0);

Bone volume() {
    // The plane z = 0 is the top of the box: all of it is bone.
    return study::voxelised({.low_mm = {0.0, 0.0, -top_mm}, .high_mm = {51.2, 51.2, 0.0}, .up = up}, 0.1);
}

class Times {
  public:
    template <typename Work>
    void time(Work&& work) {
        const auto began = std::chrono::steady_clock::now();
        work();
        us_.push_back(
            std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - began).count());
    }
    double last_us() const { return us_.back(); }
    double percentile_us(double share) const { return percentile(us_, share); }

  private:
    std::vector<double> us_;
};

/// A burr on its way along x, `depth_mm` deep.
class Way {
  public:
    Way(double depth_mm, double rate_hz) : depth_mm_(depth_mm), step_s_(1.0 / rate_hz) {}

    BurrCommand next() {
        const BurrCommand command{
            .pose = {{5.0 + x_mm_, 25.617, 2.5 - depth_mm_}, up}, .spindle_on = true, .elapsed_s = step_s_};
        x_mm_ += feed_mm_per_s * step_s_;
        return command;
    }

  private:
    double depth_mm_;
    double step_s_;
    double x_mm_ = 0.0;
};

/// Arguments: depth in tenths of a millimetre, steps a second.
void CrescentAgainstFullScan(benchmark::State& state) {
    const Burr burr;
    const auto crescent = study::voxel_model()(volume(), burr);
    const auto mapping = study::voxel_model_with_engagement()(volume(), burr);
    const auto scan = study::voxel_model(
        {.summation = ForceSummation::bins, .search = VoxelSearch::full_scan})(volume(), burr);
    Way way(0.1 * static_cast<double>(state.range(0)), static_cast<double>(state.range(1)));
    const BurrCommand first = way.next();
    crescent->step(first);
    mapping->step(first);
    scan->step(first);
    Times crescent_times;
    Times mapping_times;
    Times scan_times;
    for ([[maybe_unused]] auto _ : state) {
        const BurrCommand command = way.next();
        crescent_times.time([&] { benchmark::DoNotOptimize(crescent->step(command)); });
        mapping_times.time([&] { benchmark::DoNotOptimize(mapping->step(command)); });
        scan_times.time([&] { benchmark::DoNotOptimize(scan->step(command)); });
        state.SetIterationTime(1e-6 * crescent_times.last_us());
    }
    if (checksum(crescent->bone()) != checksum(scan->bone())) state.SkipWithError("the bones differ");
    state.counters["p50_us"] = crescent_times.percentile_us(0.5);
    state.counters["p99_us"] = crescent_times.percentile_us(0.99);
    state.counters["map_p50_us"] = mapping_times.percentile_us(0.5);
    state.counters["scan_p50_us"] = scan_times.percentile_us(0.5);
    state.counters["times_faster"] = scan_times.percentile_us(0.5) / crescent_times.percentile_us(0.5);
    state.counters["map_times_faster"] = scan_times.percentile_us(0.5) / mapping_times.percentile_us(0.5);
}
BENCHMARK(CrescentAgainstFullScan)
    ->ArgNames({"depth_0.1mm", "hz"})
    ->ArgsProduct({{5, 10, 25}, {100, 1000}})
    ->Iterations(500)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// A whole step as the implicit coupling wants it, with the engagement map. Argument: depth. edges_times: the
/// time of the same step with edges that rub, relative to one without.
void StepWithEngagement(benchmark::State& state) {
    const auto make = study::voxel_model_with_engagement();
    const auto model = make(volume(), Burr{});
    const auto rubbing = make(volume(), Burr{.edge_coefficients_n_per_mm = {0.3, 0.3, 0.0}});
    Way way(0.1 * static_cast<double>(state.range(0)), 1000.0);
    const BurrCommand first = way.next();
    model->step(first);
    rubbing->step(first);
    Times times;
    Times rubbing_times;
    for ([[maybe_unused]] auto _ : state) {
        const BurrCommand command = way.next();
        times.time([&] { benchmark::DoNotOptimize(model->step(command)); });
        state.SetIterationTime(1e-6 * times.last_us());
        rubbing_times.time([&] { benchmark::DoNotOptimize(rubbing->step(command)); });
    }
    state.counters["p50_us"] = times.percentile_us(0.5);
    state.counters["p99_us"] = times.percentile_us(0.99);
    state.counters["edges_times"] = rubbing_times.percentile_us(0.5) / times.percentile_us(0.5);
}
BENCHMARK(StepWithEngagement)
    ->ArgName("depth_0.1mm")
    ->Arg(5)
    ->Arg(10)
    ->Arg(25)
    ->Iterations(3000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// The time that the shank adds to a step, by the map alone: a shank deep in bone, each of its samples in
/// contact; one in a hole a tenth of a millimetre wider; one in the air above the bone. Argument: which.
void ShankMap(benchmark::State& state) {
    const double shank_radius_mm = 1.0;
    const double hole_radius_mm = state.range(0) == 0 ? 0.0 : 1.1;
    const Bone bone =
        testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 16.0}, 0.1,
                            [&](const glm::dvec3& p) { return std::hypot(p.x, p.y) - hole_radius_mm; });
    ShankProbe probe({.diameter_mm = 2.0, .shank = {{1.2, shank_radius_mm}, {14.0, shank_radius_mm}}});
    const auto engagement = std::make_unique<Engagement>();
    const glm::dvec3 burr_mm(0.0, 0.0, state.range(0) == 2 ? 17.0 : 0.0);
    Times times;
    for ([[maybe_unused]] auto _ : state) {
        times.time([&] { probe.sample(bone, burr_mm, up, *engagement); });
        state.SetIterationTime(1e-6 * times.last_us());
    }
    state.counters["patches"] = static_cast<double>(engagement->shank_count);
    state.counters["p50_us"] = times.percentile_us(0.5);
    state.counters["p99_us"] = times.percentile_us(0.99);
}
BENCHMARK(ShankMap)->ArgName("where")->DenseRange(0, 2)->Iterations(20000)->UseManualTime()->Unit(
    benchmark::kMicrosecond);

/// The milling loop as the server runs it at 10 kHz: ten steps for each of the haptic loop's commands, an
/// engagement map once. One iteration is 10 ms of the session; share_of_a_core is CPU time over that.
void LoopAtTenKilohertz(benchmark::State& state) {
    MillingModel model(volume(), {Burr{}}, {});
    TripleBuffer<BurrCommand> commands;
    const auto results = std::make_unique<TripleBuffer<MillingResult>>();
    ChangeQueue changes(std::size_t{1} << 22, model.bone().shared_content());
    MillingLoop loop({.model = model, .commands = commands, .results = *results, .changes = changes}, 0.001);
    Way way(0.1 * static_cast<double>(state.range(0)), 1000.0);
    double time_s = 0.0;
    const auto tick = [&] {
        commands.back() = way.next();
        commands.publish();
        for (int step = 0; step < 10; ++step) loop.step(time_s += 1e-4, 1e-4);
        changes.consume_all([](const BrickChange&, BrickFractions) {});
    };
    tick();
    for ([[maybe_unused]] auto _ : state)
        for (int i = 0; i < 10; ++i) tick();
    state.counters["share_of_a_core"] =
        benchmark::Counter(0.01 * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(LoopAtTenKilohertz)
    ->ArgName("depth_0.1mm")
    ->Arg(5)
    ->Arg(10)
    ->Arg(25)
    ->Iterations(100)
    ->Unit(benchmark::kMillisecond);

/// The time that fixtures add to a haptic tick: the default coupling's tick with a burr half a millimetre
/// from a nerve, in air, without a fixture, with all of the following switched off, with a guide, a forbidden
/// region and a slow zone, and with a forbidden region about a fissure burr, in turn; all act but those that
/// are off. Counters: medians of a tick, in microseconds, each over that without.
void TickWithFixture(benchmark::State& state) {
    const Grid grid{.size_voxels = {96, 96, 96}, .spacing_mm = 0.1, .origin_mm = {-4.75, -4.75, -4.75}};
    const std::vector<Structure> nerve{{.tissue = 0, .mask = testing::ball_mask(grid, glm::dvec3(0.0), 1.0)}};
    Scene scene;
    scene.tissues = {{.label = 7, .name = "nerve", .is_protected = true}};
    scene.burrs = {{.name = "2 mm", .diameter_mm = 2.0}, {.name = "fissure", .diameter_mm = 2.0}};
    scene.burrs[1].head = usual_head(HeadShape::cylinder, 2.0, 4.0);
    struct Tried {
        const char* name;
        std::vector<Fixture> fixtures;
        FixtureSet on = every_fixture;
        std::size_t burr = 0;
        std::unique_ptr<Coupling> coupling{};
        Times times{};
    };
    Fixture guide = usual_fixture(FixtureKind::guide);
    guide.path = PlaneGuide{{2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
    const Fixture forbidden = usual_fixture(FixtureKind::forbidden);
    const Fixture slow = usual_fixture(FixtureKind::slow);
    std::vector<Tried> all;
    all.push_back({"without", {}});
    all.push_back({"off", {guide, forbidden, slow}, 0});
    all.push_back({"guide", {guide}});
    all.push_back({"forbidden", {forbidden}});
    all.push_back({"slow", {slow}});
    all.push_back({"forbidden_fissure", {forbidden}, every_fixture, 1});
    for (Tried& one : all) {
        scene.fixtures = one.fixtures;
        for (Fixture& fixture : scene.fixtures) fixture.tissue = "nerve";
        one.coupling =
            make_coupling({CouplingKind::implicit}, {.device = in_patient_space(DeviceLimits(), ArmScale()),
                                                     .fixtures = make_fixtures(scene, nerve, 1.5)});
    }
    // A tick is short beside a reading of the clock: so many are timed at once.
    constexpr int ticks = 100;
    const auto latest = std::make_unique<MillingResult>();
    double time_s = 0.0;
    const auto tick = [&](Tried& one, double now_s) {
        const glm::dvec3 hand_mm(2.5 + 0.05 * std::sin(10.0 * now_s), 0.1, 0.0);
        benchmark::DoNotOptimize(one.coupling->tick(
            {.now_s = now_s, .pose = {hand_mm, up}, .burr = one.burr, .fixtures_on = one.on}, *latest));
    };
    for ([[maybe_unused]] auto _ : state) {
        for (Tried& one : all)
            one.times.time([&] {
                for (int j = 0; j < ticks; ++j) tick(one, time_s + 0.001 * j);
            });
        time_s += 0.001 * ticks;
        state.SetIterationTime(1e-6 * all.front().times.last_us() / ticks);
    }
    const double without_us = all.front().times.percentile_us(0.5);
    state.counters["without_p50_us"] = without_us / ticks;
    for (std::size_t i = 1; i < all.size(); ++i) {
        const Tried& one = all[i];
        if ((one.coupling->felt_fixtures().acting == 0) != (one.on == 0))
            state.SkipWithError("a fixture does not act, or one that is off does");
        state.counters[std::string(one.name) + "_p50_us"] = one.times.percentile_us(0.5) / ticks;
        state.counters[std::string(one.name) + "_times"] = one.times.percentile_us(0.5) / without_us;
    }
}
BENCHMARK(TickWithFixture)->Iterations(300)->UseManualTime()->Unit(benchmark::kMicrosecond);

/// Nothing near: above the bone, and in the empty corner of a big grid.
void FreeAir(benchmark::State& state) {
    const auto model = study::voxel_model_with_engagement()(volume(), Burr{});
    Way way(-5.0, 1000.0);
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(model->step(way.next()));
}
BENCHMARK(FreeAir)->Iterations(5000)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace osteomill

int main(int argument_count, char** arguments) {
    benchmark::Initialize(&argument_count, arguments);
    if (benchmark::ReportUnrecognizedArguments(argument_count, arguments)) return 2;
    benchmark::AddCustomContext("All of it takes", "about half a minute");
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
