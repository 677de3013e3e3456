// The desktop's clipboard, for the panels. Only the window's thread may speak to the desktop: it takes text
// that the drawing thread copies, and fetches text that that thread waits to paste.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace osteomill {

class Clipboard {
  public:
    /// The program that was copied from may not answer: then nothing is pasted.
    static constexpr std::chrono::seconds longest_wait{1};

    /// `wake` makes the window's thread serve soon, whatever it waits for.
    explicit Clipboard(std::function<void()> wake) : wake_(std::move(wake)) {}

    // Thread that draws.

    void copy(std::string text) {
        {
            const std::scoped_lock lock(mutex_);
            copied_ = std::move(text);
        }
        wake_();
    }

    /// The text that was copied last, here or in another program; valid until the next call.
    const std::string& paste() {
        {
            const std::scoped_lock lock(mutex_);
            is_wanted_ = true;
            fetched_.reset();
        }
        wake_();
        std::unique_lock lock(mutex_);
        has_fetched_.wait_for(lock, longest_wait, [this] { return fetched_.has_value(); });
        is_wanted_ = false;
        pasted_ = std::exchange(fetched_, std::nullopt).value_or("");
        return pasted_;
    }

    // Thread of the window.

    /// `put(text)` gives the desktop a text, `get()` returns the one that it has.
    template <typename Put, typename Get>
    void serve(const Put& put, const Get& get) {
        std::unique_lock lock(mutex_);
        const std::optional<std::string> copied = std::exchange(copied_, std::nullopt);
        const bool is_wanted = std::exchange(is_wanted_, false);
        // The desktop may take its time.
        lock.unlock();
        if (copied) put(*copied);
        if (!is_wanted) return;
        std::string text = get();
        lock.lock();
        fetched_ = std::move(text);
        lock.unlock();
        has_fetched_.notify_one();
    }

  private:
    std::function<void()> wake_;
    std::mutex mutex_;
    std::condition_variable has_fetched_;
    std::optional<std::string> copied_, fetched_;
    bool is_wanted_ = false;
    std::string pasted_;  // the drawing thread's alone
};

}  // namespace osteomill
