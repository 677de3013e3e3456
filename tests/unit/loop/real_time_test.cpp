#include "simulation/loop/real_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>

#include <array>
#include <functional>
#include <thread>

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(RealTimeRights, AreAdvisedOnOnlyWhereTheyAreMissing) {
    EXPECT_EQ(advice_on_rights({true, true}, "bin/haptic_server"), "");
    EXPECT_THAT(advice_on_rights({false, true}, "bin/haptic_server"),
                AllOf(HasSubstr("no right to real-time priority:"),
                      HasSubstr("sudo setcap cap_sys_nice,cap_ipc_lock+ep bin/haptic_server")));
    EXPECT_THAT(advice_on_rights({true, false}, "x"), HasSubstr("no right to lock memory:"));
    EXPECT_THAT(advice_on_rights({false, false}, "x"), HasSubstr("nor to lock memory"));
}

/// Far down the stack, page by page.
void use_stack() {
    std::array<volatile char, touched_stack_bytes / 2> deep;
    for (std::size_t i = 0; i < deep.size(); i += 1024) deep[i] = 1;
}

/// On a stack that nobody had before: not of a thread that ended, nor locked since a session of another test.
std::uint64_t faults_of(const std::function<void()>& before, const std::function<void()>& work) {
    struct Counted {
        const std::function<void()>& before;
        const std::function<void()>& work;
        std::uint64_t faults = 0;
    } counted{before, work};
    constexpr std::size_t bytes = 4 * touched_stack_bytes;
    munlockall();
    void* const stack =
        mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, stack, bytes);
    pthread_t thread{};
    const auto run = [](void* data) -> void* {
        auto& to = *static_cast<Counted*>(data);
        to.before();
        const std::uint64_t so_far = page_faults_of_this_thread();
        to.work();
        to.faults = page_faults_of_this_thread() - so_far;
        return nullptr;
    };
    EXPECT_EQ(pthread_create(&thread, &attributes, run, &counted), 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
    munmap(stack, bytes);
    return counted.faults;
}

TEST(TouchStack, LeavesNoPageOfItToBeWaitedFor) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "ThreadSanitizer waits for pages of its own shadow of the stack";
#endif
    EXPECT_GT(faults_of([] {}, use_stack), 8u) << "it is worth it, and the count counts";
    EXPECT_LE(faults_of(touch_stack, use_stack), 2u) << "none but those of a sanitizer's own books";
}

TEST(BindToCpu, KeepsAThreadWhereItIsPut) {
    const std::vector<int> cpus = usable_cpus();
    ASSERT_FALSE(cpus.empty());
    std::thread([&] {
        ASSERT_TRUE(bind_to_cpu(cpus.back()));
        EXPECT_EQ(usable_cpus(), std::vector<int>{cpus.back()});
    }).join();
    EXPECT_FALSE(bind_to_cpu(CPU_SETSIZE - 1));
}

}  // namespace
}  // namespace osteomill
