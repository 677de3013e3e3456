// The cost of the picture, with panels and tool, on the tooth phantom (512 x 512 x 128 voxels) at 800 x 600.
//
// Each iteration is one frame, finished as showing it would finish it. Counters: medians and 99th percentiles
// of the wall-clock time, cpu_ms of all threads for a frame; nothing waits for a display.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

#include "render_client/ui/view/session_picture.h"
#include "studies/render/phantom_session.h"

namespace osteomill {
namespace {

using Clock = std::chrono::steady_clock;

const glm::ivec2 size_px(800, 600);
constexpr double orbit_rad_a_frame = 0.03;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A client with its server played, and no window.
class Client {
  public:
    explicit Client(FrameQuality quality, StereoLayout layout = StereoLayout::off)
        : picture_(session_, panels_, size_px, quality, RendererChoice::raycast, {}, {.layout = layout}) {
        // The first frame uploads, compiles and draws all of it, and is not measured.
        frame();
        frame();
        frame_s_.clear();
        cpu_s_ = 0.0;
    }

    void frame() {
        session_.step();
        const double cpu_before_s = cpu_s();
        const Clock::time_point start = Clock::now();
        picture_.take_in();
        const gl::Framebuffer& framebuffer = picture_.draw(1.0 / 30.0);
        framebuffer.depth_at({0, 0});
        frame_s_.push_back(seconds_since(start));
        cpu_s_ += cpu_s() - cpu_before_s;
        picture_.frame_took(frame_s_.back());
    }

    double last_s() const { return frame_s_.back(); }
    void report(benchmark::State& state) {
        state.counters["p50_ms"] = 1e3 * percentile_s(0.5);
        state.counters["p99_ms"] = 1e3 * percentile_s(0.99);
        state.counters["frames_per_s"] = 1.0 / percentile_s(0.5);
        state.counters["cpu_ms"] = 1e3 * cpu_s_ / static_cast<double>(frame_s_.size());
    }

    PhantomSession& session() { return session_; }
    SessionPicture& picture() { return picture_; }

  private:
    double percentile_s(double share) {
        const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(frame_s_.size() - 1));
        std::nth_element(frame_s_.begin(), frame_s_.begin() + place, frame_s_.end());
        return frame_s_[static_cast<std::size_t>(place)];
    }

    gl::OffscreenContext context_;
    ImguiContext panels_;
    PhantomSession session_;
    SessionPicture picture_;
    std::vector<double> frame_s_;
    double cpu_s_ = 0.0;
};

/// The view turns; every pixel at full quality.
void OrbitAtFullQuality(benchmark::State& state) {
    Client client(FrameQuality::full);
    for ([[maybe_unused]] auto _ : state) {
        orbit(client.picture().camera(), orbit_rad_a_frame, 0.0);
        client.frame();
        state.SetIterationTime(client.last_s());
    }
    client.report(state);
}
BENCHMARK(OrbitAtFullQuality)->Iterations(20)->UseManualTime()->Unit(benchmark::kMillisecond);

/// The view turns at full quality, for two eyes: each with half the pixels (side by side), or with all (a
/// buffer for each eye).
void OrbitInStereo(benchmark::State& state) {
    Client client(FrameQuality::full, static_cast<StereoLayout>(state.range(0)));
    for ([[maybe_unused]] auto _ : state) {
        orbit(client.picture().camera(), orbit_rad_a_frame, 0.0);
        client.frame();
        state.SetIterationTime(client.last_s());
    }
    client.report(state);
}
BENCHMARK(OrbitInStereo)
    ->ArgName("layout")
    ->Arg(static_cast<int>(StereoLayout::off))
    ->Arg(static_cast<int>(StereoLayout::side_by_side))
    ->Arg(static_cast<int>(StereoLayout::rows))
    ->Arg(static_cast<int>(StereoLayout::quad_buffer))
    ->Iterations(20)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// The view turns; scale is the mean resolution that it took.
void OrbitOnDemand(benchmark::State& state) {
    Client client(FrameQuality::on_demand);
    double scales = 0.0;
    for ([[maybe_unused]] auto _ : state) {
        orbit(client.picture().camera(), orbit_rad_a_frame, 0.0);
        client.frame();
        state.SetIterationTime(client.last_s());
        scales += client.picture().quality().scale;
    }
    client.report(state);
    state.counters["scale"] = scales / static_cast<double>(state.iterations());
}
BENCHMARK(OrbitOnDemand)->Iterations(200)->UseManualTime()->Unit(benchmark::kMillisecond);

/// The view was turned and stops: an iteration lasts until every pixel is at full quality; with every panel
/// open, or with those that are always there.
void RefineAfterOrbit(benchmark::State& state) {
    Client client(FrameQuality::on_demand);
    if (state.range(0) == 1) {
        ViewSettings& view = client.picture().view();
        view.help_shown = view.cuts_panel_shown = view.transfer_panel_shown = view.slices_shown = true;
    }
    if (state.range(1) == 1) client.picture().view().transfer.choose(transfer_presets()[1]);
    double longest_s = 0.0;
    double frames = 0.0;
    for ([[maybe_unused]] auto _ : state) {
        for (int frame = 0; frame < 15; ++frame) {
            orbit(client.picture().camera(), orbit_rad_a_frame, 0.0);
            client.frame();
        }
        double refine_s = 0.0;
        do {
            client.frame();
            refine_s += client.last_s();
            frames += 1.0;
        } while (!client.picture().quality().refined);
        state.SetIterationTime(refine_s);
        longest_s = std::max(longest_s, refine_s);
    }
    state.counters["longest_ms"] = 1e3 * longest_s;
    state.counters["frames"] = frames / static_cast<double>(state.iterations());
}
BENCHMARK(RefineAfterOrbit)
    ->ArgNames({"all_panels", "see_through"})
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->Iterations(15)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// The 5 mm burr cuts under a still camera; refined is the share of frames at full quality.
void CarveUnderStillCamera(benchmark::State& state) {
    Client client(static_cast<FrameQuality>(state.range(0)));
    client.session().mill(true);
    double refined = 0.0;
    for ([[maybe_unused]] auto _ : state) {
        client.frame();
        state.SetIterationTime(client.last_s());
        refined += client.picture().quality().refined ? 1.0 : 0.0;
    }
    client.report(state);
    state.counters["refined"] = refined / static_cast<double>(state.iterations());
}
BENCHMARK(CarveUnderStillCamera)
    ->ArgName("on_demand")
    ->Arg(static_cast<int>(FrameQuality::full))
    ->Arg(static_cast<int>(FrameQuality::on_demand))
    ->Iterations(200)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// The same at full quality for two eyes.
void CarveInStereo(benchmark::State& state) {
    Client client(FrameQuality::full, static_cast<StereoLayout>(state.range(0)));
    client.session().mill(true);
    for ([[maybe_unused]] auto _ : state) {
        client.frame();
        state.SetIterationTime(client.last_s());
    }
    client.report(state);
}
BENCHMARK(CarveInStereo)
    ->ArgName("layout")
    ->Arg(static_cast<int>(StereoLayout::off))
    ->Arg(static_cast<int>(StereoLayout::side_by_side))
    ->Arg(static_cast<int>(StereoLayout::quad_buffer))
    ->Iterations(200)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// Nothing moves but the tool's spin: the cost of panels, tool and restoring.
void IdleFrame(benchmark::State& state) {
    Client client(FrameQuality::on_demand);
    for ([[maybe_unused]] auto _ : state) {
        client.frame();
        state.SetIterationTime(client.last_s());
    }
    client.report(state);
}
BENCHMARK(IdleFrame)->Iterations(100)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace osteomill

int main(int argument_count, char** arguments) {
    benchmark::Initialize(&argument_count, arguments);
    if (benchmark::ReportUnrecognizedArguments(argument_count, arguments)) return 2;
    benchmark::AddCustomContext("All of it takes", "about a minute");
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
