// Writer of queued items on a thread of its own, for threads that must not wait for a disk, a pipe or a
// terminal.
//
// The queue is bounded. An item that cannot be written ends the writer, or is tried again at intervals while
// later ones wait, so that none is missing.
//
// A sink that blocks (a pulled drive, a lost server, a terminal stopped by Ctrl-S, a pipe without a reader)
// holds up only that thread: callers wait a bounded time, then the writer is given up. A thread blocked in
// write(2) cannot be joined; it is abandoned, and touches only its own data until the program ends.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace osteomill {

/// `Item` has a size() in bytes.
template <typename Item>
class BackgroundWriter {
  public:
    /// How long finish() waits for a sink that is not ready,
    static constexpr std::chrono::milliseconds longest_block{200};
    /// for one that is ready but takes nothing: a machine so busy that the thread gets no turn, or a disk,
    static constexpr std::chrono::seconds longest_standstill{2};
    /// and for its complete(). Before the end, callers that may wait for a disk wait so long.
    static constexpr std::chrono::seconds longest_wait{30};

    /// A place to write to. It lives as long as the writer and its thread, even an abandoned one.
    struct Sink {
        virtual ~Sink() = default;

        // On the thread. They may wait, and throw std::exception with one line if they fail.

        virtual void write(const Item& item) = 0;
        /// Called last, unless an item is missing.
        virtual void complete() {}

        // With the writer locked. They neither wait nor call it.

        /// Called after each write() with its error, or none, unless the writer was given up meanwhile.
        virtual void note(const std::string& /*error*/) {}
        /// Whether write() would not wait, according to the system.
        virtual bool is_ready() const { return true; }

        std::atomic<std::uint64_t> progress{0};  ///< in items, and in parts of one whose write() takes long

        // Set before the writer is made.

        /// Between two attempts to write an item. Without it, the first failure is the end.
        std::optional<std::chrono::milliseconds> retry_period{};
        std::string defect{};  ///< one line if nothing can be written from the beginning
        std::string standstill = "the disk does not answer";  ///< the error once the writer is given up
    };

    BackgroundWriter(std::shared_ptr<Sink> sink, std::size_t capacity_bytes)
        : shared_(new Shared{std::move(sink), capacity_bytes}) {}
    /// Finishes first, if need be.
    ~BackgroundWriter() { finish(); }
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;

    // Any thread.

    /// False, without taking the item, if less than the capacity is free, unless nothing else waits or it may
    /// go `beyond_capacity`. After the end each is taken, and dropped. Never waits for the sink.
    bool push(Item item, bool beyond_capacity = false) {
        const Lock lock(shared_->mutex);
        if (shared_->is_closing || shared_->has_ended) return true;
        if (!beyond_capacity && !shared_->has_room(item.size())) return false;
        shared_->waiting_bytes += item.size();
        shared_->waiting.push_back(std::move(item));
        if (!thread_.joinable()) start();
        shared_->changed.notify_all();
        return true;
    }
    bool has_room() const {
        const Lock lock(shared_->mutex);
        return shared_->has_room();
    }
    /// Whether nothing waits.
    bool is_idle() const {
        const Lock lock(shared_->mutex);
        return shared_->waiting_bytes == 0;
    }
    /// One line: why the last attempt to write failed, or the writer was given up. Empty if neither.
    std::string error() const {
        const Lock lock(shared_->mutex);
        return shared_->error;
    }
    bool has_failed() const { return !error().empty(); }
    /// Waits until there is room, or an attempt has failed: for callers that may wait for a disk. Gives up
    /// once nothing has been written for so long.
    void wait_for_room(std::chrono::nanoseconds longest = longest_wait) {
        shared_->wait_or_give_up([](Shared& now) { return now.has_room() || now.has_failed(); }, longest);
    }
    /// Waits until nothing waits, or an attempt has failed; gives up alike.
    void wait_until_written(std::chrono::nanoseconds longest = longest_wait) {
        shared_->wait_or_give_up([](Shared& now) { return now.waiting_bytes == 0 || now.has_failed(); },
                                 longest);
    }
    /// Takes no more items and waits until all are written, with one last attempt if the last has failed.
    /// False if the writer was given up.
    bool finish() {
        {
            const Lock lock(shared_->mutex);
            if (std::exchange(shared_->is_closing, true) || !thread_.joinable()) return !shared_->is_given_up;
            shared_->changed.notify_all();
        }
        shared_->wait_or_give_up([](Shared& now) { return now.has_ended || now.is_completing; },
                                 longest_standstill, longest_block);
        shared_->wait_or_give_up([](Shared& now) { return now.has_ended; }, longest_wait);
        const bool is_whole = !is_given_up();
        is_whole ? thread_.join() : thread_.detach();
        return is_whole;
    }

  protected:
    /// Before the first push(), for a sink that completes even if nothing is pushed.
    void start() {
        thread_ = std::thread([shared = shared_] { shared->run(); });
    }

  private:
    using Lock = std::unique_lock<std::mutex>;

    bool is_given_up() const {
        const Lock lock(shared_->mutex);
        return shared_->is_given_up;
    }

    /// State that the thread and its owner share; it lives as long as either of them.
    struct Shared {
        const std::shared_ptr<Sink> sink;
        const std::size_t capacity_bytes;
        std::mutex mutex{};
        std::condition_variable changed{};
        std::deque<Item> waiting{};
        std::size_t waiting_bytes = 0;  // with what is being written
        std::string error = sink->defect;
        bool has_ended = has_failed();  // the thread may be there, but its work no longer matters
        bool is_closing = false;
        bool is_completing = false;
        bool is_given_up = false;

        // With the mutex locked.

        bool has_room(std::size_t bytes = 1) const {
            return waiting_bytes == 0 || waiting_bytes + bytes <= capacity_bytes;
        }
        bool has_failed() const { return !error.empty(); }
        void end(std::string why) {
            error = std::move(why);
            waiting_bytes = 0;
            has_ended = true;
            changed.notify_all();
        }

        // With the mutex unlocked.

        /// Waits until `condition` holds; gives up once nothing has been written for `longest`, or the sink
        /// has not been ready for `block`.
        template <typename Condition>
        void wait_or_give_up(const Condition& condition, std::chrono::nanoseconds longest,
                             std::chrono::nanoseconds block = std::chrono::nanoseconds::max()) {
            Lock lock(mutex);
            auto moved = std::chrono::steady_clock::now();
            auto ready = moved;
            for (std::uint64_t before = sink->progress; !condition(*this);) {
                changed.wait_for(lock, std::chrono::milliseconds(10));
                const auto now = std::chrono::steady_clock::now();
                const std::uint64_t progress = sink->progress;
                if (std::exchange(before, progress) != progress) moved = ready = now;
                if (sink->is_ready()) ready = now;
                if (condition(*this) || (now - moved < longest && now - ready < block)) continue;
                is_given_up = true;
                end(sink->standstill);
            }
        }
        void run() {
            for (Lock lock(mutex);;) {
                changed.wait(lock, [this] { return is_closing || has_ended || !waiting.empty(); });
                if (has_ended) return;
                const bool is_last_attempt = is_closing || !sink->retry_period;
                is_completing = waiting.empty();
                const Item* const next = is_completing ? nullptr : &waiting.front();
                std::string failure;
                lock.unlock();
                try {
                    next == nullptr ? sink->complete() : sink->write(*next);
                } catch (const std::exception& failed) {
                    failure = failed.what();
                }
                lock.lock();
                if (is_given_up) return;
                error = failure;
                if (next == nullptr) return end(failure);
                sink->note(failure);
                if (has_failed() && is_last_attempt) return end(failure);
                if (!has_failed()) {
                    ++sink->progress;
                    waiting_bytes -= next->size();
                    waiting.pop_front();
                }
                changed.notify_all();
                if (has_failed()) changed.wait_for(lock, *sink->retry_period, [this] { return is_closing; });
            }
        }
    };

    std::shared_ptr<Shared> shared_;
    std::thread thread_;
};

}  // namespace osteomill
