// Writer of text to a file, a pipe or a terminal, on a thread of its own, for threads that must not wait for
// it.
//
// The waiting text is bounded. A descriptor that fails is given up for good: later text is dropped. A
// descriptor that blocks (a terminal stopped by Ctrl-S, a pipe without a reader, a disk that does not answer)
// stops only this thread. A thread blocked in write(2) cannot be joined: after a bounded wait it is
// abandoned, and touches only its own data until the program ends.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

namespace osteomill {

class BackgroundWriter {
  public:
    /// How long finish() waits for a descriptor that takes nothing at the moment.
    static constexpr std::chrono::milliseconds longest_block{200};
    /// The same for a descriptor that is ready according to the system but accepts nothing: a machine so busy
    /// that the thread gets no turn, or a disk.
    static constexpr std::chrono::milliseconds longest_standstill{2000};

    /// Writes to a duplicate of `descriptor`, so that it is the caller's to close or to redirect. A closed
    /// descriptor counts as a failed one.
    BackgroundWriter(int descriptor, std::size_t capacity_bytes);
    /// Finishes first, if need be.
    ~BackgroundWriter();
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;

    // Any thread.

    /// False, without taking the text, if less than the capacity is free. A longer text is taken if nothing
    /// else waits. Never waits for the descriptor.
    bool push(std::string text);
    /// Whether nothing waits.
    bool is_idle() const;
    /// Waits without limit until nothing waits to be written: for callers that may wait for a disk.
    void wait_until_idle() const;
    /// Why a write failed (errno); 0 while none has.
    int error() const;
    /// Takes no more text and waits until all is written or given up, bounded as above. False if a block or a
    /// standstill kept text from being written.
    bool finish();

  private:
    struct Shared;
    static void run(const std::shared_ptr<Shared>& shared);

    std::shared_ptr<Shared> shared_;
};

}  // namespace osteomill
