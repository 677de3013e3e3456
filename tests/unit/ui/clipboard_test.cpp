#include "render_client/ui/input/clipboard.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>

namespace osteomill {
namespace {

/// A desktop with one clipboard, and a thread that alone may touch it, asleep unless it is woken.
class Desktop {
  public:
    explicit Desktop(std::string text) : text_(std::move(text)) {}
    ~Desktop() {
        is_over_ = true;
        wake();
        thread_.join();
    }
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;

    Clipboard& clipboard() { return clipboard_; }

  private:
    void wake() {
        ++wakes_;
        wakes_.notify_one();
    }
    void run() {
        for (int seen = 0; !is_over_; seen = wakes_) {
            clipboard_.serve([this](const std::string& text) { text_ = text; }, [this] { return text_; });
            wakes_.wait(seen);
        }
    }

    std::string text_;
    std::atomic<bool> is_over_{false};
    std::atomic<int> wakes_{0};
    Clipboard clipboard_{[this] { wake(); }};
    std::thread thread_{[this] { run(); }};
};

TEST(Clipboard, PastesWhatAnotherProgramCopied) {
    Desktop desktop("theirs");
    EXPECT_EQ(desktop.clipboard().paste(), "theirs");
    EXPECT_EQ(desktop.clipboard().paste(), "theirs");
}

TEST(Clipboard, PastesWhatWasCopiedHereLast) {
    Desktop desktop("theirs");
    for (int i = 0; i < 100; ++i) {
        desktop.clipboard().copy("ours");
        desktop.clipboard().copy(std::to_string(i));
        ASSERT_EQ(desktop.clipboard().paste(), std::to_string(i));
    }
}

TEST(Clipboard, PastesNothingWhereTheWindowDoesNotAnswer) {
    Clipboard clipboard([] {});
    EXPECT_EQ(clipboard.paste(), "");
}

}  // namespace
}  // namespace osteomill
