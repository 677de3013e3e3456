// Long work done a step at a time: a coroutine that stops after each step and reports the completed share.
//
// The owner decides when and on which thread it continues, and may do other work in between; destroying it
// ends the work. All data that the work refers to must keep their addresses until then.
#pragma once

#include <algorithm>
#include <coroutine>
#include <cstddef>
#include <utility>
#include <vector>

namespace osteomill {

class Steps {
  public:
    // The names in here are prescribed by the language.
    struct promise_type {
        double part_done = 0.0;

        Steps get_return_object() { return Steps(std::coroutine_handle<promise_type>::from_promise(*this)); }
        std::suspend_always initial_suspend() noexcept { return {}; }
        std::suspend_always final_suspend() noexcept { return {}; }
        std::suspend_always yield_value(double part) noexcept {
            part_done = part;
            return {};
        }
        void return_void() noexcept { part_done = 1.0; }
        void unhandled_exception() { throw; }
    };

    Steps(Steps&& other) noexcept : work_(std::exchange(other.work_, nullptr)) {}
    Steps& operator=(Steps&& other) noexcept {
        std::swap(work_, other.work_);
        return *this;
    }
    ~Steps() {
        if (work_) work_.destroy();
    }

    /// Goes on to the end of the next step. False: all is done. Throws what the work throws, which ends it.
    bool step() {
        if (!work_.done()) work_.resume();
        return !work_.done();
    }
    /// The part of all work that is done, 0 to 1, as the work itself sees it.
    double done() const { return work_.promise().part_done; }

  private:
    explicit Steps(std::coroutine_handle<promise_type> work) : work_(work) {}

    std::coroutine_handle<promise_type> work_;
};

/// Does all of the work at once.
inline void finish(Steps steps) {
    while (steps.step()) {
    }
}

/// Completed share of the whole work, which rises from `before` to `after` during this part.
inline double part_of(const Steps& part, double before, double after) {
    return before + part.done() * (after - before);
}

/// Gives `values` its size, a few MiB a step: a page of memory costs its time when it is first written.
template <typename Value>
Steps grow(std::vector<Value>& values, std::size_t size, Value value) {
    constexpr std::size_t values_a_step = std::max<std::size_t>((std::size_t{4} << 20U) / sizeof(Value), 1);
    values.clear();
    values.reserve(size);
    while (values.size() < size) {
        values.resize(std::min(size, values.size() + values_a_step), value);
        co_yield static_cast<double>(values.size()) / static_cast<double>(size);
    }
}

}  // namespace osteomill
