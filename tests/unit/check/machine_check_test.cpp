#include "haptic_server/check/machine_check.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/fake_hid.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A machine on which nothing is wrong, to be spoilt line by line.
class MachineCheck : public ::testing::Test {
  protected:
    MachineCheck() {
        say("proc/version", "Linux version 6.1.0 (Debian) #1 SMP PREEMPT_DYNAMIC Debian 6.1.1");
        say("proc/sys/kernel/sched_rt_runtime_us", "950000");
        say("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
        say("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance");
        state(0, "POLL", "0", "0");
        state(1, "C1", "2", "0");
        say("sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc");
        say("dev/dri/renderD128", "");
    }

    void say(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text << '\n';
    }
    void state(int number, const std::string& name, const std::string& latency_us,
               const std::string& disable) const {
        const std::string folder = "sys/devices/system/cpu/cpu0/cpuidle/state" + std::to_string(number) + '/';
        say(folder + "name", name);
        say(folder + "latency", latency_us);
        say(folder + "disable", disable);
    }

    CheckRow row(const std::string& what) const {
        for (const CheckRow& row : check_machine(machine_))
            if (row.what == what) return row;
        ADD_FAILURE() << "no row says " << what;
        return {};
    }
    /// It is the only one that is wrong.
    void expect_wrong(const std::string& what, bool can_wait, const ::testing::Matcher<std::string>& cost,
                      const std::string& mend) const {
        const CheckRow found = row(what);
        EXPECT_THAT(found.cost, cost);
        EXPECT_THAT(found.mend, HasSubstr(mend));
        EXPECT_EQ(found.can_wait, can_wait);
        for (const CheckRow& other : check_machine(machine_)) {
            if (other.what == what) continue;
            EXPECT_TRUE(other.is_right()) << other.what << ": " << other.cost;
        }
        EXPECT_EQ(must_be_mended(check_machine(machine_)), !can_wait);
    }

    testing::TemporaryFolder root_;
    CheckedMachine machine_{.root = root_.path(),
                            .program = "/opt/haptic_server",
                            .rights = {.priority = true, .memory = true},
                            .measure_wake_ups =
                                [] {
                                    return WakeUps{500, 40.0, 90.0};
                                },
                            .measure_clock_ns = [] { return 25.0; }};
};

TEST_F(MachineCheck, HasNothingToSayOfAGoodMachine) {
    const std::vector<CheckRow> rows = check_machine(machine_);
    EXPECT_EQ(rows.size(), 9U);
    for (const CheckRow& row : rows) EXPECT_TRUE(row.is_right()) << row.what;
    EXPECT_FALSE(must_be_mended(rows));
    EXPECT_THAT(text_of(rows), HasSubstr("9 looked at, 0 wrong, 0 could be better\n"));
}

TEST_F(MachineCheck, MissesTheRightToPriority) {
    machine_.rights.priority = false;
    expect_wrong("real-time priority", false, HasSubstr("ticks come late"),
                 "sudo setcap cap_sys_nice,cap_ipc_lock+ep /opt/haptic_server");
}

TEST_F(MachineCheck, MissesTheRightToLockPages) {
    machine_.rights.memory = false;
    expect_wrong("page locking", false, HasSubstr("a page from the disk"), "sudo setcap");
}

TEST_F(MachineCheck, FindsNoShareForRealTime) {
    say("proc/sys/kernel/sched_rt_runtime_us", "0");
    expect_wrong("real-time share", false, HasSubstr("no time at all"), "sched_rt_runtime_us=950000");
    say("proc/sys/kernel/sched_rt_runtime_us", "-1");
    EXPECT_TRUE(row("real-time share").is_right()) << "no limit";
}

TEST_F(MachineCheck, FindsAKernelThatDoesNotPreempt) {
    say("proc/version", "Linux version 6.1.0 (gcc) #1 SMP Debian 6.1.1");
    expect_wrong("kernel preemption", false, HasSubstr("milliseconds"), "linux-image-rt-amd64");
    say("sys/kernel/realtime", "1");
    EXPECT_TRUE(row("kernel preemption").is_right());
}

TEST_F(MachineCheck, MeasuresWakeUps) {
    machine_.measure_wake_ups = [] { return WakeUps{500, 80.0, 2300.0}; };
    expect_wrong("wake-ups", true, HasSubstr("2.3 ms late"), "--haptic-cpu 2");
    EXPECT_EQ(row("wake-ups").found, "of 500 99 % within 80 us, the latest after 2300 us");
}

TEST_F(MachineCheck, FindsAProcessorThatSlowsDown) {
    say("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave");
    expect_wrong("frequency", true, HasSubstr("slowed down"), "frequency-set --governor performance");
    EXPECT_EQ(row("frequency").found, "performance, powersave");
}

TEST_F(MachineCheck, FindsAnIdleStateThatTakesLongToLeave) {
    state(2, "C6", "133", "0");
    expect_wrong("idle states", true, HasSubstr("133 us later"), "idle-set --disable-by-latency 100");
    state(2, "C6", "133", "1");
    EXPECT_THAT(row("idle states").found, HasSubstr("down to C1, 2 us")) << "the deeper one is off";
}

TEST_F(MachineCheck, MeasuresTheClock) {
    say("sys/devices/system/clocksource/clocksource0/current_clocksource", "hpet");
    machine_.measure_clock_ns = [] { return 1400.0; };
    expect_wrong("clock source", false, HasSubstr("1.4 us"), "clocksource=tsc");
}

TEST_F(MachineCheck, FindsNoGpu) {
    std::filesystem::remove_all(root_ / "dev");
    expect_wrong("GPU", true, HasSubstr("by its processors"), "another machine");
}

TEST_F(MachineCheck, LeavesOutWhatAVirtualMachineDoesNotSay) {
    std::filesystem::remove_all(root_ / "sys");
    std::filesystem::remove_all(root_ / "proc");
    EXPECT_EQ(check_machine(machine_).size(), 4U) << "rights, wake-ups and the GPU";
}

TEST_F(MachineCheck, OfThisMachineMeasures) {
    const CheckedMachine here = this_machine();
    const WakeUps wakes = here.measure_wake_ups();
    EXPECT_EQ(wakes.count, 500);
    EXPECT_GT(wakes.p99_us, 0.0);
    EXPECT_GE(wakes.latest_us, wakes.p99_us);
    EXPECT_GT(here.measure_clock_ns(), 0.0);
}

TEST(DeviceCheck, FindsAnArmThatIsNotPermitted) {
    testing::FakeHid hid;
    EXPECT_EQ(check_devices(hid).found, "none is plugged in");
    testing::FakeHidDevice device;
    hid.plug(device);
    EXPECT_TRUE(check_devices(hid).is_right());
    EXPECT_THAT(check_devices(hid).found, HasSubstr("/dev/hidraw0: ready"));
    device.is_permitted = false;
    hid.plug(device);
    const CheckRow row = check_devices(hid);
    EXPECT_FALSE(row.is_right());
    EXPECT_FALSE(row.can_wait);
    EXPECT_THAT(row.mend, AllOf(HasSubstr("70-osteomill.rules"), HasSubstr("udevadm trigger")));
}

TEST(CheckRows, SayWhatIsWrongItsCostAndItsMend) {
    EXPECT_EQ(osteomill::text_of(
                  {{"a", "fine"}, {"b", "bad", "much", "do it"}, {"c", "so so", "little", "wait", true}}),
              "right            a                      fine\n"
              "wrong            b                      bad\n"
              "                 costs: much\n"
              "                 mend:  do it\n"
              "could be better  c                      so so\n"
              "                 costs: little\n"
              "                 mend:  wait\n"
              "3 looked at, 1 wrong, 1 could be better\n");
}

}  // namespace
}  // namespace osteomill
