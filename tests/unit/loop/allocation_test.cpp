// Real-time code does not allocate: this program counts every call of operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>

#include "haptic_server/device/client_device.h"
#include "haptic_server/device/simulated_device.h"
#include "haptic_server/loop/haptic_loop.h"
#include "haptic_server/loop/milling_loop.h"
#include "tests/support/block.h"

namespace {

std::atomic<std::size_t> allocations{0};

}  // namespace

void* operator new(std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    const auto align = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace osteomill {
namespace {

const Burr burr{.name = "2 mm", .diameter_mm = 2.0};
const ToolPose start{{-3.0, 0.0, 0.5}, {0.0, 0.0, 1.0}};

/// Slides through a block with the spindle on: the loops are in the middle of their work.
struct Rig {
    explicit Rig(const std::string& coupling_name, HapticDevice& device)
        : coupling(make_coupling(coupling_name, {.device = device.limits(), .milling_period_s = 0.001})),
          haptic({device, *coupling, *results, commands, tool, status, &log}, {.start_pose = start}) {}

    std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "allocation_test.csv";
    ForceLog log{file};
    MillingModel model{osteomill::testing::make_block({-4.0, -4.0, -3.2}, {4.0, 4.0, 0.0}, 0.1), {burr}, {}};
    std::unique_ptr<TripleBuffer<MillingResult>> results = std::make_unique<TripleBuffer<MillingResult>>();
    TripleBuffer<BurrCommand> commands;
    TripleBuffer<ToolSnapshot> tool;
    TripleBuffer<ToolSnapshot> status;
    EditQueue edits{512, model.bone().content().slot_of_brick.size()};  // small: it overflows, too
    std::unique_ptr<Coupling> coupling;
    HapticLoop haptic;
    MillingLoop milling{model, commands, *results, edits};
};

void expect_no_allocation(const std::string& coupling_name, HapticDevice& device) {
    const auto rig = std::make_unique<Rig>(coupling_name, device);
    const std::size_t before = allocations.load();
    for (int tick = 0; tick < 2000; ++tick) {
        const double time_s = 0.001 * tick;
        rig->haptic.tick(time_s, tick % 500 == 499 ? 30 : 0);  // faults are no excuse
        rig->milling.step(time_s, 0.001);
    }
    EXPECT_EQ(allocations.load() - before, 0u) << coupling_name;
    EXPECT_GT(rig->model.removed_mm3()[0], 0.1) << "there was something to do";
    EXPECT_GT(rig->edits.overflow_count(), 0u);
    std::filesystem::remove(rig->file);
}

TEST(RealTimeCode, AllocatesNothingWithASimulatedHand) {
    for (const std::string& name : coupling_names()) {
        SimulatedDevice device(Trajectory({{0.0, start, true, std::nullopt},
                                           {2.0, {{3.0, 0.0, 0.2}, {0.0, 0.0, 1.0}}, false, std::nullopt}}),
                               DeviceMapping{}, ArmModel{}, hand_model(Grip::firm));
        expect_no_allocation(name, device);
    }
}

TEST(RealTimeCode, AllocatesNothingWithAnOperator) {
    TripleBuffer<OperatorInput> input;
    input.back() = {.hand_target = {{3.0, 0.0, 0.2}, {0.0, 0.0, 1.0}}, .pedal = true, .present = true};
    input.publish();
    ClientDevice device(input, start, DeviceMapping{}, ArmModel{}, hand_model(Grip::firm));
    expect_no_allocation(coupling_names().front(), device);
}

TEST(RealTimeCode, WouldBeCaughtAllocating) {
    const std::size_t before = allocations.load();
    const auto something = std::make_unique<int>(1);
    EXPECT_GT(allocations.load(), before);
    EXPECT_EQ(*something, 1);
}

}  // namespace
}  // namespace osteomill
