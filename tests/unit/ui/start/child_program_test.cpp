#include "common/program/child_program.h"

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

namespace osteomill {
namespace {

using ::testing::HasSubstr;

void run_to_end(ChildProgram& program) {
    for (int i = 0; i < 3000 && program.is_running(); ++i) {
        program.poll();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    program.poll();
}

ChildProgram shell(const std::string& script) {
    return ChildProgram({"/bin/sh", "-c", script});
}

TEST(ChildProgram, IsHeardOnBothStreamsAndEndsWithItsStatus) {
    ChildProgram program = shell("echo one; echo two >&2; printf 'three \\n\\n'; exit 3");
    run_to_end(program);
    EXPECT_EQ(program.status(), 3);
    EXPECT_EQ(program.output(), "one\ntwo\nthree \n\n");
    EXPECT_EQ(program.last_line(), "three");
}

TEST(ChildProgram, ThatCannotBeRunIsSaidInOneLine) {
    try {
        ChildProgram program({"/no/such/program"});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("/no/such/program cannot be run: No such file"));
    }
}

TEST(ChildProgram, TakesItsArgumentsAsTheyAre) {
    ChildProgram program({"/bin/echo", "a b", "$HOME; rm", "'"});
    run_to_end(program);
    EXPECT_EQ(program.last_line(), "a b $HOME; rm '");
}

TEST(ChildProgram, IsAskedToEndAndSaysWithWhichSignal) {
    ChildProgram program = shell("exec sleep 600");
    program.ask_to_end();
    run_to_end(program);
    EXPECT_EQ(program.status(), -SIGTERM);
}

TEST(ChildProgram, MayWriteWhatItLikesWhileItEndsWithItsOwner) {
    // More than a pipe holds: one that is not read would never end.
    (void)shell("trap 'head -c 1000000 /dev/zero; exit 0' TERM; echo ready; while :; do sleep 0.01; done");
    SUCCEED() << "it is over";
}

TEST(ChildProgram, ThatDoesNotListenIsKilled) {
    for (const char* deaf : {"trap '' TERM; echo ready; while :; do sleep 0.01; done", "kill -STOP $$"}) {
        ChildProgram program({"/bin/sh", "-c", deaf}, std::chrono::seconds(0));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    SUCCEED() << "both are over";
}

TEST(ChildProgram, IsRememberedForNoMoreThanTheLastOfIt) {
    ChildProgram program = shell("head -c 300000 /dev/zero | tr '\\0' x; echo; echo end");
    run_to_end(program);
    EXPECT_EQ(program.output().size(), ChildProgram::most_output_bytes);
    EXPECT_EQ(program.last_line(), "end");
}

}  // namespace
}  // namespace osteomill
